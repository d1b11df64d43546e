"""The view of a run on a terminal, from records as Snakemake's logger gives them."""

import io
import json
import logging

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from foldshell.engine import live_view
from foldshell.engine.live_view import LiveView, describe_results


def record(event=None, level=logging.INFO, text="", **fields):
    """Return a record with the fields of an event."""
    made = logging.LogRecord("snakemake", level, "", 0, text, None, None)
    for name, value in {"event": event, **fields}.items():
        setattr(made, name, value)
    return made


def write_analysis(results, design, iteration, verdict):
    """Write what the view reads of an analysis."""
    folder = results / design / "sizing" / f"{iteration:02d}"
    folder.mkdir(parents=True)
    report = {"verdict": verdict, "reason": "", "utilization_panel_mean_max": 0.5, "volume_m3": 2.0}
    (folder / "analysis.json").write_text(json.dumps(report))
    (folder / "seconds.json").write_text(json.dumps({"seconds": 60.0}))


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
    write_analysis(tmp_path, "dome", 0, "continue")
    run_job(view, 1, "analyse", {"design": "dome", "iteration": "00"})
    rows = view.describe()
    assert "dome" in rows[0] and " 0 " in rows[0] and "continue" in rows[0] and "0.500" in rows[0]
    assert "1 of 9 steps" in rows[1] and "left: about 14 min" in rows[1]
    write_analysis(tmp_path, "dome", 1, "converged")
    run_job(view, 2, "analyse", {"design": "dome", "iteration": "01"})
    assert "converged" in view.describe()[0]
    assert "1 of 2 designs sized" in view.describe()[1]


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
        write_analysis(tmp_path, design, 0, verdict)
        run_job(view, number, "analyse", {"design": design, "iteration": "00"})
    rows = view.describe(1)
    assert rows[0].startswith("arch") and rows[1] == "... and 1 more"


def test_the_end_is_a_table_with_the_page_to_open(tmp_path):
    write_analysis(tmp_path, "dome", 0, "converged")
    page = tmp_path / "studies/mine/report.html"
    page.parent.mkdir(parents=True)
    page.touch()
    lines = describe_results(tmp_path, ["dome", "arch"], tmp_path / "studies/mine").splitlines()
    assert lines[0].split() == ["design", "it", "verdict", "util", "volume"]
    assert lines[1].split()[:3] == ["dome", "0", "converged"]
    assert lines[2].startswith("arch") and lines[3] == f"open {page}"
