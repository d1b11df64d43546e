"""Directions, clamps and springs of a set of supports in every format that carries supports."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from export_cases import DESIGN, stage_settings, write_export_case
from foldshell.exchange.calculix import deck
from foldshell.exchange.fe_mesh import divide_facets
from foldshell.exchange.fe_supports import clamp_axes, held_rotations, spring_nodes
from foldshell.exchange.formats import FORMATS, name_files
from foldshell.exchange.neutral_model import make_neutral_model
from foldshell.exchange.opensees import script
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.read_model import read_export_model
from foldshell.exchange.sap2000 import read_s2k, write_s2k
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays
from foldshell.settings.support_row import SupportRow
from foldshell.shell.mesh_files import mesh_folded_sheet, write_mesh

ROWS = (
    SupportRow("root", "zigzag=first", "xyz", True),
    SupportRow("soft", "zigzag=last", "y", False, (300.0, 0.0, 2000.0)),
    SupportRow("post", "vertices 14", "", False, (0.0, 0.0, 150.0)),
)


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("supports")
    paths = write_export_case(folder)
    mesh = mesh_folded_sheet(read_arrays(folder / "folded.npz"), ROWS, 1)
    write_mesh(folder / "mesh.npz", mesh)
    model = read_export_model(paths, DESIGN | {"support": "mine"}, stage_settings())
    return mesh, model


def test_the_model_holds_every_row(case):
    _, model = case
    root, soft, post = model.supports
    assert root.clamp and root.fixed == (True, True, True)
    assert soft.spring == (300.0, 0.0, 2000.0) and soft.fixed == (False, True, False)
    assert post.vertices.tolist() == [14] and not len(post.edges)


@pytest.mark.parametrize("middles", [False, True])
def test_springs_at_nodes_add_up_to_those_of_the_line(case, middles):
    """k times the length of the edges, and the spring at the vertex, whatever the rule."""
    _, model = case
    mesh = divide_facets(model, 2, middles)
    total = np.sum(list(spring_nodes(model, mesh).values()), axis=0)
    ends = model.vertices[model.supports[1].edges]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    assert total == pytest.approx([300 * length, 0, 2000 * length + 150], rel=1e-12)


def test_a_skew_clamp_is_held_about_all_axes_where_it_is_pinned(case):
    _, model = case
    assert set(clamp_axes(model, model.supports[0])) == {(True, True, True)}
    mesh = divide_facets(model, 1, False)
    assert len(held_rotations(model, mesh)) == len(mesh.supported[0])


def test_a_skew_clamp_without_pins_is_refused(case):
    _, model = case
    loose = replace(model.supports[0], fixed=(False, False, True))
    with pytest.raises(InputError, match=r"support 'root': edge .* runs along no axis"):
        clamp_axes(model, loose)


def test_the_neutral_model_says_the_same(case):
    mesh, model = case
    plain = make_neutral_model(
        "small", mesh, np.full(len(model.panels), 0.05), stage_settings(),
        {"strength": ["S2"], "deflection": ["D2"]}, {},
    )  # fmt: skip
    root, soft, post = plain["supports"]
    assert root["clamp"] is True and "fix" not in root and "vertices" not in root
    assert soft["fix"] == ["y"] and soft["spring_kn_m2"] == [300.0, 0.0, 2000.0]
    assert post == {"name": "post", "vertices": [14], "fix": [], "spring_kn_m": [0.0, 0.0, 150.0]}


@pytest.mark.parametrize("name", ["3dm", "ifc", "saf", "s2k", "inp", "opensees"])
def test_every_format_writes_such_a_design(case, tmp_path, name):
    _, model = case
    known = FORMATS[name]
    for library in known.libraries:
        pytest.importorskip(library)
    paths = tuple(tmp_path / file for file in name_files(name, "small"))
    known.write(model, paths, ExportOptions())
    assert all(path.stat().st_size for path in paths)


def test_sap2000_gets_restraints_and_springs(case, tmp_path):
    _, model = case
    write_s2k(model, (tmp_path / "a.s2k",), None)
    tables = read_s2k(tmp_path / "a.s2k")
    held = tables["JOINT RESTRAINT ASSIGNMENTS"]
    clamped = [row for row in held if row["R1"] == "Yes"]
    assert clamped and all(row["U1"] == "Yes" and row["R3"] == "Yes" for row in clamped)
    assert any(row["U1"] == "No" and row["U2"] == "Yes" for row in held)
    springs = tables["JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED"]
    assert any(float(row["U3"]) == 150.0 and float(row["U1"]) == 0 for row in springs)


def test_calculix_gets_springs_to_the_ground(case):
    _, model = case
    text = deck(model, 1)
    springs = spring_nodes(model, divide_facets(model, 1, True))
    count = sum(value > 0 for stiffness in springs.values() for value in stiffness)
    assert text.count("TYPE=SPRING1") == count > 10


@pytest.mark.slow
def test_opensees_balances_with_springs(case, tmp_path):
    pytest.importorskip("openseespy")
    _, model = case
    (tmp_path / "run.py").write_text(script(model, 2))
    subprocess.run([sys.executable, "run.py", "out.json", "D1"], cwd=tmp_path, check=True,
                   capture_output=True, timeout=300)  # fmt: skip
    found = json.loads((tmp_path / "out.json").read_text())["combinations"]["D1"]
    gap = np.add(found["load_sum_kn"], found["reaction_sum_kn"])
    assert np.linalg.norm(gap) < 1e-6 * np.linalg.norm(found["load_sum_kn"])
