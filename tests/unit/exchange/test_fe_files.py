"""Decks for FE programs: mesh, loads and supports close with the model; files read back."""

import importlib.util
import json
import re
import subprocess
import sys

import numpy as np
import openpyxl
import pytest

from export_cases import CASES, make_export_model, support_edges
from foldshell.exchange.calculix import deck
from foldshell.exchange.fe_mesh import divide_facets, mesh_loads
from foldshell.exchange.model import combined_loads, load_on_facets
from foldshell.exchange.opensees import script
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.saf import list_members, write_saf
from foldshell.exchange.sap2000 import read_s2k, write_s2k
from foldshell.files.errors import InputError


def total_load(model, name):
    """Return the resultant of a combination, kN: facet by facet."""
    return (combined_loads(model, name) * model.areas[:, None]).sum(axis=0)


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("case", ["planar", "bent, graded, beam"])
def test_mesh_covers_the_facets_once(tmp_path, case, n):
    """3 n^2 elements a facet, their areas add up, middles lie half way, no node twice."""
    model = make_export_model(tmp_path, **CASES[case])
    mesh = divide_facets(model, n, middles=True)
    assert len(mesh.corners) == 3 * n * n * len(model.facets)
    point = mesh.nodes[mesh.corners]
    diagonals = point[:, 2] - point[:, 0], point[:, 3] - point[:, 1]
    area = np.cross(*diagonals) / 2
    sums = np.bincount(mesh.facet, np.einsum("ex,ex->e", area, model.normals[mesh.facet]))
    assert sums == pytest.approx(model.areas, rel=1e-12)
    half = (point + np.roll(point, -1, axis=1)) / 2
    assert np.abs(mesh.nodes[mesh.middles] - half).max() < 1e-12
    assert len(np.unique(mesh.nodes.round(9), axis=0)) == len(mesh.nodes)
    assert len(np.unique(mesh.elements)) == len(mesh.nodes)


def test_supported_nodes_are_those_on_the_edges(tmp_path):
    model = make_export_model(tmp_path)
    mesh = divide_facets(model, 2, middles=True)
    supported = np.unique(np.concatenate(mesh.supported))
    ends = model.vertices[support_edges(model)]
    along, away = ends[:, 1] - ends[:, 0], mesh.nodes[:, None] - ends[:, 0]
    part = np.einsum("nkx,kx->nk", away, along) / np.einsum("kx,kx->k", along, along)
    gap = np.linalg.norm(away - np.clip(part, 0, 1)[..., None] * along, axis=2).min(axis=1)
    assert np.array_equal(np.flatnonzero(gap < 1e-9), supported)


@pytest.mark.parametrize("case", CASES)
def test_nodal_loads_have_the_resultant_and_moment_of_the_facets(tmp_path, case):
    model = make_export_model(tmp_path, **CASES[case])
    mesh = divide_facets(model, 2, middles=False)
    load = combined_loads(model, "S2")
    force = mesh_loads(model, mesh, load)
    assert force.sum(axis=0) == pytest.approx(total_load(model, "S2"), rel=1e-12, abs=1e-12)
    middle = model.vertices[model.facets].mean(axis=1)
    moment = np.cross(middle, load * model.areas[:, None]).sum(axis=0)
    assert np.cross(mesh.nodes, force).sum(axis=0) == pytest.approx(moment, abs=1e-9)


def read_deck(text):
    """Return nodes, elements by set, sections by panel, and loads by step of an .inp file."""
    nodes, facets, panels, thickness, steps = {}, {}, {}, {}, []
    for block in re.split(r"(?m)^(?=\*[A-Z])", text)[1:]:
        head, *lines = [line for line in block.splitlines() if not line.startswith("**")]
        rows = [[word.strip() for word in line.split(",")] for line in lines]
        name = head.split(",")[0]
        if name == "*NODE":
            nodes = {int(row[0]): np.array(row[1:], dtype=float) for row in rows}
        elif name == "*ELEMENT":
            assert "TYPE=S8R" in head
            facets[head.split("ELSET=")[1]] = [[int(v) for v in row[1:]] for row in rows]
        elif name == "*ELSET":
            panels[head.split("ELSET=")[1]] = [row[0] for row in rows]
        elif name == "*SHELL SECTION":
            thickness[re.search(r"ELSET=(\w+)", head)[1]] = float(rows[0][0])
        elif name == "*DLOAD":
            steps.append(rows)
    return nodes, facets, panels, thickness, steps


@pytest.mark.parametrize("case", ["planar", "bent, graded, beam"])
def test_deck_holds_thickness_geometry_and_loads(tmp_path, case):
    """Read by another reader: areas and loads of all steps give the model's weight and resultants.

    Numbers of the deck have 12 digits: 1e-9 m of coordinates, 1e-9 of loads.
    """
    model = make_export_model(tmp_path, **CASES[case])
    nodes, facets, panels, thickness, steps = read_deck(deck(model, 1))
    mesh = divide_facets(model, 1, middles=True)
    assert np.abs(np.array(list(nodes.values())) - mesh.nodes).max() < 1e-9
    assert thickness == pytest.approx({panel.name: panel.thickness for panel in model.panels})
    own = {facet: thickness[panel] for panel, list_ in panels.items() for facet in list_}
    area, normal = {}, {}
    for name, elements in facets.items():
        points = np.array([[nodes[n] for n in element[:4]] for element in elements])
        vector = np.cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1]).sum(axis=0) / 2
        area[name] = np.linalg.norm(vector)
        normal[name] = vector / area[name]
    assert sum(area[f] * own[f] for f in facets) == pytest.approx(model.volume, rel=1e-9)
    density = model.material.unit_weight / 9.80665
    names = [*model.combinations, model.compared["strength"]]
    for name, rows in zip(names, steps, strict=True):
        total = np.zeros(3)
        for facet, kind, *values in rows:
            numbers = np.array(values, dtype=float)
            if kind == "GRAV":
                total += density * own[facet] * area[facet] * numbers[0] * numbers[1:]
            else:
                total += area[facet] * numbers[0] * normal[facet]
        assert total == pytest.approx(total_load(model, name), rel=1e-9, abs=1e-9)


def test_s2k_reads_back(tmp_path):
    """Coordinates to the last digit, thickness, counts, loads by area and case, P-Delta."""
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    path = tmp_path / "a.s2k"
    write_s2k(model, (path,), ExportOptions())
    tables = read_s2k(path)
    assert tables["PROGRAM CONTROL"][0]["CurrUnits"] == "KN, m, C"
    mesh = divide_facets(model, 2, middles=False)
    places = [[float(row[k]) for k in ("XorR", "Y", "Z")] for row in tables["JOINT COORDINATES"]]
    assert np.array_equal(places, mesh.nodes)
    sections = {row["Section"]: row for row in tables["AREA SECTION PROPERTIES"]}
    assert {row["Type"] for row in sections.values()} == {"Shell-Thin"}
    joints = [[int(row[f"Joint{k}"]) - 1 for k in range(1, 5)]
              for row in tables["CONNECTIVITY - AREA"]]  # fmt: skip
    point = np.array(places)[np.array(joints)]
    vector = np.cross(point[:, 2] - point[:, 0], point[:, 3] - point[:, 1]) / 2
    area = np.linalg.norm(vector, axis=1)
    thick = [float(sections[row["Section"]]["Thickness"])
             for row in tables["AREA SECTION ASSIGNMENTS"]]  # fmt: skip
    assert area @ thick == pytest.approx(model.volume, rel=1e-12)
    held = {int(row["Joint"]) - 1 for row in tables["JOINT RESTRAINT ASSIGNMENTS"]}
    assert held == set(np.concatenate(mesh.supported).tolist())
    sums = {case.case: np.zeros(3) for case in model.load_cases}
    for row in tables["AREA LOADS - UNIFORM"]:
        k, value = int(row["Area"]) - 1, float(row["UnifLoad"])
        along = {"3": vector[k] / area[k], "Gravity": np.array([0, 0, -1.0]),
                 "X": np.eye(3)[0], "Y": np.eye(3)[1]}[row["Dir"]]  # fmt: skip
        sums[row["LoadPat"]] += area[k] * value * along
    for case in model.load_cases[1:]:
        exact = (load_on_facets(model, case) * model.areas[:, None]).sum(axis=0)
        assert sums[case.case] == pytest.approx(exact, abs=1e-9)
    kinds = {
        row["Case"]: row["GeoNonLin"] for row in tables["CASE - STATIC 4 - NONLINEAR PARAMETERS"]
    }
    assert kinds == dict.fromkeys(model.combinations, "P-Delta")
    found = {}
    for row in tables["CASE - STATIC 1 - LOAD ASSIGNMENTS"]:
        found.setdefault(row["Case"], {})[row["LoadName"]] = float(row["LoadSF"])
    assert found == {name: dict(factors) for name, factors in model.combinations.items()}


def test_cut_off_s2k_is_refused(tmp_path):
    write_s2k(make_export_model(tmp_path), (tmp_path / "a.s2k",), ExportOptions())
    text = (tmp_path / "a.s2k").read_text()
    (tmp_path / "b.s2k").write_text(text[: len(text) // 2])
    with pytest.raises(InputError, match="cut off"):
        read_s2k(tmp_path / "b.s2k")


def read_sheet(book, name):
    """Return the rows of a sheet as dictionaries."""
    head, *rows = book[name].iter_rows(values_only=True)
    return [dict(zip(head, row, strict=True)) for row in rows]


@pytest.mark.parametrize("basis", ["sheet", "plan_abs"])
def test_saf_reads_back(tmp_path, basis):
    """By openpyxl, not XlsxWriter: coordinates to 1e-9 m, thickness, loads by case, factors."""
    case = CASES["bent, graded, beam"] | {"loads": {"area_basis": basis}}
    model = make_export_model(tmp_path, **case)
    write_saf(model, (tmp_path / "a.xlsx",), ExportOptions())
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    assert dict(book["Model"].iter_rows(values_only=True))["SAF Version"].startswith("2.")
    nodes = {row["Name"]: np.array([row[f"Coordinate {a} [m]"] for a in "XYZ"])
             for row in read_sheet(book, "StructuralPointConnection")}  # fmt: skip
    assert np.abs(np.array(list(nodes.values())) - model.vertices).max() < 1e-9
    areas, volume = {}, 0.0
    for row in read_sheet(book, "StructuralSurfaceMember"):
        points = np.array([nodes[name] for name in row["Nodes"].split("; ")])
        assert len(row["Edges"].split("; ")) == len(points)
        spokes = points - points[0]
        areas[row["Name"]] = np.cross(spokes, np.roll(spokes, -1, axis=0)).sum(axis=0) / 2
        size = np.linalg.norm(areas[row["Name"]])
        assert row["Area [m2]"] == pytest.approx(size, rel=1e-9)
        volume += size * float(row["Thickness [mm]"]) / 1000
    assert volume == pytest.approx(model.volume, rel=1e-9)
    sums = {case.case: np.zeros(3) for case in model.load_cases}
    for row in read_sheet(book, "StructuralSurfaceAction"):
        vector = areas[row["2D Member"]]
        size = np.linalg.norm(vector)
        if row["Coordinate system"] == "Local":
            along = vector / size
        else:
            along = np.eye(3)["XYZ".index(row["Direction"])]
        if row["Location"] == "Projection":
            size = abs(vector @ along)
        sums[row["Load case"]] += size * row["Value [kN/m2]"] * along
    for case in model.load_cases[1:]:
        exact = (load_on_facets(model, case) * model.areas[:, None]).sum(axis=0)
        assert sums[case.case] == pytest.approx(exact, abs=1e-9)
    for row in read_sheet(book, "StructuralLoadCombination"):
        found = {row[f"Load case name {k}"]: row[f"Load factor {k}"] for k in range(1, 5)}
        found.pop(None, None)
        assert found == dict(model.combinations[row["Name"]])
    edges = read_sheet(book, "StructuralEdgeConnection")
    assert len(edges) == len(support_edges(model))
    held = set()
    members = {m.name: m.vertices for m in list_members(model)}
    for row in edges:
        ring, k = members[row["2D Member"]], row["Edge"] - 1
        held.add(tuple(sorted((ring[k], ring[(k + 1) % len(ring)]))))
        assert (row["ux"], row["uy"], row["uz"], row["fix"]) == ("Rigid",) * 3 + ("Free",)
    assert held == {tuple(sorted(edge)) for edge in support_edges(model).tolist()}


def test_opensees_script_holds_the_model(tmp_path):
    """Imported with a stand-in for OpenSees: elements, thickness and resultants of all cases."""
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    path = tmp_path / "model.py"
    path.write_text(script(model, 1).replace("import openseespy.opensees as ops", "ops = None"))
    spec = importlib.util.spec_from_file_location("exported", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    point = np.array(module.NODES)[np.array(module.ELEMENTS)[:, 1:] - 1]
    area = (
        np.linalg.norm(np.cross(point[:, 2] - point[:, 0], point[:, 3] - point[:, 1]), axis=1) / 2
    )
    thick = np.array(module.THICKNESS)[np.array(module.ELEMENTS)[:, 0]]
    assert area @ thick * model.material.unit_weight == pytest.approx(module.WEIGHT, rel=1e-12)
    for case in model.load_cases:
        found = np.sum(list(module.LOADS[case.case].values()), axis=0)
        exact = (load_on_facets(model, case) * model.areas[:, None]).sum(axis=0)
        assert found == pytest.approx(exact, abs=1e-9)
    assert {k: dict(v) for k, v in model.combinations.items()} == module.COMBINATIONS


def test_opensees_runs_a_small_design(tmp_path):
    """Reactions balance the loads to 1e-8, and the weight is the design's."""
    pytest.importorskip("openseespy", exc_type=(ImportError, RuntimeError))
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    (tmp_path / "m.py").write_text(script(model, 1))
    command = [sys.executable, tmp_path / "m.py", tmp_path / "o.json", "S2", "D2"]
    subprocess.run(command, check=True, capture_output=True)
    found = json.loads((tmp_path / "o.json").read_text())
    assert found["weight_kn"] == pytest.approx(25 * model.volume)
    for name, values in found["combinations"].items():
        load = np.array(values["load_sum_kn"])
        assert load == pytest.approx(total_load(model, name), abs=1e-9)
        gap = np.linalg.norm(load + values["reaction_sum_kn"])
        assert gap < 1e-8 * np.linalg.norm(load)
        assert 0 < values["displacement_down_max_m"] < 0.1
