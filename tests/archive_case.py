"""A small study in the checkout of a small project, to be archived."""

import subprocess
from dataclasses import replace

from foldshell.archive.bag import write_archive
from foldshell.archive.content import Study
from foldshell.files.job_record import read_records, write_record
from foldshell.files.whole import hash_data, hash_file
from foldshell.settings.archive import Archive
from results_case import make_results, record
from workbook_cases import edit_with_openpyxl

DATE = "2026-01-02"


def git(folder, *words):
    name = ["-c", "user.name=t", "-c", "user.email=t@t"]
    subprocess.run(["git", "-C", str(folder), *name, *words], check=True, capture_output=True)


def make_study(tmp_path):
    """Return a study of two designs, in the checkout of a small project."""
    project = tmp_path / "project"
    (project / "scripts").mkdir(parents=True)
    for name in ("Snakefile", "LICENSE", "CITATION.cff", "scripts/analyse.py", "scripts/size.py"):
        (project / name).write_text(f"# {name}\n")
    (project / "designs.tsv").write_text("design\na\nb\n")
    (project / ".gitignore").write_text("results/\n")
    git(project, "init", "-q")
    git(project, "add", "-A")
    git(project, "commit", "-qm", "first")
    results = make_results(project / "results")
    return Study("t", ("a", "b"), results, results / "studies/t", project)


def write(study, path, **options):
    tables = [study.project / "designs.tsv"]
    write_archive(path, study, {"study": "t"}, tables, "ab" * 32, DATE, Archive(**options))
    return path


def give(study, path, text="v 0 0 0\n"):
    """Let the first job of design a have read a file from outside of the results."""
    if not path.startswith("/"):
        (study.project / path).parent.mkdir(exist_ok=True)
        (study.project / path).write_text(text)
    first = read_records(study.results / "a")[0]
    digest = hash_data(text) if path.startswith("/") else hash_file(study.project / path)
    write_record(study.results / "a", replace(first, external={path: digest}))


def with_an_edit(study):
    """Let a person have changed the thickness of panel 2 before the first analysis of design a."""
    home, book = study.results / "a", study.results / "a/sizing/00/thickness.xlsx"
    edit_with_openpyxl(book, lambda workbook: workbook["thickness"].__setitem__("D5", 0.25))
    made = ["sizing/00/analysis.json", "sizing/00/analysis.npz"]
    record(home, "analyse-00", "analyse", made, ["sizing/00/thickness.xlsx"])


def with_a_surface_file(study):
    """Let the first job of design a have read a file of the project that no commit holds."""
    give(study, "models/roof.obj")
