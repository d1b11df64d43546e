"""Exports of a design with loads of its own: the sums of each case, read back from the files."""

import importlib.util

import numpy as np
import openpyxl
import pytest

from export_cases import CASES, DESIGN, stage_settings, write_export_case
from foldshell.exchange.calculix import GRAVITY, deck
from foldshell.exchange.fe_mesh import divide_facets
from foldshell.exchange.ifc import write_ifc
from foldshell.exchange.model import SpreadLoad, combined_loads, load_on_facets
from foldshell.exchange.opensees import script
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.read_model import read_export_model
from foldshell.exchange.rhino import write_3dm
from foldshell.exchange.saf import list_members, write_saf
from foldshell.exchange.sap2000 import read_s2k, write_s2k
from foldshell.loads.cases import make_load_cases
from foldshell.settings.load_rows import LoadRow
from foldshell.settings.loads import Combinations, Loads
from foldshell.shell.mesh_files import read_mesh
from foldshell.shell.nodal_loads import sum_loads
from foldshell.shell.placed_loads import place_loads
from foldshell.shell.stiffness import build_operators

ROWS = (
    LoadRow("SW", "self_weight", None, "-z", action="permanent"),
    LoadRow("SNOW", "pressure", 0.8, "-z", "plan_up", "side x-", action="snow"),
    LoadRow("W", "pressure", 0.5, "-normal", "sheet", "box -9 -9 1.3 9", action="wind"),
    LoadRow("W", "pressure", -0.2, "-normal", "sheet", "box 1.3 -9 9 9", action="wind"),
    LoadRow("P", "force", 3.0, "0.6 0 -0.8", "sheet", "side y+"),
    LoadRow("T", "temperature", 20.0, "", action="temperature"),
)
GIVEN = Combinations(
    strength={"S1": {"SW": 1.35, "SNOW": 1.5, "W": 0.9}, "S2": {"SW": 1.35, "T": 1.5}},
    deflection={"D1": {"SW": 1.0, "P": 1.0}},
)
EXPECTED = ["SW", "SNOW", "W", "P"]


@pytest.fixture
def model(tmp_path):
    settings = stage_settings().changed(Loads(rows=tuple(row.to_text() for row in ROWS)), GIVEN)
    paths = write_export_case(tmp_path, **CASES["bent, graded, beam"])
    return read_export_model(paths, DESIGN, settings)


def sums(model):
    area = model.areas[:, None]
    loads = {case.case: load_on_facets(model, case) for case in model.load_cases}
    return {name: (load * area).sum(axis=0) for name, load in loads.items()}


def test_one_load_a_case_with_the_resultants_of_the_analysis(model, tmp_path):
    """Combinations with temperature are left out."""
    mesh, arrays = read_mesh(tmp_path / "mesh.npz")
    operators = build_operators(mesh, 0.2)
    loads = make_load_cases(Loads(rows=tuple(row.to_text() for row in ROWS)), 25.0)
    own = ~np.array([panel.sized for panel in model.panels])[mesh.panel]
    placed = place_loads(operators, own, loads)
    force, _ = sum_loads(operators, placed.at(model.thickness[mesh.facet]))
    assert [case.case for case in model.load_cases] == EXPECTED
    for name, total in sums(model).items():
        assert total == pytest.approx(force[:, placed.names.index(name)], abs=1e-9)
    assert list(model.combinations) == ["S1", "D1"] and len(arrays.fixed_thickness)
    assert [isinstance(case, SpreadLoad) for case in model.load_cases] == [False, True, True, True]
    whole = (combined_loads(model, "S1") * model.areas[:, None]).sum(axis=0)
    parts = sums(model)
    assert whole == pytest.approx(1.35 * parts["SW"] + 1.5 * parts["SNOW"] + 0.9 * parts["W"])


def test_s2k(model, tmp_path):
    write_s2k(model, (tmp_path / "a.s2k",), ExportOptions())
    tables = read_s2k(tmp_path / "a.s2k")
    mesh = divide_facets(model, 2, middles=False)
    point = mesh.nodes[mesh.corners]
    across = np.cross(point[:, 2] - point[:, 0], point[:, 3] - point[:, 1])
    area = np.linalg.norm(across, axis=1) / 2
    found = {name: np.zeros(3) for name in EXPECTED}
    for row in tables["AREA LOADS - UNIFORM"]:
        along = np.eye(3)["XYZ".index(row["Dir"])]
        found[row["LoadPat"]] += area[int(row["Area"]) - 1] * float(row["UnifLoad"]) * along
    for name, total in sums(model).items():
        if name != "SW":
            assert found[name] == pytest.approx(total, abs=1e-9)
    assert [row["LoadPat"] for row in tables["LOAD PATTERN DEFINITIONS"]] == EXPECTED


def test_saf(model, tmp_path):
    write_saf(model, (tmp_path / "a.xlsx",), ExportOptions())
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    head, *rows = book["StructuralSurfaceAction"].iter_rows(values_only=True)
    members = {member.name: model.areas[member.facets].sum() for member in list_members(model)}
    found = {name: np.zeros(3) for name in EXPECTED}
    for values in rows:
        row = dict(zip(head, values, strict=True))
        along = np.eye(3)["XYZ".index(row["Direction"])]
        size = members[row["2D Member"]] * row["Value [kN/m2]"]
        found[row["Load case"]] += size * along
    for name, total in sums(model).items():
        if name != "SW":
            assert found[name] == pytest.approx(total, abs=1e-9)
    kinds = [row[:4] for row in book["StructuralLoadCase"].iter_rows(min_row=2, values_only=True)]
    assert kinds[1][3] == "Snow" and kinds[2][2] == "LG wind"


def test_opensees(model, tmp_path):
    path = tmp_path / "model.py"
    path.write_text(script(model, 1).replace("import openseespy.opensees as ops", "ops = None"))
    spec = importlib.util.spec_from_file_location("exported_own", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name, total in sums(model).items():
        assert np.sum(list(module.LOADS[name].values()), axis=0) == pytest.approx(total, abs=1e-9)


def test_calculix(model):
    """Accelerations times mass, and pressures, of the first step: factors times resultants."""
    steps = deck(model, 1).split("*DLOAD, OP=NEW")[1:]
    mass = model.material.unit_weight / GRAVITY * model.thickness * model.areas
    total = np.zeros(3)
    for line in steps[0].split("*")[0].strip().splitlines():
        name, kind, *values = [word.strip() for word in line.split(",")]
        facet = int(name[1:])
        numbers = [float(value) for value in values]
        if kind == "GRAV":
            total += mass[facet] * numbers[0] * np.array(numbers[1:])
        else:
            total -= numbers[0] * model.areas[facet] * model.normals[facet]
    first = next(iter(model.combinations))
    exact = (combined_loads(model, first) * model.areas[:, None]).sum(axis=0)
    assert total == pytest.approx(exact, abs=1e-6)


def test_ifc_and_rhino_know_the_cases(model, tmp_path):
    ifcopenshell = pytest.importorskip("ifcopenshell")
    write_ifc(model, (tmp_path / "a.ifc",), ExportOptions())
    file = ifcopenshell.open(str(tmp_path / "a.ifc"))
    cases = {one.Name: one for one in file.by_type("IfcStructuralLoadCase")}
    assert list(cases) == EXPECTED
    assert cases["SNOW"].ActionSource == "SNOW_S" and cases["W"].ActionSource == "WIND_W"
    rhino = pytest.importorskip("rhino3dm")
    write_3dm(model, (tmp_path / "a.3dm",), ExportOptions())
    layers = {layer.Name for layer in rhino.File3dm.Read(str(tmp_path / "a.3dm")).Layers}
    assert {f"LOADS {name}" for name in EXPECTED} <= layers
