"""Files of geometry, read back by other libraries: 3dm, IFC, meshes, FOLD, panels, sheets."""

import itertools
import json
import math
from dataclasses import replace

import meshio
import numpy as np
import pytest

from export_cases import CASES, PANELS, make_export_model, support_edges, write_export_case
from foldshell.exchange.formats import FORMATS
from foldshell.exchange.ifc import write_ifc
from foldshell.exchange.mesh_files import write_glb, write_obj, write_ply, write_stl
from foldshell.exchange.options import PACKAGES, ExportOptions, load_library
from foldshell.exchange.rhino import hash_3dm, write_3dm
from foldshell.files.errors import InputError
from foldshell.files.meshes.read import read_mesh
from foldshell.settings.exports import FORMATS as NAMES

ALL = pytest.mark.parametrize("case", CASES)


def test_settings_and_registry_name_the_same_formats():
    assert set(NAMES) == set(FORMATS)


@ALL
def test_3dm_reads_back(tmp_path, case):
    """Corners to 1e-9 m, a valid Brep a planar panel or a facet, user text, creases by layer."""
    rhino = pytest.importorskip("rhino3dm")
    model = make_export_model(tmp_path, **CASES[case])
    path = tmp_path / "a.3dm"
    write_3dm(model, (path,), ExportOptions())
    file = rhino.File3dm.Read(str(path))
    assert file.Settings.ModelUnitSystem == rhino.UnitSystem.Meters and len(file.NamedViews) == 4
    layers = {}
    for item in file.Objects:
        layers.setdefault(file.Layers[item.Attributes.LayerIndex].Name, []).append(item)
    breps = [i for name, own in layers.items() for i in own if name.startswith(("PANELS", "EDGE"))]
    assert len(breps) == sum(1 if p.planar else len(p.facets) for p in model.panels)
    facet = dict.fromkeys(range(len(model.panels)), 0)
    for item in breps:
        brep, text = item.Geometry, dict(item.Attributes.GetUserStrings())
        assert brep.IsValid and len(brep.Faces) == 1 and brep.Faces[0].IsPlanar(1e-6)
        panel = model.panels[int(text["panel"])]
        assert float(text["thickness_m"]) == panel.thickness
        assert int(text["thickness_class"]) == panel.thickness_class
        mean = panel.values["utilization_panel_mean"]
        assert float(text["utilization_panel_mean"]) == mean
        ring = panel.corners if panel.planar else model.facets[panel.facets[facet[panel.number]]]
        facet[panel.number] += 1
        if not panel.planar:
            assert float(text["bend_deg"]) == pytest.approx(math.degrees(panel.bends[0]), abs=1e-6)
        ends = [brep.Vertices[k].Location for k in range(len(brep.Vertices))]
        ends = np.array([[p.X, p.Y, p.Z] for p in ends])
        gap = np.linalg.norm(ends[:, None] - model.vertices[ring], axis=2)
        assert len(ends) == len(ring) and gap.min(axis=0).max() < 1e-9
    for kind, name in (("M", "MOUNTAIN"), ("V", "VALLEY"), ("B", "BORDER")):
        assert len(layers[name]) == sum(crease.assignment == kind for crease in model.creases)
    assert len(layers["SUPPORTS"]) == len(support_edges(model))
    assert sum(len(own) for name, own in layers.items() if name.startswith("FLAT PATTERN"))


def test_3dm_content_does_not_change(tmp_path):
    """Bytes differ by identifiers and time, the hash of the content does not."""
    pytest.importorskip("rhino3dm")
    model = make_export_model(tmp_path)
    paths = [tmp_path / f"{name}.3dm" for name in "ab"]
    for path in paths:
        write_3dm(model, (path,), ExportOptions())
    assert hash_3dm(paths[0]) == hash_3dm(paths[1])
    other = make_export_model(tmp_path, thickness=np.full(PANELS, 0.051))
    write_3dm(other, (paths[1],), ExportOptions())
    assert hash_3dm(paths[0]) != hash_3dm(paths[1])
    paths[0].write_bytes(b"no Rhino file")
    with pytest.raises(InputError, match="damaged"):
        hash_3dm(paths[0])


@ALL
def test_ifc_is_valid_and_reads_back(tmp_path, case):
    """No issue of the validator; volumes, thickness and the analysis model close."""
    ifcopenshell = pytest.importorskip("ifcopenshell")
    validate = pytest.importorskip("ifcopenshell.validate")
    model = make_export_model(tmp_path, **CASES[case])
    path = tmp_path / "a.ifc"
    write_ifc(model, (path,), ExportOptions())
    file = ifcopenshell.open(str(path))
    logger = validate.json_logger()
    validate.validate(file, logger, express_rules=case == "bent, graded, beam")
    assert logger.statements == []
    volume = sum(quantity.VolumeValue for quantity in file.by_type("IfcQuantityVolume"))
    assert volume == pytest.approx(model.volume, rel=1e-9)
    members = file.by_type("IfcStructuralSurfaceMember")
    assert len(members) == len(file.by_type("IfcPlate"))
    assert {member.Thickness for member in members} == {p.thickness for p in model.panels}
    held = [c for c in file.by_type("IfcStructuralCurveConnection") if c.AppliedCondition]
    assert len(held) == len(support_edges(model))
    joined = {r.RelatedStructuralConnection for r in
              file.by_type("IfcRelConnectsStructuralMember")}  # fmt: skip
    assert set(held) <= joined
    for group in file.by_type("IfcStructuralLoadGroup"):
        if group.PredefinedType == "LOAD_COMBINATION":
            found = {r.RelatedObjects[0].Name: r.Factor for r in group.IsGroupedBy}
            assert found == dict(model.combinations[group.Name])
    places = {tuple(v.VertexGeometry.Coordinates) for v in file.by_type("IfcVertexPoint")}
    assert places == {tuple(v) for v in model.vertices.tolist()}


def test_ifc_plates_have_the_volume_of_their_panels(tmp_path):
    """The geometry engine of the library, not the written quantities: 1e-6."""
    ifcopenshell = pytest.importorskip("ifcopenshell")
    geom = pytest.importorskip("ifcopenshell.geom")
    trimesh = pytest.importorskip("trimesh")
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    write_ifc(model, (tmp_path / "a.ifc",), ExportOptions())
    file, total = ifcopenshell.open(str(tmp_path / "a.ifc")), 0.0
    for plate in file.by_type("IfcPlate"):
        shape = geom.create_shape(geom.settings(), plate).geometry
        mesh = trimesh.Trimesh(np.reshape(shape.verts, (-1, 3)), np.reshape(shape.faces, (-1, 3)))
        assert mesh.is_watertight
        total += mesh.volume
    assert total == pytest.approx(model.volume, rel=1e-6)


def test_meshes_read_back(tmp_path):
    """By trimesh, meshio and VTK: facets, solids closed, doubles where the format has them."""
    trimesh = pytest.importorskip("trimesh")
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    writers = {"obj": write_obj, "stl": write_stl, "ply": write_ply, "glb": write_glb}
    for kind, write in writers.items():
        paths = [tmp_path / f"{name}.{kind}" for name in ("sheet", "solid")]
        more = (tmp_path / "sheet.mtl",) if kind == "obj" else ()
        write(model, (*paths, *more), ExportOptions())
        solid = trimesh.load(paths[1], force="mesh")
        if kind == "glb":  # y up, every triangle by itself
            solid.merge_vertices(merge_tex=True, merge_norm=True)
            high = solid.bounds[1, [0, 2, 1]]
            assert high[2] == pytest.approx(model.vertices[:, 2].max() + 0.06, abs=0.1)
        assert solid.is_watertight and solid.volume == pytest.approx(model.volume, rel=0.01), kind
        sheet = trimesh.load(paths[0], force="mesh", process=False)
        assert len(sheet.faces) == len(model.facets)
        assert sheet.area == pytest.approx(model.areas.sum(), rel=1e-6)
    points = meshio.read(tmp_path / "sheet.obj").points
    assert np.array_equal(points, model.vertices)
    assert "usemtl class2" in (tmp_path / "sheet.obj").read_text()


@pytest.mark.parametrize("name", ["obj", "stl", "ply", "glb"])
def test_a_sheet_on_a_national_grid_keeps_its_digits(tmp_path, name):
    """Single precision has 0.5 m left there: STL becomes text, GLB is moved by a transformation."""
    trimesh = pytest.importorskip("trimesh")
    model = make_export_model(tmp_path, **CASES[next(iter(CASES))])
    place = np.array([690_000.0, 5_334_000.0, 520.0])
    far = replace(model, vertices=model.vertices + place)
    files = tuple(tmp_path / f"{part}.{end}" for part, end in
                  (("sheet", name), ("solid", name), ("sheet", "mtl")))  # fmt: skip
    writers = {"obj": write_obj, "stl": write_stl, "ply": write_ply, "glb": write_glb}
    writers[name](far, files if name == "obj" else files[:2], ExportOptions())
    if name == "glb":
        scene = trimesh.load_scene(files[0])
        points = np.vstack([
            scene.geometry[scene.graph[node][1]].vertices.astype(float)
            + scene.graph[node][0][:3, 3] for node in scene.graph.nodes_geometry
        ])[:, [0, 2, 1]] * [1, -1, 1]  # fmt: skip
    else:
        points = read_mesh(files[0]).vertices
    gaps = np.linalg.norm(points[:, None] - far.vertices[None], axis=2)
    assert gaps.min(axis=1).max() < 1e-6 and gaps.min(axis=0).max() < 1e-6


@pytest.mark.parametrize("name", ["obj", "stl", "ply", "glb", "ifc", "saf", "s2k", "inp",
                                  "opensees", "panels", "fold"])  # fmt: skip
def test_same_design_gives_the_same_bytes(tmp_path, name):
    for library in FORMATS[name].libraries:
        pytest.importorskip(library)
    options = options_of(tmp_path)
    model = make_export_model(tmp_path, **CASES["graded"])
    found = []
    for folder in ("a", "b"):
        files = tuple(
            tmp_path / folder / file.format(design="small") for file in FORMATS[name].files
        )
        FORMATS[name].write(model, files, options)
        found.append([file.read_bytes() for file in files])
    assert found[0] == found[1]


def options_of(folder):
    """Return options with the pattern that the case is made of."""
    from foldshell.pattern.fold_format import write_fold
    from foldshell.pattern.miura import Miura
    from foldshell.pattern.sheet import make_miura_sheet

    sheet = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), 5, 6), 3)
    write_fold(folder / "crease_pattern.fold", sheet, "small")
    return ExportOptions(sources={"pattern": folder / "crease_pattern.fold"})


def test_fold_file_leads_to_the_folded_sheet(tmp_path):
    """Rigid Miura: lengths stay, no frame jumps, the last one is the sheet; angles are targets."""
    options = options_of(tmp_path)
    model = make_export_model(tmp_path)
    FORMATS["fold"].write(model, (tmp_path / "a.fold",), options)
    data = json.loads((tmp_path / "a.fold").read_text())
    states = [np.array(frame["vertices_coords"]) for frame in data["file_frames"]]
    assert np.abs(states[-1] - model.vertices).max() < 1e-12
    edges = np.array(data["edges_vertices"])
    lengths = [np.linalg.norm(s[edges[:, 0]] - s[edges[:, 1]], axis=1) for s in states]
    assert all(np.abs(one - lengths[0]).max() < 1e-9 for one in lengths)
    steps = [np.linalg.norm(b - a, axis=1).max() for a, b in itertools.pairwise(states)]
    assert max(steps) < 0.5 and len(states) == 10
    assert data["edges_foldAngle"] == data["file_frames"][-1]["edges_foldAngle"]


def test_missing_library_is_one_sentence(monkeypatch):
    import importlib

    def refuse(name):
        raise ImportError(name)

    monkeypatch.setattr(importlib, "import_module", refuse)
    for name, package in PACKAGES.items():
        with pytest.raises(InputError, match=f"library {package} is not installed"):
            load_library(name)


def test_entry_script_writes_files_and_record(tmp_path):
    import export
    from export_cases import DESIGN
    from foldshell.settings.make import make_settings
    from foldshell.settings.stages import stage_parameters

    inputs = write_export_case(tmp_path)
    inputs |= {"pattern": tmp_path / "none.fold", "design_vtu": tmp_path / "none.vtu"}
    made = make_settings({})
    plain = {k: v for s in ("crosscheck", "drawings", "exports")
             for k, v in stage_parameters(made, s).items()}  # fmt: skip
    files = [tmp_path / "sheet.stl", tmp_path / "solid.stl"]
    export.main(inputs, tmp_path / "stl.json", files, format_name="stl", design=DESIGN,
                settings=plain)  # fmt: skip
    record = json.loads((tmp_path / "stl.json").read_text())
    assert set(record["files"]) == {"sheet.stl", "solid.stl"} and record["format"] == "stl"
