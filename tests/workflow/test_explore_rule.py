"""The search of the pattern as rules: killed in any round it goes on, with the same bytes."""

import pytest

pytest.importorskip("sklearn", reason="envs/explore.lock is not installed")

from study_runner import make_study, run, run_and_kill

TEXT = """\
base: {surface: paraboloid, span_m: 8, height_m: 2, zigzag: 5, strip: 6, support: all}
variables: {rest_fold_angle_deg: [30, 60], strip_grading: [-0.5, 0.5]}
limits: {plan_coverage_min: 0.5, buckling_factor_min: 1.0}
search: {first: 4, rounds: 3, batch: 2, screened: 3, confirmed: 1, subdivisions: 1, slopes: 1}
"""
TARGET = ("explore", "--config", "exploration=config/explorations/small.yaml")
FOLDER = "results/explorations/small"


def make_folder(folder, text=TEXT):
    sizing = {"iterations_max": 30, "start_thickness_mm": 60, "least_thickness_mm": 40}
    make_study(folder, settings={"sizing": sizing | {"utilization_min": 0.05}})
    path = folder / "config/explorations/small.yaml"
    path.parent.mkdir()
    path.write_text(text)
    return folder


def gather(folder):
    home = folder / FOLDER
    files = [home / "explore.tsv", home / "selected.tsv", home / "design_explorer.csv"]
    files += sorted(home.glob("rounds/*/*")) + sorted(home.glob("candidates/*/candidate.json"))
    return {path.relative_to(home).as_posix(): path.read_bytes() for path in files}


@pytest.mark.slow
def test_a_search_that_was_killed_goes_on_with_the_same_bytes(code, tmp_path):
    whole = make_folder(tmp_path / "whole")
    done = run(code, whole, *TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    assert (whole / FOLDER / "explore.html").stat().st_size < 1_400_000
    assert (whole / FOLDER / "confirmed.csv").read_text().count("\n") >= 2
    killed = make_folder(tmp_path / "killed")
    for made in ("candidates/00-00", "candidates/01-01", "rounds/03", "slopes.json"):
        run_and_kill(code, killed, killed / FOLDER / made, *TARGET)
        run(code, killed, "--unlock")
    done = run(code, killed, *TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    assert gather(killed) == gather(whole)


@pytest.mark.slow
def test_no_design_that_keeps_all_limits_is_a_sentence(code, tmp_path):
    """With the limit that excluded most; the tables and the page are there."""
    text = TEXT.replace("plan_coverage_min: 0.5", "plan_coverage_min: 1.09")
    text = text.replace("rounds: 3", "rounds: 0")
    folder = make_folder(tmp_path / "none", text)
    done = run(code, folder, *TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    said = "no candidate keeps all limits: plan_coverage_min excluded most"
    assert said in (folder / "results/logs/explored/small.log").read_text()
    assert "None keeps all limits" in (folder / FOLDER / "explore.html").read_text()
