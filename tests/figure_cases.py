"""Small sheets with fields that are known exactly, as the files that pictures are made from."""

import math

import numpy as np

from foldshell.files.whole import write_arrays
from foldshell.folding.quality import measure_planarity
from foldshell.pattern.miura import Miura
from foldshell.pattern.sheet import make_miura_sheet
from foldshell.records.analysis import write_analysis
from foldshell.results.state import read_state
from foldshell.settings.loads import Combinations
from foldshell.shell.mesh_files import mesh_folded_sheet, read_mesh, write_mesh
from record_cases import make_analysis

COMBINATIONS = {"strength": {"S1": {}, "S2": {}}, "deflection": {"D1": {}, "D2": {}}}
ZIGZAGS, STRIPS = 5, 6
PANELS = (ZIGZAGS - 1) * (STRIPS - 1)


def sheet_arrays(folded=True):
    """Return the arrays of folded.npz for a 5 x 6 Miura sheet, folded half way or flat."""
    sheet = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), ZIGZAGS, STRIPS), 0)
    vertices, grid = sheet.rest if folded else sheet.flat, sheet.grid
    return {
        "vertices": vertices,
        "quads": grid.quads,
        "facets": grid.facets,
        "flat": sheet.flat,
        "zigzag": grid.zigzag_index,
        "strip": grid.strip_index,
        "planarity": measure_planarity(vertices, grid.quads),
        "strain": np.linspace(0, 0.02, len(grid.facets)),
    }


def write_case(folder, folded=True, utilization=0.4, move=None, thickness=None, **report):
    """Write mesh.npz, folded.npz, final.npz, final.json, classes.npz; return paths in that order.

    `move` gives displacements (N, 3) m of nodes (N, 3) in D2, ten times what it is in all others;
    `utilization` is one value, or None for a design that has none.
    """
    arrays = sheet_arrays(folded)
    write_arrays(folder / "folded.npz", arrays)
    write_mesh(folder / "mesh.npz", mesh_folded_sheet(arrays, "strip", 2))
    mesh, _ = read_mesh(folder / "mesh.npz")
    move = move or (lambda nodes: np.column_stack([0 * nodes[:, :2], -1e-3 * nodes[:, 0] ** 2]))
    displacement = np.zeros((mesh.dof_count, 4))
    displacement[: 3 * len(mesh.nodes)] = move(mesh.nodes).reshape(-1, 1) * [0.1, 0.1, 0.1, 1]
    thickness = np.linspace(0.05, 0.15, PANELS) if thickness is None else thickness
    shape = (len(mesh.elements), mesh.cells**2)
    final = {"thickness": thickness, "displacement": displacement}
    final["buckling_modes"] = np.tile(np.arange(free_count(mesh, folder))[:, None], 4)
    if utilization is not None:
        final["utilization_cell"] = np.full(shape, utilization)
        final["utilization_panel_mean"] = np.full(PANELS, utilization)
        final["governing_combination"] = np.ones(shape, dtype=int)
    write_arrays(folder / "final.npz", final)
    panel_class = 1 + np.arange(PANELS) * 3 // PANELS
    of_class = np.array([0.1, 0.15, 0.2])
    classes = {"panel_class": panel_class, "thickness": of_class[panel_class - 1]}
    write_arrays(folder / "classes.npz", classes)
    facts = {"verdict": "converged", "reason": "all criteria are met", "iteration": 3,
             "volume_m3": 2.0, "area_m2": 20.0,
             "buckling_factor": {"S1": 3.0, "S2": 2.0, "D1": None, "D2": 4.0}}  # fmt: skip
    names = ("utilization_panel_mean_max", "utilization_p99", "utilization_mean")
    record = make_analysis(**facts | dict.fromkeys(names, utilization) | report)
    write_analysis(folder / "final.json", record)
    files = ("mesh", "folded", "final", "final", "classes")
    return tuple(
        folder / f"{name}.{kind}"
        for name, kind in zip(files, ("npz", "npz", "npz", "json", "npz"), strict=True)
    )


def free_count(mesh, folder):
    """Return how many degrees of freedom are not supported."""
    _, arrays = read_mesh(folder / "mesh.npz")
    return mesh.dof_count - 3 * len(arrays.supported_nodes)


def make_state(folder, **options):
    """Write a case and read it back as the state that pictures are drawn from."""
    *files, classes = write_case(folder, **options)
    return read_state("case", *files, Combinations(**COMBINATIONS), classes)
