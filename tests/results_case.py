"""Results of two small designs of one study, with records and manifests, made by hand."""

import numpy as np

from foldshell.files.job_record import JobRecord, read_records, state_of, write_record
from foldshell.files.manifest import make_manifest, write_manifest
from foldshell.files.whole import hash_file, write_arrays, write_json
from foldshell.records.edits import recorded_workbook
from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.styles import Line
from foldshell.workbook.write_thickness import write_thickness

VERSIONS = {"foldshell": "1", "commit": "abc"}


def write_book(home, number, thickness):
    path = home / f"sizing/{number:02d}/thickness.xlsx"
    path.parent.mkdir(parents=True, exist_ok=True)
    table = ThicknessTable(make_panel_grid(3, 4), np.full(6, thickness))
    about = [Line("design", home.name), Line("iteration", number)]
    with recorded_workbook(path, path.with_name("written.json"), table.thickness) as temporary:
        write_thickness(temporary, table, about, 0.01, 1.0)
    return path


def record(home, name, rule, outputs, inputs=()):
    states = {path: state_of(home / path) for path in outputs}
    sums = {path: hash_file(home / path) for path in inputs}
    write_record(home, JobRecord(name, rule, {"design": home.name}, states, sums, {}, "p", "c"))


def make_design(results, name, first):
    """A loop of two iterations, its history and a page that was made of that."""
    home = results / name
    for number in (0, 1):
        book = write_book(home, number, first - 0.01 * number)
        place, last = f"sizing/{number:02d}", f"sizing/{number - 1:02d}"
        before = [f"{last}/analysis.json"] if number else []
        record(home, f"resize-{number:02d}", "resize", [f"{place}/thickness.xlsx"], before)
        write_arrays(
            book.with_name("analysis.npz"), {"thickness": np.full(6, first - 0.01 * number)}
        )
        write_json(book.with_name("analysis.json"), {"iteration": number, "volume_m3": 10 * first})
        made = [f"{place}/analysis.json", f"{place}/analysis.npz"]
        record(home, f"analyse-{number:02d}", "analyse", made, [f"{place}/thickness.xlsx"])
    write_json(home / "history.json", {"rows": 2, "name": name})
    record(
        home,
        "size",
        "size",
        ["history.json"],
        ["sizing/00/analysis.json", "sizing/01/analysis.json"],
    )
    (home / "page.html").write_text(f"<p>{name}</p>")
    record(home, "page", "page", ["page.html"], ["history.json"])
    write_manifest(
        home / "manifest.json", make_manifest(name, home, read_records(home), "r", VERSIONS)
    )


def make_results(folder):
    """Write both designs and the study; return the folder."""
    for name, first in (("a", 0.2), ("b", 0.3)):
        make_design(folder, name, first)
    home = folder / "studies/t"
    write_json(home / "summary.json", {"rows": 2})
    record(home, "summary", "summary", ["summary.json"])
    members = {
        f"../../{name}/manifest.json": hash_file(folder / name / "manifest.json") for name in "ab"
    }
    manifest = make_manifest("t", home, read_records(home), "r", VERSIONS, members)
    write_manifest(home / "manifest.json", manifest)
    return folder
