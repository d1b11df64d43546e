"""Mesh files that programs write and that are damaged: read right, or refused with the reason."""

import os
from pathlib import Path

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.files.meshes.read import FORMATS
from foldshell.files.meshes.surface import read_surface
from foldshell.folding.targets import make_target
from foldshell.settings.load_study import load_study
from foldshell.settings.make import make_settings

FAULTS = Path(__file__).parents[2] / "data" / "faults"
READ = ("capital_magic.ply", "patch.off", "slash.obj", "usemtl_empty.obj")
REFUSED = {
    "cut_off.ply": "169 elements 'vertex' announced, the file ends after 158",
    "too_many_faces.ply": "100000 elements 'face' announced, the file ends after 288",
    "too_many_vertices.ply": "1000000 elements 'vertex' announced",
    "wrong_count.stl": "counts 100 triangles, the file holds 288",
    "no_texture_vertices.obj": "line 5: corner '1/1/1': texture vertex 1: the file holds none",
    "lines_only.obj": "169 vertices and 1 line, no faces",
    "y_up.obj": "plan 6 x 1.44 m: must cover the span of 6 m .* y seems to be up",
    "far_from_origin.stl": "single precision, which holds them to 0.5 m only",
}


def test_every_file_has_its_answer():
    names = {path.name for path in FAULTS.iterdir()} - {"README.md"}
    assert names == {*READ, *REFUSED}


@pytest.mark.parametrize("name", READ)
def test_unusual_files_are_read(name):
    surface = read_surface(FAULTS / name, 6.0)
    assert len(surface.triangles) == 288 and len(surface.vertices) == 169
    corners = surface.vertices[surface.triangles]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.abs(double[:, 2]).sum() / 2 == pytest.approx(36, rel=1e-12)  # the plan, 6 x 6 m
    assert surface.vertices[:, 2].max() == pytest.approx(1.5, abs=1e-12)


@pytest.mark.parametrize("name", REFUSED)
def test_damaged_files_are_refused_with_the_reason(name):
    with pytest.raises(InputError, match=REFUSED[name]) as caught:
        read_surface(FAULTS / name, 6.0)
    assert str(caught.value).startswith(str(FAULTS / name)) and "\n" not in str(caught.value)


def write_table(folder, surface, span=6.0):
    table = folder / "designs.tsv"
    table.write_text(f"design\tsurface\tspan_m\na\t{surface}\t{span}\n", encoding="utf-8")
    return {"designs": str(table)}


@pytest.mark.parametrize("name", [*READ, *REFUSED])
def test_the_check_of_the_table_knows_before_any_job(tmp_path, name):
    config = write_table(tmp_path, FAULTS / name)
    if name in READ:
        assert load_study(config)[1][0].surface == str(FAULTS / name)
        return
    with pytest.raises(InputError, match=REFUSED[name]) as caught:
        load_study(config)
    assert f"{tmp_path / 'designs.tsv'}: design 'a': surface: " in str(caught.value)


def test_one_list_of_formats(tmp_path):
    """What the table takes can be read; what cannot be read, the table refuses."""
    for suffix in FORMATS:
        path = tmp_path / f"roof{suffix}"
        path.write_text("nothing of a mesh")
        with pytest.raises(InputError, match=f"roof{suffix}"):
            make_target(str(path), 6.0, 1.0)
    for suffix in (".3ds", ".glb", ".step", ".txt"):
        (tmp_path / f"roof{suffix}").write_text("nothing")
        with pytest.raises(InputError, match=r"\.stl, \.obj, \.ply, \.off, \.vtk, \.vtu"):
            load_study(write_table(tmp_path, tmp_path / f"roof{suffix}"))


def test_a_default_surface_is_checked_with_its_design(tmp_path):
    config = write_table(tmp_path, "") | {"defaults": {"surface": str(FAULTS / "wrong_count.stl")}}
    make_settings(config)
    with pytest.raises(InputError, match="counts 100 triangles"):
        load_study(config)


def test_what_is_no_plain_file_is_refused_at_once(tmp_path):
    """A pipe would be waited for without end, as a table and as a surface."""
    (tmp_path / "folder.obj").mkdir()
    os.mkfifo(tmp_path / "pipe.obj")
    (tmp_path / "gone.obj").symlink_to(tmp_path / "nothing")
    for name, reason in (
        ("folder", "plain file|directory"),
        ("pipe", "plain file"),
        ("gone", "no such"),
    ):
        with pytest.raises(InputError, match=reason):
            read_surface(tmp_path / f"{name}.obj", 6.0)
    os.mkfifo(tmp_path / "pipe.tsv")
    with pytest.raises(InputError, match=r"pipe\.tsv: cannot be read: not a plain file"):
        load_study({"designs": str(tmp_path / "pipe.tsv")})


def test_what_is_left_out_of_a_surface_is_said(tmp_path):
    text = (FAULTS / "slash.obj").read_text()
    (tmp_path / "twice.obj").write_text(text + "f 1// 14// 15// 2//\n")  # its first face again
    said = []
    load_study(write_table(tmp_path, tmp_path / "twice.obj"), say=said.append)
    assert said == [f"{tmp_path / 'twice.obj'}: 2 triangles that stood twice left out"]
