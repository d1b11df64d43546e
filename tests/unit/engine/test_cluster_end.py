"""Sentences on jobs of a cluster, from what Snakemake and Slurm 22.05 have written."""

import pytest

from foldshell.engine.cluster_end import describe_cluster_ends

GROUP = """
[Sun Nov 29 22:09:59 2026]
    message: Error in group loop
    log: /x/.snakemake/slurm_logs/group_loop_fold_mesh/5.log (check log file(s) for error details)
    jobs:
        rule fold:
            jobid: 4
            output: results/dome-1/folded/folded.npz
            log: results/logs/fold/dome-1.log (check log file(s) for error details)
"""
RULE = """
Error in rule start:
    message: SLURM-job '7' failed, SLURM status is: '{state}'. Detailed failure reason unavailable
    jobid: 7
    output: results/dome-2/sizing/00/thickness.xlsx, results/dome-2/sizing/00/written.json
    log: results/logs/start/dome-2.log, /x/.snakemake/slurm_logs/rule_start/dome-2/7.log (check log
"""
MEMORY = "slurmstepd-vm: error: StepId=5.batch exceeded memory limit (8 > 6), being killed\n"
CANCELLED = "slurmstepd-vm: error: *** JOB 5 ON vm CANCELLED AT 2026-11-29T22:09:47 ***\n"
TIME = "slurmstepd: error: *** JOB 5 ON vm CANCELLED AT 2026-11-29T22:09:47 DUE TO TIME LIMIT ***\n"


@pytest.mark.parametrize(
    ("log", "words"),
    [
        (MEMORY + CANCELLED, "took more memory"),
        (TIME, "took longer"),
        (CANCELLED, "was cancelled"),
        ("error: config.yaml: no\nerror: sheet crumples\n", "failed: sheet crumples ("),
        ("", "failed ("),
    ],
)
def test_a_group_is_explained_by_its_log(log, words):
    (sentence,) = describe_cluster_ends(GROUP, lambda path: log if path.endswith("5.log") else "")
    assert sentence.startswith("dome-1: job 5 of the cluster ") and words in sentence
    assert "what is done is kept" in sentence and "\n" not in sentence


@pytest.mark.parametrize(
    ("state", "words"),
    [
        ("OUT_OF_MEMORY", "took more memory"),
        ("TIMEOUT", "took longer"),
        ("CANCELLED", "was cancelled"),
        ("NODE_FAIL", "lost with its node"),
        ("FAILED", "failed ("),
    ],
)
def test_a_rule_is_explained_by_its_state(state, words):
    sentences = describe_cluster_ends(GROUP + RULE.format(state=state), lambda path: "")
    assert sentences[0].startswith("dome-1: job 5")
    assert sentences[1].startswith("dome-2: job 7") and words in sentences[1]
    assert "(/x/.snakemake/slurm_logs/rule_start/dome-2/7.log)" in sentences[1]


def test_a_run_on_this_machine_has_none():
    assert describe_cluster_ends("Error in rule fold:\n    log: results/logs/a.log", str) == []
