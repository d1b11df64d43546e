"""Rule report: one page for the study, whatever its results hold."""

import csv
import json
import re
import shutil
import subprocess

import pytest
from PIL import Image

import report
from foldshell.files.whole import write_json
from foldshell.records.files import write_record
from foldshell.report import study_report
from foldshell.report.checks import Check, describe_share, find_governing
from foldshell.report.engineering import list_engineering
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from record_cases import make_check, make_engineering

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("chrome")
EVIL = "</script><img src=x onerror=\"document.title='owned'\">"
ROW = {"design": "a", "tags": "supports,mine", "pattern": "miura", "surface": "arch",
       "span_m": "28.0", "height_m": "10.0", "zigzag": "15", "strip": "16", "support": "all",
       "fold_mode": "elastic", "state": "converged", "iterations": "15", "volume_m3": "63.5",
       "volume_per_area_m": "0.043", "utilization_mean": "0.41",
       "displacement_vertical_max_m": "0.0547", "buckling_factor_min": "10.1",
       "mesh_error": "0.0157", "crosscheck": "pass", "settings_hash": "12a1bc63e94b",
       "reason": "all criteria are met"}  # fmt: skip
SETTINGS = stage_parameters(make_settings({}), "study")


NUMBERS = {
    "parts": [{"part": "a part", "verdict": "mixed", "asserted": True, "holds": 2, "fails": 1,
               "cannot_be_told": 0}],
    "findings": [{"part": "softer by one tenth", "designs": ["a", "b"], "quantity": "volume_m3",
                  "unit": "m3", "values": [2.0, None], "uncertainty": None, "verdict": "fails"}],
    "pooled": {"panels": 42, "spearman": None, "pearson": 0.1},
}  # fmt: skip


def final_of(**changed):
    """Return a plain final.json."""
    limit = {"value": 0.0547, "limit": 0.11667, "met": True}
    used = {"value": 0.81, "limit": 1.0, "met": True}
    return {
        "iteration": 14, "state": "ok", "volume_m3": 63.5, "area_m2": 1475.0,
        "buckling_factor": {"S1": 10.1, "D1": None}, "second_order_iterations": 4,
        "second_order_residual": 1e-8, "dofs": 19027, "mesh_subdivisions": 4, "element_order": 5,
        "verdict": "converged", "reason": "all criteria are met", "stationary_iterations": 1,
        "criteria": {"utilization_panel_mean": used, "displacement_vertical_m": limit},
        "displacement_combination": "D1", "displacement_place_m": [1.0, 2.0, 3.0],
        "edited": False,
    } | changed  # fmt: skip


def write_results(folder, designs=("a", "b"), **changed):
    """Write a study's files; return the arguments of the script's main."""
    rows = [ROW | {"design": name} | changed for name in designs]
    rows[-1] |= {"state": "unstable", "buckling_factor_min": "", "surface": "hypar"}
    with (folder / "summary.csv").open("w", newline="") as stream:
        writer = csv.DictWriter(stream, ROW)
        writer.writeheader()
        writer.writerows(rows)
    quantity = {"primary": 1.0, "independent": 1.01, "relative_difference": 0.01,
                "tolerance": 0.04, "pass": True, "unit": "m"}  # fmt: skip
    for name in designs:
        home = folder / name
        write_json(home / "sizing/final.json", final_of())
        write_json(home / "crosscheck/comparison.json", {
            "design": name, "pass": True, "not_compared": [], "not_settled": [],
            "reactions": {}, "governing": {}, "shear": {},
            "quantities": {"D1 displacement_max_m": quantity}, "solver": "scipy",
            "primary_subdivisions": [4, 12], "independent_subdivisions": [1, 2]})  # fmt: skip
        write_json(home / "mesh_convergence.json", {
            "mesh_error": 0.0157, "buckling_mesh_error": None, "subdivisions": 4,
            "errors": {"D1": {"displacement_max_m": 0.0157}},
            "study": {"subdivisions": [4, 12], "reference": {"order": 7}, "combinations": {}},
        })  # fmt: skip
    scale = {"low": 0.0, "high": 1.0, "limit": None, "colours": "00518a" * 4,
             "ticks": [[0.0, "0"], [1.0, "1"]]}  # fmt: skip
    tile = {"words": "thickness [mm]", "scale": scale,
            "pictures": dict.fromkeys(designs, "data:image/webp;base64,AA==")}  # fmt: skip
    write_json(folder / "tiles.json", {"thickness": tile})
    Image.new("RGB", (1600, 900), "teal").save(folder / "supports.png")
    (folder / "chapter.md").write_text(
        "# Chapter\n\n| problem | value |\n|---|---|\n| plate | 4 |\n"
    )
    return {
        "paths": {"summary": folder / "summary.csv", "tiles": folder / "tiles.json",
                  "verification": folder / "chapter.md"},
        "figures": {"supports": folder / "supports.png"}, "report": folder / "report.html",
        "study": "mine", "results": folder, "project": folder, "settings": SETTINGS,
        "left_out": {"curvature": "no two designs"},
    }  # fmt: skip


def run(folder, **changed):
    """Write files and report; return the report's text."""
    arguments = write_results(folder, **changed)
    report.main(**arguments)
    return arguments["report"].read_text(encoding="utf-8")


def test_report_says_all_without_its_neighbours(tmp_path):
    """Counts, worst checks, every design with its governing check, table in mm, cross-check, loads,
    what was not drawn, how to make the claims."""
    text = run(tmp_path)
    for words in ("1 converged", "1 unstable", "2 pass", "vertical displacement, down [mm]",
                  "0.81, limit 1 (81 % of its limit)", "54.7", "combination D1 at x 1.0",
                  "Not drawn: curvature, no two designs.", "snakemake --cores 2 claims",
                  "<td>plate</td>", "0.85 kN/m² of sheet", "unit weight",
                  "displacement [%]", "second order (Th.II): equilibrium on the deformed shell",
                  "The mean utilization of a panel decides"):  # fmt: skip
        assert words in text, words
    assert text.count('<article class="card"') == 2
    assert 'href="./a/page.html"' in text


def test_policy_lets_its_own_script_run_and_no_other(tmp_path):
    """A hash in place of unsafe-inline; no address of a host."""
    text = run(tmp_path)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)[1]
    assert re.search(r"script-src 'sha256-[\w+/=]{44}'", policy)
    assert policy.startswith("default-src 'none'")
    assert not re.search(r"https?://", text.replace("http://www.w3.org/2000/svg", ""))


def test_hostile_cells_stay_texts(tmp_path):
    """Markup in the texts of summary.csv is shown, not run."""
    text = run(tmp_path, reason=EVIL, surface=EVIL, tags=EVIL)
    assert "<img src=x" not in text
    assert text.count("<script") == text.count("</script>") == 2
    data = re.search(r'id="study-data">(.*?)</script>', text, re.S)[1]
    assert json.loads(data)["designs"][0]["values"]["reason"] == EVIL.replace("_", " ")


def test_what_the_fold_buys_is_a_chapter_where_patterns_were_searched(tmp_path):
    """Text, tables and charts in their places, headings one level down; else how to make it."""
    text = run(tmp_path)
    assert "No pattern has been searched" in text and "explore beside" in text
    page = tmp_path / "function_follows_fold.md"
    page.write_text(
        "# What the fold buys\n\nFirst words.\n\n## In short\n\n- less\n\n"
        "![a chart](images/one.png)\n"
        "\n| roof |\n|---|\n| arch |\n\nMade by\n\n```bash\nsnakemake fold_answer\n```\n"
    )
    Image.new("RGB", (900, 500), "red").save(tmp_path / "one.png")
    arguments = write_results(tmp_path)
    arguments["paths"] |= {"fold": [page, tmp_path / "one.png"]}
    report.main(**arguments)
    chapter = arguments["report"].read_text(encoding="utf-8").partition('<section id="fold">')[2]
    chapter = chapter.partition("</section>")[0]
    assert "<h3>In short</h3>" in chapter and "<td>arch</td>" in chapter
    assert chapter.index("First words") < chapter.index("data:image/webp") < chapter.index("arch")
    assert "a chart" in chapter and "Made by" not in chapter and "No pattern" not in chapter


def test_claims_and_engineering_checks_are_shown_where_they_are(tmp_path):
    """A judged claim has its verdict; an engineering check stands beside the paper's."""
    arguments = write_results(tmp_path)
    claim = {"id": "C1", "claim": "stiffer on all edges", "verdict": "holds", "designs": ["a"],
             "numbers": NUMBERS, "uncertainty": {"largest_relative": {}, "method": "meshes"},
             "notes": ["a note"]}  # fmt: skip
    write_json(tmp_path / "claims.json", [claim])
    arguments["paths"]["claims"] = tmp_path / "claims.json"
    check = make_check(120.0, 100.0, False, words="steel", unit="kN/m", panel=7)
    record = make_engineering({"steel": check}, verdict="fails")
    write_record(tmp_path / "a/checks/engineering.json", record)
    report.main(**arguments)
    text = arguments["report"].read_text(encoding="utf-8")
    for words in ("C1: stiffer on all edges", "a note", "softer by one tenth",
                  "a part", "over 42", "steel [kN/m]: 120, limit 100 (120 % of",
                  "combination ULS1, panel 7", "engineering: steel"):  # fmt: skip
        assert words in text, words


def test_too_large_a_report_is_refused(tmp_path, monkeypatch):
    """Nothing is left behind."""
    monkeypatch.setattr(study_report, "SIZE_MAX", 1000)
    with pytest.raises(ValueError, match="1000 at most"):
        run(tmp_path)
    assert not (tmp_path / "report.html").exists()


@pytest.mark.parametrize(
    ("value", "limit", "at_least", "ratio"),
    [(0.8, 1.0, False, 0.8), (1.2, 1.0, False, 1.2), (10.0, 1.5, True, 0.15),
     (1.2, 1.5, True, 1.25), (None, 1.0, False, None), (3.0, None, False, None)],
)  # fmt: skip
def test_ratio_knows_on_which_side_of_the_limit_it_is_good(value, limit, at_least, ratio):
    """1 at the limit, above it only where the check fails, for largest and least values alike."""
    record = make_engineering({"a": make_check(value, limit, at_least=at_least)})
    (check,) = list_engineering(record)
    assert check.ratio == (None if ratio is None else pytest.approx(ratio))


@pytest.mark.parametrize(
    ("ratio", "words"),
    [(0.99438, "99 %"), (0.998, "99.8 %"), (0.997, "99.7 %"), (1 - 1e-9, "99.9 %"), (1.0, "100 %"),
     (1 + 1e-9, "100.1 %"), (1.002, "100.2 %"), (1.2, "120 %"), (None, "–")],
)  # fmt: skip
def test_a_share_below_or_above_the_limit_is_not_rounded_to_it(ratio, words):
    """100 % is the limit itself: tenths near it, always away from it."""
    assert describe_share(ratio) == words


def test_the_governing_check_uses_most_of_its_limit():
    """Checks without a number do not govern."""
    checks = [
        Check("a", 1, 2, 0.5, True),
        Check("b", 9, 10, 0.9, True),
        Check("c", 1, 1, None, None),
    ]
    assert find_governing(checks).name == "b"
    assert find_governing(checks[2:]) is None


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_report_in_a_browser(tmp_path):
    """Its script runs under its own policy and draws both charts; nothing hostile does anything."""
    run(tmp_path, reason=EVIL)
    command = [
        CHROMIUM, "--headless", "--no-sandbox", "--virtual-time-budget=5000", "--dump-dom",
        f"--user-data-dir={tmp_path / 'browser'}", (tmp_path / "report.html").as_uri(),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=180, check=True)
    assert 'class="scripted"' in done.stdout
    assert "2 of 2 shown" in done.stdout
    assert done.stdout.count("<polyline") == 4
    assert "<title>Folded shells: study mine</title>" in done.stdout


def test_files_for_other_programs_are_linked_where_they_are(tmp_path):
    """Of the design that has them, their list first; a dead link leads nobody astray."""
    arguments = write_results(tmp_path)
    for name in ("index.html", "a.3dm", "a.ifc"):
        (tmp_path / "a/exports").mkdir(exist_ok=True)
        (tmp_path / "a/exports" / name).write_text("x")
    report.main(**arguments)
    text = arguments["report"].read_text(encoding="utf-8")
    assert re.findall(r'href="\./(\w+)/exports/([\w.]+)"', text) == [
        ("a", "index.html"), ("a", "index.html"), ("a", "a.3dm"), ("a", "a.ifc")
    ]  # fmt: skip
