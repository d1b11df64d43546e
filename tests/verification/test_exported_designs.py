"""Exports of the designs of the study's size, by other programs and libraries.

`pytest -m slow tests/verification/test_exported_designs.py`. CalculiX is Debian's calculix-ccx,
OpenSees is `pip install openseespy`, rabbit-ear comes by npm; what is not there is skipped.
"""

import dataclasses
import json
import math
import os
import re
import shutil
import subprocess
import sys
import time

import numpy as np
import pytest
from exported_designs import COMPARED, NAMES, export_design

from export_cases import support_edges
from foldshell.exchange import opensees
from foldshell.exchange.calculix import deck
from foldshell.exchange.fe_mesh import _bilinear, divide_facets
from foldshell.exchange.flat_panels import flatten_panels
from foldshell.exchange.formats import FORMATS
from foldshell.exchange.ifc import write_ifc
from foldshell.exchange.model import combined_loads
from foldshell.exchange.nesting import nest_panels
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.solid import thicken
from foldshell.loads.cases import make_load_cases
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Loads
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.mesh import build_mesh, edge_polyline_nodes
from unit.exchange.test_panel_files import largest_gap
from unit.exchange.test_solid import mitred_volume

pytestmark = pytest.mark.slow
EVERY = pytest.mark.parametrize("name", NAMES)


@EVERY
def test_solid(name):
    """Watertight by trimesh; volume within 0.1 % of the panels cut exactly at their mitres."""
    trimesh = pytest.importorskip("trimesh")
    model, _ = export_design(name)
    solid = thicken(model)
    mesh = trimesh.Trimesh(solid.points, solid.triangles, process=False)
    assert mesh.is_watertight and mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(mitred_volume(model), rel=1e-3)


@EVERY
def test_panels_go_back(name):
    """Flat panels put back by their mitre and bend angles give the folded sheet to 1e-6 m."""
    assert largest_gap(export_design(name)[0]) < 1e-6


@EVERY
def test_ifc(name, tmp_path):
    """No issue of the validator."""
    ifcopenshell = pytest.importorskip("ifcopenshell")
    validate = pytest.importorskip("ifcopenshell.validate")
    write_ifc(export_design(name)[0], (tmp_path / "a.ifc",), ExportOptions())
    logger = validate.json_logger()
    validate.validate(ifcopenshell.open(str(tmp_path / "a.ifc")), logger)
    assert logger.statements == []


@EVERY
def test_nesting(name):
    """All panels that fit a sheet of 12 x 3 m are on one."""
    pytest.importorskip("shapely")
    pytest.importorskip("spyrrow")
    panels = flatten_panels(export_design(name)[0])
    nesting = nest_panels(panels, 12.0, 3.0, 20)
    found = [n for sheet in nesting.sheets for n in sheet.numbers]
    assert sorted([*found, *nesting.oversize]) == [panel.panel.number for panel in panels]
    print(f"{name}: {len(nesting.sheets)} sheets, {nesting.use:.3f}, {len(nesting.oversize)} large")


def run_ccx(text, folder):
    """Run CalculiX; return the .dat file. Its exit code is not believed."""
    (folder / "a.inp").write_text(text)
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        ["ccx", "-i", "a"], cwd=folder, capture_output=True, text=True, env=environment, check=False
    )
    assert "*ERROR" not in done.stdout and "Job finished" in done.stdout, done.stdout[-2000:]
    return (folder / "a.dat").read_text()


def serendipity(r, s):
    """Return the eight shape functions of a quadrilateral with middle nodes."""
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    one, two = r * signs[:, 0], s * signs[:, 1]
    corner = (1 + one) * (1 + two) * (one + two - 1) / 4
    middle = [(1 - r * r) * (1 - s), (1 + r) * (1 - s * s), (1 - r * r) * (1 + s),
              (1 - r) * (1 - s * s)]  # fmt: skip
    return np.concatenate([corner, np.array(middle) / 2])


def load_at_supports(model, mesh, name):
    """Return what S8R puts of a combination on supported nodes, kN: CalculiX leaves it out of its
    reactions."""
    load, force = combined_loads(model, name)[mesh.facet], np.zeros_like(mesh.nodes)
    point, root = mesh.nodes[mesh.corners], 1 / math.sqrt(3)
    for r in (-root, root):
        for s in (-root, root):
            tangents = np.einsum("kc,ecx->ekx", _bilinear(r, s)[1], point)
            area = np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)
            part = area[:, None, None] * serendipity(r, s)[:, None] * load[:, None]
            np.add.at(force, mesh.elements, part)
    return force[np.unique(np.concatenate(mesh.supported))].sum(axis=0)


def only(model, *names):
    """Return the model with some of its combinations."""
    kept = {name: model.combinations[name] for name in names}
    return dataclasses.replace(model, combinations=kept)


def last_force(text, name):
    """Return the last sum of forces that a .dat file gives for a set."""
    found = re.findall(rf"total force .* set {name} .*\n\n(.*)", text)
    return np.array(found[-1].split(), dtype=float)


needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="no CalculiX")


@needs_ccx
@EVERY
def test_weight_and_reactions_of_calculix(name, tmp_path):
    """Volume and reactions of S2 to 1e-5: its print has seven digits."""
    model = only(export_design(name)[0], "S2")
    text = deck(model, 1).split("** buckling factors")[0].rpartition("*STEP")[0]
    sets = "*ELSET, ELSET=EALL\n" + "\n".join(f"F{k}" for k in range(len(model.facets))) + "\n"
    text = text.replace("*STEP", sets + "*STEP", 1)
    text = text.replace("*END STEP", "*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEVOL\n*END STEP")
    found = run_ccx(text, tmp_path)
    volume = float(re.findall(r"total volume .*\n\n(.*)", found)[-1])
    assert volume == pytest.approx(model.volume, rel=1e-5)
    load = (combined_loads(model, "S2") * model.areas[:, None]).sum(axis=0)
    mesh = divide_facets(model, 1, middles=True)
    reaction = last_force(found, "SUPPORTED") - load_at_supports(model, mesh, "S2")
    assert np.linalg.norm(reaction + load) < 1e-5 * np.linalg.norm(load)


def run_opensees(model, n, folder, *names):
    """Run the exported script; return what it wrote."""
    (folder / "a.py").write_text(opensees.script(model, n))
    command = [sys.executable, folder / "a.py", folder / "a.json", *names]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads((folder / "a.json").read_text())


@EVERY
def test_weight_and_reactions_of_opensees(name, tmp_path):
    pytest.importorskip("openseespy", exc_type=(ImportError, RuntimeError))
    model, _ = export_design(name)
    found = run_opensees(model, 1, tmp_path, "S2")
    assert found["weight_kn"] == pytest.approx(25.0 * model.volume, rel=1e-5)
    load = (combined_loads(model, "S2") * model.areas[:, None]).sum(axis=0)
    reaction = np.array(found["combinations"]["S2"]["reaction_sum_kn"])
    assert np.linalg.norm(reaction + load) < 1e-5 * np.linalg.norm(load)


def own_values(model):
    """Return displacement of D2 (m, first order) and factor of S2 on a mesh of order 7: the limit
    of the project's own element to about 1 %."""
    mesh = build_mesh(model.vertices, model.facets, model.facet_panel, 4, 7 + 1)
    nodes = edge_polyline_nodes(mesh, support_edges(model))
    shell = build_model(mesh, nodes, model.material.poissons_ratio)
    cases = make_load_cases(Loads(), model.material.unit_weight)
    kept = {name: model.combinations[name] for name in ("S2", "D2")}
    thickness = model.thickness[mesh.facet]
    done = analyse_shell(shell, thickness, model.material, cases, kept, Analysis())
    moved = done.first_order[: 3 * len(mesh.nodes), 1].reshape(-1, 3)
    return -moved[:, 2].min(), float(done.buckling.factors[0])


@needs_ccx
@pytest.mark.parametrize("name", COMPARED)
def test_calculix_agrees(name, tmp_path):
    """Displacement of D2 within 5 %, lowest factor of S2 within 8 %, from the two meshes of the
    export. Displacements settle with n^-1.5, compliances to buckling (1 / factor) with n^-2: as
    three meshes of the first design show (docs/exports.md)."""
    model = only(export_design(name)[0], "D2", "S2")
    moved, factors = [], []
    for n in (1, 2):
        folder = tmp_path / str(n)
        folder.mkdir()
        found = run_ccx(deck(model, n), folder)
        mesh = divide_facets(model, n, middles=True)
        block = re.split(r"displacements \(vx.*\n\n", found)[1].splitlines()[: len(mesh.nodes)]
        moved.append(-min(float(row.split()[3]) for row in block))
        factors.append(float(re.search(r"FACTOR\n\n\s+1\s+(\S+)", found)[1]))
    displacement, factor = own_values(model)
    limit = moved[1] + (moved[1] - moved[0]) / (2**1.5 - 1)
    softness = 1 / factors[1] + (1 / factors[1] - 1 / factors[0]) / (2**2 - 1)
    print(f"{name}: D2 {moved} -> {limit:.5f} ({limit / displacement - 1:+.3f}); "
          f"S2 {factors} -> {1 / softness:.3f} ({1 / softness / factor - 1:+.3f})")  # fmt: skip
    assert limit == pytest.approx(displacement, rel=0.05)
    assert 1 / softness == pytest.approx(factor, rel=0.08)


@pytest.mark.parametrize("name", COMPARED)
def test_opensees_agrees(name, tmp_path):
    """Displacement of D2 within 5 %, from both meshes; ASDShellQ4 settles with 1 / n."""
    pytest.importorskip("openseespy", exc_type=(ImportError, RuntimeError))
    model, _ = export_design(name)
    moved = [
        run_opensees(model, n, tmp_path, "D2")["combinations"]["D2"]["displacement_down_max_m"]
        for n in opensees.MESHES
    ]
    limit, (displacement, _) = 2 * moved[1] - moved[0], own_values(model)
    print(f"{name}: D2 {moved} -> {limit:.5f} ({limit / displacement - 1:+.3f})")
    assert limit == pytest.approx(displacement, rel=0.05)


FOLD = """
const ear = require("rabbit-ear"), fs = require("fs");
const all = JSON.parse(fs.readFileSync(process.argv[2], "utf8")), graph = {};
for (const key of Object.keys(all)) if (/^(vertices|edges|faces)_/.test(key)) graph[key] = all[key];
console.log(JSON.stringify(ear.graph.makeVerticesCoordsFolded(graph, [0])));
"""


@pytest.mark.skipif(shutil.which("npm") is None, reason="no npm")
@pytest.mark.parametrize("name", ["paraboloid-all", "exact-hypar-zigzag"])
def test_rabbit_ear_folds_the_pattern_to_its_last_frame(name, tmp_path):
    """By the angles of the top frame, within 1e-9 m: the rest state of a pattern, and the folded
    sheet of an exact design."""
    install = ["npm", "install", "--silent", "rabbit-ear@0.9.32"]
    if subprocess.run(install, cwd=tmp_path, capture_output=True, check=False).returncode:
        pytest.skip("npm cannot reach its registry")
    model, folder = export_design(name)
    path = folder / "crease_pattern.fold"
    if name.startswith("exact"):
        path = tmp_path / "a.fold"
        sources = {"pattern": folder / "crease_pattern.fold"}
        FORMATS["fold"].write(model, (path,), ExportOptions(sources=sources))
    (tmp_path / "fold.js").write_text(FOLD)
    out = subprocess.run(["node", "fold.js", path], cwd=tmp_path, capture_output=True, check=True)
    frames = json.loads(path.read_text())["file_frames"]
    rest = np.array(frames[-1 if name.startswith("exact") else 0]["vertices_coords"])
    folded = np.array(json.loads(out.stdout))
    spread = [np.linalg.norm(p[:, None] - p[None], axis=2) for p in (folded, rest)]
    assert np.abs(spread[0] - spread[1]).max() < 1e-9


def test_all_formats_take_about_six_seconds(tmp_path):
    """Of a processor, nesting apart; on the machine it was written on 3.3 s."""
    model, folder = export_design("paraboloid-all")
    (folder / "design.vtu").write_text("fields")
    sources = {"pattern": folder / "crease_pattern.fold", "design_vtu": folder / "design.vtu"}
    total = 0.0
    for name, form in FORMATS.items():
        for library in form.libraries:
            pytest.importorskip(library)
        files = tuple(tmp_path / file.format(design="a") for file in form.files)
        began = time.process_time()
        form.write(model, files, ExportOptions(sources=sources))
        total += (time.process_time() - began) * (name != "nesting")
    print(f"all formats but nesting: {total:.1f} s")
    assert total < 12
