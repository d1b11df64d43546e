"""OBJ, STL, PLY and GLB of the folded sheet and of its thickened solid, in m.

OBJ and PLY hold double precision, STL and GLB single: far from the origin, as on a national grid,
STL is text with all digits, and GLB has its meshes about their middle, moved by a transformation.
Colours are those of the thickness classes: materials of the sheet's OBJ (with a .mtl beside it) and
of GLB, faces in PLY; STL has none, nor has the solid's OBJ, which readers would take apart by its
materials.
"""

import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.exchange.colours import class_colours, panel_colours
from foldshell.exchange.model import ExportModel
from foldshell.exchange.options import ExportOptions, load_library
from foldshell.exchange.solid import thicken
from foldshell.files.whole import atomic_path


@dataclass(frozen=True)
class _Surface:
    """Triangles (T, 3) of points (N, 3) m, and the panel of each (T,)."""

    points: np.ndarray
    triangles: np.ndarray
    panel: np.ndarray


def _surfaces(model: ExportModel) -> tuple[_Surface, _Surface]:
    """Return the folded sheet and the solid."""
    solid = thicken(model)
    sheet = _Surface(model.vertices, model.facets, model.facet_panel)
    return sheet, _Surface(solid.points, solid.triangles, solid.panel)


def write_obj(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write sheet and solid as OBJ, a group for each panel, and their materials."""
    for surface, path, materials in zip(_surfaces(model), paths, (paths[2].name, ""), strict=False):
        text = _obj_text(model, surface, materials)
        with atomic_path(path) as temporary:
            temporary.write_text(text, encoding="ascii")
    lines = []
    for number, colour in class_colours(model).items():
        red, green, blue = (f"{value / 255:.4f}" for value in colour)
        lines.append(f"newmtl class{number}\nKd {red} {green} {blue}\nillum 1\n")
    with atomic_path(paths[2]) as temporary:
        temporary.write_text("\n".join(lines), encoding="ascii")


def _obj_text(model: ExportModel, surface: _Surface, materials: str) -> str:
    lines = [f"# foldshell {model.design}, metres, z up"]
    lines += [f"mtllib {materials}"] if materials else []
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in surface.points.tolist()]
    corners = surface.triangles + 1
    for number in np.unique(surface.panel).tolist():
        panel = model.panels[number]
        lines += [f"g {panel.name}"]
        lines += [f"usemtl class{panel.thickness_class}"] if materials else []
        lines += [f"f {a} {b} {c}" for a, b, c in corners[surface.panel == number].tolist()]
    return "\n".join(lines) + "\n"


def write_stl(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write sheet and solid as STL: binary, or text where single precision has too few digits."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("count", "<u2")])
    for surface, path in zip(_surfaces(model), paths, strict=True):
        corner = surface.points[surface.triangles]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        normal = normal / np.where(length > 0, length, 1)
        if is_far(surface.points):
            with atomic_path(path) as temporary:
                temporary.write_text(_stl_text(model.design, corner, normal), encoding="ascii")
            continue
        rows = np.zeros(len(corner), dtype=kind)
        rows["normal"] = normal
        rows["corners"] = corner
        head = f"foldshell {model.design}, metres".encode().ljust(80)[:80]
        with atomic_path(path) as temporary:
            temporary.write_bytes(head + struct.pack("<I", len(rows)) + rows.tobytes())


def is_far(points: np.ndarray) -> bool:
    """Whether points (N, 3) m are so far from the origin that single precision spoils them."""
    step = float(np.spacing(np.float32(np.abs(points).max())))
    return step > 1e-6 * float(np.ptp(points, axis=0).max())


def _stl_text(design: str, corners: np.ndarray, normals: np.ndarray) -> str:
    lines = [f"solid foldshell {design}, metres"]
    for triangle, normal in zip(corners.tolist(), normals.tolist(), strict=True):
        lines += ["facet normal " + " ".join(f"{k:.6e}" for k in normal), " outer loop"]
        lines += ["  vertex " + " ".join(map(repr, point)) for point in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, f"endsolid foldshell {design}, metres", ""])


def write_ply(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write sheet and solid as binary PLY with the panel and a colour of each face."""
    kind = np.dtype([("size", "u1"), ("corners", "<i4", 3), ("colour", "u1", 3), ("panel", "<i4")])
    colours = panel_colours(model)
    for surface, path in zip(_surfaces(model), paths, strict=True):
        rows = np.zeros(len(surface.triangles), dtype=kind)
        rows["size"], rows["corners"] = 3, surface.triangles
        rows["colour"], rows["panel"] = colours[surface.panel], surface.panel
        head = [
            "ply", "format binary_little_endian 1.0", f"comment foldshell {model.design}, metres",
            f"element vertex {len(surface.points)}", "property double x", "property double y",
            "property double z", f"element face {len(rows)}",
            "property list uchar int vertex_indices", "property uchar red", "property uchar green",
            "property uchar blue", "property int panel", "end_header", "",
        ]  # fmt: skip
        body = surface.points.astype("<f8").tobytes() + rows.tobytes()
        with atomic_path(path) as temporary:
            temporary.write_bytes("\n".join(head).encode("ascii") + body)


def write_glb(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write sheet and solid as GLB, whose y is up: (x, y, z) becomes (x, z, -y); a mesh with its
    material for each class."""
    trimesh = load_library("trimesh")
    classes = np.array([panel.thickness_class for panel in model.panels])
    colours = class_colours(model)
    for surface, path in zip(_surfaces(model), paths, strict=True):
        scene = trimesh.Scene()
        turned = surface.points[:, [0, 2, 1]] * [1.0, 1.0, -1.0]
        place = None
        if is_far(surface.points):
            place = np.eye(4)
            place[:3, 3] = turned.mean(axis=0)
            turned = turned - place[:3, 3]
        for number in np.unique(classes[surface.panel]).tolist():
            own = surface.triangles[classes[surface.panel] == number]
            # each triangle has corners of its own, so that folds stay sharp
            mesh = trimesh.Trimesh(
                turned[own].reshape(-1, 3), np.arange(own.size).reshape(-1, 3), process=False
            )
            material = trimesh.visual.material.PBRMaterial(
                name=f"class{number}", baseColorFactor=[*colours[number], 255], doubleSided=True,
                metallicFactor=0.0, roughnessFactor=0.8,
            )  # fmt: skip
            mesh.visual = trimesh.visual.TextureVisuals(material=material)
            name = f"class{number}"
            scene.add_geometry(mesh, node_name=name, geom_name=name, transform=place)
        with atomic_path(path) as temporary:
            temporary.write_bytes(scene.export(file_type="glb"))
