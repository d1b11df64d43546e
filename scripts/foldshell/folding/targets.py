"""Targets by name: the surfaces of the study, or a mesh file."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from foldshell.files.meshes.read import is_mesh_file
from foldshell.folding.mesh_target import MeshTarget, read_mesh_target
from foldshell.folding.quadric import Quadric, make_quadric
from foldshell.settings.design import NONE, SURFACES


def make_target(
    surface: str,
    span_m: float,
    height_m: float,
    file_unit: str = "m",
    sides: Sequence[float] = (),
) -> Quadric | MeshTarget:
    """Build the target surface over a square plan of side span, or a rectangle of two sides [m].

    `surface` is one of SURFACES or a mesh file in `file_unit`, whose heights are its own.
    """
    if surface not in SURFACES and is_mesh_file(surface):
        if not span_m > 0:
            raise ValueError(f"span {span_m}: must be positive")
        return read_mesh_target(surface, float(span_m), file_unit, tuple(sides) or None)
    return make_quadric(surface, span_m, height_m, tuple(sides) or None)


def find_target(surface: str, *form: Any) -> Quadric | MeshTarget | None:
    """Build the target of a design as `make_target` does, None for a sheet that has none."""
    return None if surface == NONE else make_target(surface, *form)


def measure_turning(target: Quadric | MeshTarget) -> float:
    """Angle [rad] by which the normal turns along the central section x = 0; a dome's is > 0."""
    y = np.array([-0.5, 0.5]) * target.sides[1]
    normals = target.find_normals(np.zeros(2), y)
    tilt = np.arctan2(normals[:, 1], normals[:, 2])
    return float(tilt[1] - tilt[0])
