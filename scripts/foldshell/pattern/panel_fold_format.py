"""FOLD files of panels that are no grid of zig-zags and strips: write and read back."""

from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.strict_json import read_json_object
from foldshell.files.whole import Json, write_json
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.read_any_fold import read_any_fold
from foldshell.pattern.sheet import Frame

REST, FOLDED = "rest", "folded"
"""Titles of the frames that are states of their own; others are steps of a path."""
KIND = "panels"
"""Value of the key foldshell:kind by which such files are told from those of crease grids."""


def write_panel_fold(
    path: str | Path, mesh: PanelMesh, title: str, frames: tuple[Frame, ...] = ()
) -> None:
    """Write panels as a FOLD file, whole or not at all, with the steps `frames` of their path.

    The top frame is the flat sheet, or the folded one where there is no flat one.
    """
    top = mesh.vertices if mesh.flat is None else mesh.flat[:, :2]
    states = [(REST, mesh.rest)] if mesh.rest is not None else []
    if mesh.folded is not None and mesh.flat is not None:
        states.append((FOLDED, mesh.folded))
    states += [(frame.title, frame.vertices) for frame in frames]
    angles = np.degrees(mesh.fold_angles)
    write_json(path, {
        "file_spec": 1.2,
        "file_creator": "foldshell",
        "file_title": title,
        "file_classes": ["singleModel"],
        "frame_title": "folded sheet" if mesh.flat is None else "crease pattern",
        "frame_classes": ["foldedForm" if mesh.flat is None else "creasePattern"],
        "frame_attributes": ["3D" if mesh.flat is None else "2D", "orientable"],
        "frame_unit": "m",
        "vertices_coords": top.tolist(),
        "edges_vertices": mesh.edges.tolist(),
        "edges_assignment": mesh.assignments.tolist(),
        "edges_foldAngle": [float(a) if np.isfinite(a) else None for a in angles],
        "faces_vertices": [row.tolist() for row in mesh.panels],
        "foldshell:kind": KIND,
        "foldshell:labels": {name: values.tolist() for name, values in mesh.labels.items()},
        "foldshell:sets": {name: values.tolist() for name, values in mesh.sets.items()},
        "foldshell:notes": list(mesh.notes),
        "file_frames": [_describe_state(*state) for state in states],
    })  # fmt: skip


def _describe_state(title: str, vertices: np.ndarray) -> Json:
    return {
        "frame_title": title,
        "frame_classes": ["foldedForm"],
        "frame_attributes": ["3D", "orientable"],
        "frame_parent": 0,
        "frame_inherit": True,
        "frame_unit": "m",
        "vertices_coords": vertices.tolist(),
    }


def read_panel_fold(path: str | Path) -> tuple[PanelMesh, tuple[Frame, ...]]:
    """Read a FOLD file written by `write_panel_fold`: panels, and the steps of their path.

    Raises `InputError`.
    """
    data = read_json_object(path, "a FOLD file")
    mesh = read_any_fold(path, "m")
    try:
        frames = [
            (frame["frame_title"], np.array(frame["vertices_coords"], dtype=float))
            for frame in data["file_frames"]
        ]
        named = {title: vertices for title, vertices in frames}
        labels, sets = (
            {name: np.array(values, dtype=np.int64) for name, values in data[key].items()}
            for key in ("foldshell:labels", "foldshell:sets")
        )
        notes = tuple(map(str, data["foldshell:notes"]))
    except (KeyError, TypeError, ValueError, AttributeError):
        raise InputError(f"{path}: not the FOLD file of panels that this project writes") from None
    steps = tuple(Frame(title, states) for title, states in frames if title not in (REST, FOLDED))
    is_flat = data.get("frame_classes") == ["creasePattern"]
    found = PanelMesh(
        mesh.panels, mesh.edges, mesh.assignments, mesh.fold_angles,
        flat=mesh.flat if is_flat else None,
        rest=named.get(REST),
        folded=named.get(FOLDED) if is_flat else mesh.vertices,
        labels=labels, sets=sets, notes=notes,
    )  # fmt: skip
    return found, steps


def is_panel_fold(path: str | Path) -> bool:
    """Tell whether a FOLD file of this project holds panels that are no crease grid."""
    return read_json_object(path, "a FOLD file").get("foldshell:kind") == KIND
