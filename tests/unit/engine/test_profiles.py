"""Every rule has its place in the profiles of clusters: a forgotten one breaks the groups."""

import re
from pathlib import Path

import pytest
import yaml

REPOSITORY = Path(__file__).parents[3]
RULE = re.compile(r"(?ms)^(?:rule|checkpoint|use rule \w+ as) (\w+)(?: with)?:\n(.*?)(?=^\S|\Z)")
ALONE = {"start", "analyse", "resize", "group", "schemas", "verify"}
"""Rules of loops by steps, which clusters do not take, and those that run where Snakemake does."""
ASKED = {"animate", "archive_study", "crosscheck_opensees", "export_index", "fold_answer"}
ASKED |= {"rivals", "judged"}
"""Rules that no study asks for: each job is a submission of its own."""


def read_groups(profile):
    text = (REPOSITORY / "profiles" / profile / "config.yaml").read_text()
    return dict(entry.split("=") for entry in yaml.safe_load(text)["groups"])


def read_rules():
    """Return the names of the rules that run a script."""
    found = set()
    for path in (REPOSITORY / "rules").glob("*.smk"):
        rules = RULE.findall(path.read_text())
        found |= {name for name, body in rules if "script:" in body or "with output" in body}
    return found


@pytest.mark.parametrize("profile", ["slurm", "kubernetes"])
def test_every_rule_of_a_study_is_in_a_group(profile):
    groups, rules = read_groups(profile), read_rules()
    assert len(rules) > 25 and {"fold", "size", "page", "report"} <= rules
    assert rules - ALONE - ASKED <= groups.keys(), sorted(rules - ALONE - ASKED - groups.keys())
    assert groups.keys() <= rules | {"panel_figures"}


def test_a_round_of_a_search_is_one_submission():
    """Proposals and candidates of a round are one group, which other rounds are not part of."""
    groups = read_groups("slurm")
    assert groups["propose"] == groups["candidate"] == "round{round}"
    assert len({groups[name] for name in ("explored", "confirm", "explore_page")}) == 1


def test_both_profiles_have_the_same_groups():
    assert read_groups("slurm") == read_groups("kubernetes")
