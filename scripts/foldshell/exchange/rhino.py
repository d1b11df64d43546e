"""Rhino's .3dm: panels as planar Breps, creases, supports, loads, target and flat pattern; in m.

Breps and lines are double precision; Rhino's meshes are single, so none stands for analysis
geometry (a target that is a mesh file is one, on a layer of its own).
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.exchange.colours import ASSIGNMENTS, class_colours
from foldshell.exchange.model import Crease, ExportModel, Panel, Support, load_on_facets
from foldshell.exchange.options import ExportOptions, load_library
from foldshell.files.errors import InputError
from foldshell.files.whole import atomic_path, hash_data
from foldshell.folding.quadric import Quadric
from foldshell.folding.targets import make_target
from foldshell.settings.design import NONE

GAP, ARROW = 0.15, 0.04
"""Between roof and flat pattern, and length of an arrow of 1 kN/m2: parts of the design's size."""
LAYERS = {"M": "MOUNTAIN", "V": "VALLEY", "B": "BORDER", "F": "FLAT"}


@dataclass(frozen=True)
class _Scene:
    """A .3dm file that is being filled, and its library."""

    rhino: object
    file: object
    layers: dict[str, int]

    def attributes(self, layer: str, name: str = "", text: dict[str, str] | None = None):
        """Return attributes of an object on a layer, with its name and user text."""
        made = self.rhino.ObjectAttributes()
        made.LayerIndex = self.layers[layer]
        made.Name = name
        for key, value in (text or {}).items():
            made.SetUserString(key, value)
        return made

    def point(self, values):
        """Return a point."""
        return self.rhino.Point3d(*(float(v) for v in values))

    def add_line(self, ends, layer: str, name: str = "", text=None, arrow: bool = False) -> None:
        """Add the line between two points, with an arrowhead at its end or without."""
        made = self.attributes(layer, name, text)
        if arrow:
            made.ObjectDecoration = self.rhino.ObjectDecoration.EndArrowhead
        self.file.Objects.AddCurve(self.rhino.LineCurve(*map(self.point, ends)), made)

    def add_face(self, corners: np.ndarray, layer: str, name: str, text: dict[str, str]) -> None:
        """Add a planar Brep with corners (k, 3)."""
        span = corners[2] - corners[0]
        plane = self.rhino.Plane(
            self.point(corners[0]),
            self.rhino.Vector3d(*(corners[1] - corners[0])),
            self.rhino.Vector3d(*span),
        )
        ring = self.rhino.Polyline([self.point(p) for p in (*corners, corners[0])])
        brep = self.rhino.Brep.CreateTrimmedPlane(plane, ring.ToPolylineCurve())
        if brep is None or not brep.IsValid:
            raise InputError(f"exports: 3dm: panel {name}: its corners make no planar face")
        self.file.Objects.AddBrep(brep, self.attributes(layer, name, text))


def write_3dm(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the .3dm file of a design."""
    scene = _open_scene(model)
    for panel in model.panels:
        _add_panel(scene, model, panel)
    for crease in model.creases:
        ends = model.vertices[list(crease.ends)]
        scene.add_line(ends, LAYERS[crease.assignment], _crease_name(model, crease),
                       _crease_text(model, crease))  # fmt: skip
    for support in model.supports:
        text = _support_text(support)
        for ends in model.vertices[support.edges]:
            scene.add_line(ends, "SUPPORTS", support.name, text)
        for point in model.vertices[support.vertices]:
            made = scene.attributes("SUPPORTS", support.name, text)
            scene.file.Objects.AddPoint(scene.point(point), made)
    _add_loads(scene, model)
    _add_target(scene, model)
    _add_flat(scene, model)
    _add_views(scene, model)
    with atomic_path(paths[0]) as temporary:
        if not scene.file.Write(str(temporary), 8):
            raise InputError(f"{paths[0]}: Rhino's library could not write the file")


def _support_text(support: Support) -> dict[str, str]:
    """Return what is held along x, y, z, and clamps and springs where there are some."""
    found = {"fixed": "".join(a for a, held in zip("xyz", support.fixed, strict=True) if held)}
    if support.clamp:
        found["clamp"] = "rotation about the edge"
    if any(support.spring):
        unit = "kN/m per m" if len(support.edges) else "kN/m"
        found["spring"] = " ".join(f"{value:g}" for value in support.spring) + f" {unit}"
    return found


def hash_3dm(path: Path) -> str:
    """Return a hash of what a .3dm file holds, whatever its identifiers and time: layer, name, user
    text and box of every object."""
    rhino = load_library("rhino3dm")
    file = rhino.File3dm.Read(str(path))
    if file is None:
        raise InputError(f"{path}: damaged, no .3dm file")
    rows = []
    for item in file.Objects:
        box = item.Geometry.GetBoundingBox()
        ends = [[p.X, p.Y, p.Z] for p in (box.Min, box.Max)]
        text = sorted(map(list, item.Attributes.GetUserStrings()))
        rows.append([item.Attributes.LayerIndex, item.Attributes.Name, text, ends])
    return hash_data([[layer.Name for layer in file.Layers], rows])


def _open_scene(model: ExportModel) -> _Scene:
    rhino = load_library("rhino3dm")
    file = rhino.File3dm()
    file.ApplicationName = "foldshell"
    file.Settings.ModelUnitSystem = rhino.UnitSystem.Meters
    file.Settings.ModelAbsoluteTolerance = 1e-6
    scene = _Scene(rhino, file, {})
    classes = class_colours(model)
    colours = {f"PANELS class {number}": colour for number, colour in classes.items() if number}
    colours |= {"PANELS": (150, 150, 150), "EDGE BEAM": (190, 190, 190)}
    colours |= {LAYERS[kind]: colour for kind, colour in ASSIGNMENTS.items()}
    colours |= {"BEND": (160, 160, 160), "SUPPORTS": (0, 130, 60), "TARGET": (120, 160, 220)}
    colours |= {f"LOADS {case.case}": (200, 90, 0) for case in model.load_cases}
    colours |= {f"FLAT PATTERN {LAYERS[kind]}": ASSIGNMENTS[kind] for kind in "MVBF"}
    for name, (red, green, blue) in colours.items():
        layer = rhino.Layer()
        layer.Name, layer.Color = name, (red, green, blue, 255)
        layer.Visible = not name.startswith("LOADS")
        scene.layers[name] = file.Layers.Add(layer)
    return scene


def _add_panel(scene: _Scene, model: ExportModel, panel: Panel) -> None:
    layer = f"PANELS class {panel.thickness_class}" if panel.thickness_class else "PANELS"
    layer = layer if panel.sized else "EDGE BEAM"
    text = _panel_text(model, panel)
    if panel.planar:
        scene.add_face(model.vertices[panel.corners], layer, panel.name, text)
        return
    for ends, bend in zip(panel.inner, panel.bends, strict=True):
        angle = {"panel": str(panel.number), "bend_deg": f"{math.degrees(bend):.9g}"}
        scene.add_line(model.vertices[ends], "BEND", panel.name, angle)
    text["bend_deg"] = " ".join(f"{math.degrees(bend):.9g}" for bend in panel.bends)
    for k, facet in enumerate(panel.facets):
        corners = model.vertices[model.facets[facet]]
        scene.add_face(corners, layer, f"{panel.name}.{k + 1}", text | {"facet": str(k + 1)})


def _panel_text(model: ExportModel, panel: Panel) -> dict[str, str]:
    text = {
        "panel": str(panel.number),
        "thickness_m": repr(panel.thickness),
        "thickness_class": str(panel.thickness_class),
        "area_m2": repr(float(model.panel_areas[panel.number])),
        "planar": "yes" if panel.planar else "no",
        "flatness_m": f"{panel.flatness:.3e}",
    }
    if panel.class_thickness is not None:
        text["class_thickness_m"] = repr(panel.class_thickness)
    return text | {name: repr(value) for name, value in panel.values.items()}


def _crease_name(model: ExportModel, crease: Crease) -> str:
    return " | ".join(model.panels[number].name for number in crease.panels)


def _crease_text(model: ExportModel, crease: Crease) -> dict[str, str]:
    angle = "" if math.isnan(crease.angle) else repr(math.degrees(crease.angle))
    return {"assignment": crease.assignment, "fold_angle_deg": angle,
            "panels": " ".join(str(number) for number in crease.panels)}  # fmt: skip


def _size(model: ExportModel) -> float:
    return float(np.ptp(model.vertices, axis=0).max())


def _add_loads(scene: _Scene, model: ExportModel) -> None:
    """Add an arrow for each case and panel that carries it: direction and size of its load."""
    scale = ARROW * _size(model)
    for case in model.load_cases:
        load = load_on_facets(model, case)
        for panel in model.panels:
            vector = load[panel.facets[0]]
            if not vector.any():
                continue
            middle = model.vertices[panel.corners].mean(axis=0)
            text = {"panel": str(panel.number), "kn_m2": " ".join(map(repr, vector.tolist()))}
            ends = (middle - scale * vector, middle)
            scene.add_line(ends, f"LOADS {case.case}", case.case, text, arrow=True)


def _add_target(scene: _Scene, model: ExportModel) -> None:
    target = model.target
    if target.surface == NONE:
        return
    given = target.surface, target.span, target.height, target.file_unit
    surface = make_target(*given, target.sides)
    attributes = scene.attributes("TARGET", f"target {Path(target.surface).stem}")
    if isinstance(surface, Quadric):
        scene.file.Objects.AddSurface(_quadric_patch(scene.rhino, surface), attributes)
        return
    mesh = scene.rhino.Mesh()
    for point in surface.vertices.tolist():
        mesh.Vertices.Add(*point)
    for corners in surface.triangles.tolist():
        mesh.Faces.AddFace(*corners)
    scene.file.Objects.AddMesh(mesh, attributes)


def _quadric_patch(rhino, surface: Quadric):
    """Return the exact Bezier patch: heights at its nine points are those of the polar form, where
    x^2 becomes a^2, -a^2, a^2 on x = -a, 0, a."""
    places, squares = [], []
    patch = rhino.NurbsSurface.Create(3, False, 3, 3, 3, 3)
    for knots, side in zip((patch.KnotsU, patch.KnotsV), surface.sides, strict=True):
        half = side / 2
        for k, value in enumerate((-half, -half, half, half)):
            knots[k] = value
        places.append((-half, 0.0, half))
        squares.append((half**2, -(half**2), half**2))
    for i in range(3):
        for j in range(3):
            height = (
                surface.apex + surface.along_x * squares[0][i] + surface.along_y * squares[1][j]
            )
            height += surface.twist * places[0][i] * places[1][j]
            patch.Points[i, j] = rhino.Point4d(places[0][i], places[1][j], height, 1.0)
    return patch


def _add_flat(scene: _Scene, model: ExportModel) -> None:
    """Add the flat pattern beside the roof, on the ground; of a cut sheet its exact pieces."""
    pieces = model.pieces
    flat = model.flat if pieces is None else pieces.flat
    if flat is None:
        return
    low, high = model.vertices.min(axis=0), model.vertices.max(axis=0)
    place = np.array([high[0] + GAP * _size(model), low[1], low[2]]) - flat.min(axis=0)
    lines = _list_flat(model)
    if pieces is not None:
        kinds = zip(pieces.edges.tolist(), pieces.assignments.tolist(), strict=True)
        lines = [(ends, kind, "") for ends, kind in kinds if kind in "MVB"]
    for ends, kind, name in lines:
        layer = f"FLAT PATTERN {LAYERS[kind]}"
        scene.add_line(flat[list(ends)] + place, layer, name, {"state": model.flat_note})


def _list_flat(model: ExportModel) -> list[tuple[tuple[int, int], str, str]]:
    """Return ends, kind and name of the creases that have a flat state."""
    found = []
    for crease in model.creases:
        if model.flat is not None and max(crease.ends) < len(model.flat):
            one_sided = sum(model.panels[number].sized for number in crease.panels) < 2
            kind = "B" if one_sided else crease.assignment
            found.append((crease.ends, kind, _crease_name(model, crease)))
    return found


def _add_views(scene: _Scene, model: ExportModel) -> None:
    """Add named views: from above, along both axes, and in perspective."""
    rhino, middle, far = scene.rhino, model.vertices.mean(axis=0), 3 * _size(model)
    views = {"Roof top": (0, 0, 1), "Roof front": (0, -1, 0), "Roof side": (1, 0, 0),
             "Roof perspective": (-0.6, -0.8, 0.5)}  # fmt: skip
    for name, direction in views.items():
        view = rhino.ViewInfo()
        view.Name = name
        port, towards = view.Viewport, np.array(direction, dtype=float)
        towards /= np.linalg.norm(towards)
        port.ChangeToPerspectiveProjection(far, True, 50.0) if "persp" in name else (
            port.ChangeToParallelProjection(True)
        )
        port.SetCameraLocation(scene.point(middle + far * towards))
        port.SetCameraDirection(rhino.Vector3d(*(-far * towards)))
        up = (0.0, 1.0, 0.0) if name == "Roof top" else (0.0, 0.0, 1.0)
        port.SetCameraUp(rhino.Vector3d(*up))
        port.TargetPoint = scene.point(middle)
        scene.file.NamedViews.Add(view)
