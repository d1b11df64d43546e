"""Rules sheet, sheet_pdf, summary_pdf: what an engineer prints and signs."""

import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import sheet
import sheet_pdf
import summary_pdf
from foldshell.files.errors import InputError
from foldshell.files.whole import read_json, write_json
from foldshell.report.pdf import write_pdf
from report_cases import DESIGN, SETTINGS, write_files
from scripts.test_report import final_of, write_results

EVIL = '</style><img src=x onerror="1">#panic("typst")'
REACTIONS = {
    "design": "case", "pass": True, "not_compared": [], "not_settled": [], "solver": "scipy",
    "reactions": {}, "governing": {}, "shear": {},
    "primary_subdivisions": [4, 12], "independent_subdivisions": [1, 2],
    "quantities": {"D1 work_knm": {"primary": 1.0, "independent": 1.01, "tolerance": 0.04,
                                   "relative_difference": 0.01, "pass": True, "unit": "kNm"}},
}  # fmt: skip


def run(folder, **options):
    """Write a small case and its sheet; return the text of the page and the data."""
    design = DESIGN | options.pop("design", {})
    final = {
        "buckling_factor": {"S1": 3.0, "S2": 2.0, "D2": 4.0},
        "governing_combination": "S2",
    } | options.pop("final", {})
    comparison = REACTIONS | options.pop("comparison", {})
    paths, pictures = write_files(folder, **options)
    write_json(paths["final"], {k: v for k, v in final_of(**final).items() if v is not None})
    write_json(paths["comparison"], comparison)
    write_json(paths["mesh_convergence"], {
        "mesh_error": 0.0157, "buckling_mesh_error": None, "subdivisions": 4, "errors": {},
        "study": {"subdivisions": [4, 12], "reference": {"order": 7}, "combinations": {}},
    })  # fmt: skip
    paths |= {"utilization": pictures["utilization"]}
    html, data = folder / "sheet.html", folder / "sheet.json"
    sheet.main(paths, html, data, design=design, settings=SETTINGS)
    return html.read_text(encoding="utf-8"), read_json(data)


def measure_pages(data):
    """Return width and height of each page of a PDF, in whole points."""
    boxes = re.findall(rb"/MediaBox ?\[0 0 ([\d.]+) ([\d.]+)\]", data)
    return [(round(float(width)), round(float(height))) for width, height in boxes]


def test_sheet_says_what_is_checked_and_where(tmp_path):
    """Verdict, governing check, bars, dimensions, marks, load resultants, reactions by edge."""
    text, data = run(tmp_path)
    for words in ("converged", "governs, paper's criteria:", "81 %", "utilization, panel",
                  "displacement, D1",
                  "buckling mode, S2", "zig-zag edge, free", "strip edge, pinned", "1 m",
                  "sum z [kN]", "first strip edge", "self-weight down", "1.57 %",
                  "second order (Th.II): equilibrium on the deformed shell",
                  "The mean utilization of a panel decides"):  # fmt: skip
        assert words in text, words
    assert [check["met"] for check in data["checks"]] == [True, True, True]
    used = data["checks"][0]["where"]
    assert re.fullmatch(r"combination S2, panel 0 at x -?[\d.]+, y -?[\d.]+, z -?[\d.]+ m", used)
    assert used in data["governing"] and "utilization, panel 0, S2" in text
    assert data["checks"][0]["bar"] == pytest.approx(0.81 / 1.25)
    sums = [row for row in data["tables"]["Reactions"]["rows"] if row[1] == "sum"]
    assert [row[0] for row in sums] == ["S1", "S2", "D1", "D2"]


def test_unstable_design_has_a_sheet(tmp_path):
    """No displacement, no utilization, nothing to compare: what there is stands there."""
    text, data = run(
        tmp_path, utilization=None, move=lambda x: np.nan * x, final={
            "verdict": "unstable", "reason": "a mechanism", "criteria": {}, "state": "mechanism",
            "buckling_factor": {}, "displacement_combination": None, "displacement_place_m": None},
        comparison={"pass": None, "reason": "nothing to compare", "quantities": {}},
    )  # fmt: skip
    assert "a mechanism" in text and "not possible" in text
    assert data["checks"] == [] and "Reactions" not in data["tables"]


def test_extents_are_those_of_the_sheet(tmp_path):
    """The drawing's words agree with the table."""
    text, data = run(tmp_path)
    rows = dict(data["tables"]["Geometry"]["rows"])
    size = rows["extents x, y, z [m]"].split(", ")
    assert re.findall(r"[xyz]: ([\d.]+) m", text) == size


def test_hostile_texts_stay_texts(tmp_path):
    """Neither markup nor a call of typst in a design's words is run."""
    pytest.importorskip("typst")
    text, data = run(tmp_path, design={"surface": EVIL, "pattern": EVIL})
    assert "<img src=x" not in text
    data["reason"] = data["title"] = data["warning"] = EVIL
    write_json(tmp_path / "sheet.json", data)
    sheet_pdf.main(tmp_path / "sheet.json", tmp_path / "utilization.png", tmp_path / "sheet.pdf")
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")


def test_pdf_is_a4_of_three_pages_at_most_and_the_same_again(tmp_path):
    """595 x 842 points; the bytes depend on the data alone."""
    pytest.importorskip("typst")
    run(tmp_path)
    for name in "ab":
        arguments = tmp_path / "sheet.json", tmp_path / "utilization.png", tmp_path / f"{name}.pdf"
        sheet_pdf.main(*arguments)
    data = (tmp_path / "a.pdf").read_bytes()
    assert data == (tmp_path / "b.pdf").read_bytes()
    assert measure_pages(data) == [(595, 842)] * 2


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="no pdftotext")
def test_words_of_the_pdf_can_be_searched(tmp_path):
    """Numbers of the checks and reactions come back from the file."""
    pytest.importorskip("typst")
    run(tmp_path)
    sheet_pdf.main(tmp_path / "sheet.json", tmp_path / "utilization.png", tmp_path / "sheet.pdf")
    command = ["pdftotext", "-layout", str(tmp_path / "sheet.pdf"), "-"]
    words = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    for part in ("Calculation sheet: case", "81 %", "first strip edge", "von mises"):
        assert part in words


def test_summary_has_a_row_per_design(tmp_path):
    """One landscape PDF, also with a design without numbers."""
    pytest.importorskip("typst")
    given = write_results(tmp_path)
    Image.new("RGB", (600, 300), "white").save(tmp_path / "all.png")
    paths = given["paths"] | {"sheet": tmp_path / "all.png"}
    summary_pdf.main(paths, tmp_path / "summary.pdf", study="mine", results=tmp_path)
    assert measure_pages((tmp_path / "summary.pdf").read_bytes()) == [(842, 595)] * 2


def test_missing_library_is_one_sentence(tmp_path, monkeypatch):
    """What to type, and no file left behind."""
    monkeypatch.setitem(sys.modules, "typst", None)
    with pytest.raises(InputError, match=r"typst: is not installed: type .* -r envs/sheets.lock"):
        write_pdf(tmp_path / "a.pdf", "sheet", {})
    assert not list(tmp_path.iterdir())
