"""Small sized designs as export models: a folded Miura sheet, bent panels, an edge beam."""

import math

import numpy as np

from foldshell.exchange.read_model import read_export_model
from foldshell.files.whole import write_arrays
from foldshell.pattern.miura import Miura
from foldshell.pattern.sheet import make_miura_sheet
from foldshell.records.analysis import write_analysis
from foldshell.settings.analysed import LOADED
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import stage_parameters
from foldshell.shell.edge_beams import EdgeBeam
from foldshell.shell.mesh_files import mesh_folded_sheet, write_mesh
from record_cases import make_analysis

ZIGZAGS, STRIPS = 5, 6
PANELS = (ZIGZAGS - 1) * (STRIPS - 1)
BEAM = EdgeBeam(0.4, 0.1)
DESIGN = {"design": "small", "surface": "paraboloid", "span_m": 3.5, "height_m": 1.0,
          "support": "strip", "fold_mode": "exact"}  # fmt: skip


def stage_settings(**config):
    """Return the settings of stage crosscheck, defaults but for `config`."""
    plain = stage_parameters(make_settings(config), "crosscheck")
    return read_stage(plain, *LOADED, Crosscheck)


def write_export_case(folder, bent=0.0, beam=False, thickness=None):
    """Write the files of a sized design and return them by role; `bent` m moves vertices out of
    their panels' planes."""
    sheet = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), ZIGZAGS, STRIPS), 3)
    grid, vertices = sheet.grid, sheet.rest.copy()
    vertices[:, 2] += bent * np.sin(3.0 * np.arange(len(vertices)))
    folded = {"vertices": vertices, "quads": grid.quads, "facets": grid.facets, "flat": sheet.flat}
    folded |= {"zigzag": grid.zigzag_index, "strip": grid.strip_index}
    folded |= {"planarity": np.zeros(PANELS), "strain": np.zeros(2 * PANELS)}
    write_arrays(folder / "folded.npz", folded)
    mesh = mesh_folded_sheet(folded, "strip", 1, edge_beam=BEAM if beam else None)
    write_mesh(folder / "mesh.npz", mesh)
    thickness = np.full(PANELS, 0.05) if thickness is None else thickness
    final = {"thickness": thickness}
    more = len(mesh["fixed_thickness"]) if beam else 0
    for name in ("utilization_panel_mean", "utilization_element_max"):
        final[name] = np.linspace(0.1, 0.9, PANELS)
        if more:
            final[f"edge_beam_{name}"] = np.full(more, 0.3)
    write_arrays(folder / "final.npz", final)
    number = 1 + np.arange(PANELS) * 3 // PANELS
    write_arrays(folder / "classes.npz", {"panel_class": number, "thickness": 0.06 * number})
    record = make_analysis(verdict="converged", reason="all criteria are met")
    write_analysis(folder / "final.json", record)
    roles = {"mesh": "npz", "folded": "npz", "final": "npz", "classes": "npz"}
    paths = {role: folder / f"{role}.{kind}" for role, kind in roles.items()}
    return {**paths, "report": folder / "final.json"}


def make_export_model(folder, bent=0.0, beam=False, thickness=None, **config):
    """Return the export model of such a design."""
    paths = write_export_case(folder, bent, beam, thickness)
    return read_export_model(paths, DESIGN, stage_settings(**config))


def support_edges(model):
    """Return the edges of all supports, (K, 2)."""
    return np.concatenate([support.edges for support in model.supports])


CASES = {
    "planar": {},
    "bent": {"bent": 0.02},
    "beam": {"beam": True},
    "graded": {"thickness": np.linspace(0.03, 0.12, PANELS)},
    "bent, graded, beam": {
        "bent": 0.02, "beam": True, "thickness": np.linspace(0.12, 0.03, PANELS),
    },
}  # fmt: skip
