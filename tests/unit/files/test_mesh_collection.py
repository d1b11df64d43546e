"""The collection of mesh files: each is read right, or refused with the true reason."""

import re

import numpy as np
import pytest

from data.mesh_files.collection import OWN, SUFFIXES, make_files
from data.mesh_files.patch import SPAN, height
from foldshell.files.errors import InputError
from foldshell.files.meshes.surface import read_surface

QUICK = {"text", "binary", "cut", "quads", "nan", "structured", "solid", "new", "old_binary"}
"""Of the formats that need a process each, these are tried in the quick tests too."""


def check_file(path, due):
    """Read a file; return what is wrong with the answer, nothing if it is right."""
    try:
        surface = read_surface(path, SPAN)
    except InputError as error:
        said = str(error)
        if isinstance(due, int):
            return f"refused: {said}"
        plain = said.startswith(f"{path}: ") and "\n" not in said and len(said) < 600
        return "" if plain and re.search(due, said) else f"says {said!r}, not {due!r}"
    if not isinstance(due, int):
        return f"read, not refused for {due!r}"
    if len(surface.triangles) != due:
        return f"{len(surface.triangles)} triangles, not {due}"
    x, y, z = surface.vertices.T
    off = float(np.abs(z - height(x, y)).max())
    corners = surface.vertices[surface.triangles][:, :, :2]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = float(np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum() / 2)
    # 1e-6 m: single precision of 3 m carries 2e-7 m
    return "" if off < 1e-6 and abs(area - SPAN**2) < 1e-5 else f"{off} m off, plan {area} m2"


def check_files(suffix, folder, chosen=lambda stem: True):
    """Check the chosen files of a format; return how many there were and what is wrong."""
    files = make_files(suffix, folder)
    wrong, number = [], 0
    for name, (data, due) in files.items():
        if not chosen(name.rpartition(".")[0]):
            continue
        number += 1
        (folder / "try").mkdir(exist_ok=True)
        path = folder / "try" / name
        path.write_bytes(data)
        answer = check_file(path, due)
        wrong += [f"{name}: {answer}"] if answer else []
    return number, wrong


@pytest.mark.parametrize("suffix", OWN)
def test_files_that_the_project_reads_itself(tmp_path, suffix):
    number, wrong = check_files(suffix, tmp_path)
    assert not wrong, "\n".join(wrong)
    assert number >= 45


@pytest.mark.parametrize("suffix", SUFFIXES[4:])
def test_some_files_that_libraries_read(tmp_path, suffix):
    number, wrong = check_files(suffix, tmp_path, QUICK.__contains__)
    assert number >= 4 and not wrong, "\n".join(wrong)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", SUFFIXES[4:])
def test_all_files_that_libraries_read(tmp_path, suffix):
    number, wrong = check_files(suffix, tmp_path)
    assert not wrong, "\n".join(wrong)
    assert number >= 40
