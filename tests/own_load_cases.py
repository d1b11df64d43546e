"""Folded sheets and loads of every kind for the tests of loads, with sums of their own.

The sums are by shapely, triangle by triangle in plan: nothing of the library but the loads' words.
"""

from functools import cache
from pathlib import Path

import numpy as np
import shapely

from foldshell.loads.cases import DOWN, PRESSURE, SurfaceLoad
from foldshell.settings.zones import read_variation, read_zone
from foldshell.shell.mesh import build_mesh
from foldshell.shell.stiffness import build_operators

DATA = Path(__file__).parent / "data"


@cache
def folded_sheet(surface="arch"):
    """Vertices (V, 3) m and facets (F, 3) of a folded 28/10 sheet with facets that overhang."""
    with np.load(DATA / f"{surface}_28_10_15x16_paper.npz") as data:
        return data["vertices"], data["triangles"]


def turn(points, angle, tilt=0.0):
    """Points (..., 3) turned about z, then about x, rad."""
    c, s, d, t = np.cos(angle), np.sin(angle), np.cos(tilt), np.sin(tilt)
    about_z = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return points @ (np.array([[1, 0, 0], [0, d, -t], [0, t, d]]) @ about_z).T


def mesh_sheet(vertices, facets, subdivisions=1, order=None):
    """Operators of a mesh of the facets, two a panel."""
    panel = np.arange(len(facets)) // 2
    return build_operators(build_mesh(vertices, facets, panel, subdivisions, order), 0.2)


def make_load(zone="all", variation="", **rest):
    """A pressure of 1 kN/m2 downward on a zone, or what `rest` says."""
    given = {"case": "A", "kind": PRESSURE, "value": 1.0, "direction": DOWN} | rest
    where = "" if zone == "all" else zone
    return SurfaceLoad(**given, zone=read_zone(zone), variation=read_variation(variation),
                       where=where)  # fmt: skip


def facet_values(vertices, facets):
    """Corners (F, 3, 3), unit normals (F, 3) and areas (F,) of facets."""
    corners = vertices[facets]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    twice = np.linalg.norm(cross, axis=1)
    return corners, cross / twice[:, None], twice / 2


def height_of(corner, normal, x, y):
    """z of a facet's plane above (x, y)."""
    away = np.array([x, y]) - corner[0, :2]
    return corner[0, 2] - normal[:2] @ away / normal[2]


def sum_by_hand(vertices, facets, region, along, share=None):
    """Resultant (3,) and moment (3,) about the origin of a unit pressure on the part of the sheet
    whose plan lies in a shapely region; along (F, 3), share (F,) by area of sheet."""
    corners, normal, _ = facet_values(vertices, facets)
    share = np.ones(len(facets)) if share is None else share
    force, moment = np.zeros(3), np.zeros(3)
    for corner, n, a, part in zip(corners, normal, along, share, strict=True):
        common = shapely.Polygon(corner[:, :2]).intersection(region)
        if common.area == 0:
            continue
        x, y = common.centroid.x, common.centroid.y
        size = common.area / abs(n[2]) * part
        force += size * a
        moment += np.cross([x, y, height_of(corner, n, x, y)], size * a)
    return force, moment
