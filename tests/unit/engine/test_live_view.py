"""The view of a run on a terminal, from records as Snakemake's logger gives them."""

import io
import logging
import os

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from foldshell.engine import live_view
from foldshell.engine.live_view import LiveView, describe_results
from foldshell.records.analysis import write_analysis
from record_cases import make_analysis


def record(event=None, level=logging.INFO, text="", **fields):
    """Return a record with the fields of an event."""
    made = logging.LogRecord("snakemake", level, "", 0, text, None, None)
    for name, value in {"event": event, **fields}.items():
        setattr(made, name, value)
    return made


def write(results, design, iteration, verdict):
    """Write what the view reads of an analysis."""
    known = {"iteration": iteration, "verdict": verdict, "reason": "why", "volume_m3": 2.0}
    made = make_analysis(**known, utilization_panel_mean_max=0.5, seconds=60.0)
    write_analysis(results / design / f"sizing/{iteration:02d}/analysis.json", made)


@pytest.fixture
def view(tmp_path, monkeypatch):
    monkeypatch.setattr(live_view, "PAUSE", 0.0)
    return LiveView(tmp_path, ["dome", "arch"], 1, lambda record: record.msg, io.StringIO())


def run_job(view, number, rule, wildcards):
    """Begin and end a job."""
    view.emit(record(LogEvent.JOB_INFO, jobid=number, rule_name=rule, wildcards=wildcards))
    view.emit(record(LogEvent.JOB_FINISHED, job_id=number))
    view.emit(record(LogEvent.PROGRESS, done=number, total=9))


def test_it_shows_designs_iteration_verdict_and_time_left(view, tmp_path):
    assert view.describe()[0].startswith("0 of 2 designs sized")
    write(tmp_path, "dome", 0, "continue")
    run_job(view, 1, "analyse", {"design": "dome", "iteration": "00"})
    rows = view.describe()
    assert "dome" in rows[0] and " 0 " in rows[0] and "continue" in rows[0] and "0.500" in rows[0]
    assert "1 of 9 steps" in rows[1] and "left: about 14 min" in rows[1]
    write(tmp_path, "dome", 1, "converged")
    run_job(view, 2, "analyse", {"design": "dome", "iteration": "01"})
    assert "converged" in view.describe()[0]
    assert "1 of 2 designs sized" in view.describe()[1]


def test_a_loop_in_one_job_is_looked_at_while_it_runs(view, tmp_path, monkeypatch):
    """What an earlier run has left does not count."""
    write(tmp_path, "dome", 0, "converged")
    os.utime(tmp_path / "dome/sizing/00/analysis.json", (0, 0))
    fields = {"jobid": 1, "rule_name": "size", "wildcards": {"design": "dome"}}
    view.emit(record(LogEvent.JOB_INFO, **fields))
    view._advance("dome", view._begun["dome"])
    assert view.describe()[0].startswith("0 of 2")
    for number in range(3):
        write(tmp_path, "dome", number, "continue")
    view._advance("dome", view._begun["dome"])
    assert view.describe()[0].split()[:3] == ["dome", "2", "continue"]


def test_a_job_that_runs_is_named(view):
    fields = {"jobid": 3, "rule_name": "draw", "wildcards": {"design": "arch"}}
    view.emit(record(LogEvent.JOB_INFO, **fields))
    assert view.describe()[-1] == "now: draw arch"


def test_lines_are_drawn_over_and_errors_stay(view):
    run_job(view, 1, "pattern", {"design": "dome"})
    view.emit(record(level=logging.ERROR, text="a job failed"))
    view.close()
    text = view._stream.getvalue()
    assert "a job failed\n" in text
    shown = text.split("a job failed\n")[1]
    assert shown.endswith("\x1b[2F\x1b[J")  # nothing of the view is left


def test_a_terminal_of_few_lines_shows_the_designs_in_their_loop_first(view, tmp_path):
    for number, (design, verdict) in enumerate([("dome", "converged"), ("arch", "continue")]):
        write(tmp_path, design, 0, verdict)
        run_job(view, number, "analyse", {"design": design, "iteration": "00"})
    rows = view.describe(1)
    assert rows[0].startswith("arch") and rows[1] == "... and 1 more"


def test_the_end_is_a_table_with_the_page_to_open(tmp_path):
    write(tmp_path, "dome", 0, "converged")
    page = tmp_path / "studies/mine/report.html"
    page.parent.mkdir(parents=True)
    page.touch()
    lines = describe_results(tmp_path, ["dome", "arch"], tmp_path / "studies/mine").splitlines()
    assert lines[0].split() == ["design", "it", "verdict", "util", "volume"]
    assert lines[1].split()[:3] == ["dome", "0", "converged"]
    assert lines[2].startswith("arch") and lines[3] == f"open {page}"
