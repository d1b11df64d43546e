"""The search of the pattern as rules: killed in any round it goes on, with the same bytes."""

import csv

import pytest
import yaml

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


@pytest.mark.slow
def test_a_small_search_makes_a_whole_answer(code, tmp_path):
    """Page, charts, found designs, and the chapter of the report; the found designs are a table
    that the workflow takes, and the page's bytes are the same when it is made again."""
    text = TEXT.replace("rounds: 3", "rounds: 0")
    folder = make_folder(tmp_path / "answer", text)
    done = run(code, folder, "beside", *TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    done = run(code, folder, "fold_answer", "all")
    assert done.returncode == 0, done.stderr[-3000:]
    home = folder / "results/explorations"
    page = (home / "function_follows_fold.md").read_text()
    for words in ("## In short", "against the smooth shell", "## Concrete against buckling factor",
                  "## Concrete against panels", "## By the engineering verdict",
                  "base in the table",
                  "## What it buys", "## What it costs", "## Where limits decide",
                  "explore beside"):  # fmt: skip
        assert words in page, words
    assert "mesh yet" not in page and "nan" not in page and "None" not in page
    for name in ("factors", "panels"):
        assert f"](images/fold_answer_{name}.png)" in page
        assert (home / f"images/fold_answer_{name}.png").stat().st_size > 5000
    report = (folder / "results/report.html").read_text()
    chapter = report.partition('<section id="fold">')[2].partition("</section>")[0]
    assert "against the smooth shell" in chapter and chapter.count("data:image/webp") == 2
    before = [path.read_bytes() for path in sorted(home.glob("f*"))]
    (home / "function_follows_fold.md").unlink()
    done = run(code, folder, "fold_answer")
    assert done.returncode == 0, done.stderr[-3000:]
    assert [path.read_bytes() for path in sorted(home.glob("f*"))] == before
    found = ("--config", f"designs={home}/found.tsv", "results=results/again", "study=found")
    done = run(code, folder, "-n", *found)
    assert done.returncode == 0 and "small-01-" in done.stdout + done.stderr, done.stderr[-3000:]


STEEL = """\
base: {surface: arch, span_m: 8, height_m: 2, zigzag: 5, strip: 6, support: all}
variables:
  pattern: [miura, accordion]
  rest_fold_angle_deg: [35, 55]
  span_ratio: [0.9, 1.2]
aims: [engineering_volume_m3, co2_kg]
limits: {plan_coverage_min: 0.0, planarity_max: 10, edge_strain_max: 1, buckling_factor_min: 1.0}
search:
  {first: 4, rounds: 1, batch: 2, screened: 3, confirmed: 1, subdivisions: 1, slopes: 0,
   rule: filtered_dead_band, measure: reinforced}
"""


@pytest.mark.slow
def test_a_search_for_concrete_with_its_steel(code, tmp_path):
    """Two patterns and another plan; the confirmed design is sized by the same measure."""
    folder = make_folder(tmp_path / "steel", STEEL)
    done = run(code, folder, *TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    with (folder / FOLDER / "explore.tsv").open() as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    assert {row["pattern"] for row in rows if row["candidate"] > "01"} == {"miura", "accordion"}
    kept = [row for row in rows if row["feasible"] == "True" and row["candidate"] > "01"]
    assert kept and all(float(row["steel_kg"]) > 0 for row in kept)
    settings = yaml.safe_load((folder / FOLDER / "confirmed.yaml").read_text())
    assert settings["sizing"]["measure"] == "reinforced"
    with (folder / FOLDER / "confirmed.csv").open() as file:
        (one,) = csv.DictReader(file)
    assert one["engineering"] and float(one["steel_kg_m2"]) > 0
    best = next(row for row in rows if one["design"].endswith(row["candidate"]))
    assert float(one["span_x_m"] or 0) != float(one["span_y_m"] or 1) and best["span_ratio"]
