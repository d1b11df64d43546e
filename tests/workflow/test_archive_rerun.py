"""A study with an edit by hand and a surface of its own: archived, verified, run again."""

import shutil
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("bagit", reason="envs/archive.lock is not installed")
pytest.importorskip("rocrate", reason="envs/archive.lock is not installed")

from study_runner import HEADER, REPOSITORY, copy_code, make_study, run

from workbook_cases import edit_with_openpyxl

DESIGNS = (
    "own-dome\tmodels/dome.obj\t8\t2\t5\t6\tall\ttiny\n"
    "tiny-saddle\thypar\t8\t2\t5\t6\tstrip\ttiny\n"
)


def write_dome(path):
    """An elliptic paraboloid, 9 m wide and 2 m high, as a mesh of 20 x 20 squares."""
    side = np.linspace(-4.5, 4.5, 21)
    x, y = np.meshgrid(side, side, indexing="ij")
    z = 2 * (1 - (x**2 + y**2) / (2 * 4.5**2))
    corners = [f"v {a:.9g} {b:.9g} {c:.9g}" for a, b, c in zip(x.flat, y.flat, z.flat, strict=True)]
    faces = [
        f"f {21 * i + j + 1} {21 * i + j + 22} {21 * i + j + 23} {21 * i + j + 2}"
        for i in range(20)
        for j in range(20)
    ]
    path.parent.mkdir()
    path.write_text("\n".join([*corners, *faces]) + "\n")


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """The checkout of the workflow with a study in it, whose surface no commit holds."""
    folder = copy_code(tmp_path_factory.mktemp("archived") / "project")
    shutil.rmtree(folder / "config")
    make_study(folder)
    (folder / "config/designs.tsv").write_text(HEADER + DESIGNS)
    for name in ("LICENSE", "CITATION.cff", "pyproject.toml"):
        shutil.copy2(REPOSITORY / name, folder / name)
    (folder / ".gitignore").write_text("/results/\n/.snakemake/\n/models/\n__pycache__/\n")
    name = ["-c", "user.name=t", "-c", "user.email=t@t"]
    for words in (["init", "-q"], ["add", "-A"], [*name, "commit", "-qm", "first"]):
        subprocess.run(["git", *words], cwd=folder, check=True, capture_output=True)
    write_dome(folder / "models/dome.obj")
    return folder


def verify(project, *arguments):
    words = [sys.executable, "scripts/verify.py", *map(str, arguments)]
    return subprocess.run(words, cwd=project, capture_output=True, text=True)


@pytest.mark.slow
def test_rerun_of_an_archive_gives_the_same_summary(project, tmp_path):
    """Of both designs, also of the one whose workbook a person had changed in between."""
    done = run(project, project)
    assert done.returncode == 0, done.stderr[-2000:]
    book = project / "results/own-dome/sizing/01/thickness.xlsx"
    edit_with_openpyxl(book, lambda workbook: workbook["thickness"].__setitem__("D6", 0.111))
    done = run(project, project, "archive")
    assert done.returncode == 0, done.stderr[-2000:]
    (archive,) = project.glob("results/studies/tiny/archive/*.zip")
    done = verify(project, archive, "--recompute", "own-dome")
    assert done.returncode == 0 and done.stdout.count("the same bytes") == 3, done.stdout
    folder = tmp_path / "again"
    done = verify(project, archive, "--rerun", folder)
    assert done.returncode == 0 and "same bytes" in done.stdout, done.stdout + done.stderr[-2000:]
    assert (folder / "code/models/dome.obj").is_file()
