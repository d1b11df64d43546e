"""A candidate folded in memory: what the rules pattern, fold and mesh do, without files between."""

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from foldshell.explore.measures import measure_creases, measure_depth
from foldshell.folding.cut_files import cut_arrays, cut_folded_panels, cut_folded_sheet
from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import fold_sheet
from foldshell.folding.fold_panels import fold_panels
from foldshell.folding.panel_files import panel_arrays
from foldshell.folding.targets import find_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.make_panels import make_panels
from foldshell.pattern.outline import read_outline
from foldshell.records.arrays import list_arrays
from foldshell.records.candidate import ANGLES
from foldshell.records.quality import QualityMeasures
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.settings.design import GRID_PATTERNS, OTHER_PARAMETERS, Design
from foldshell.settings.field import Plain
from foldshell.settings.stage import StageSettings
from foldshell.settings.support_row import PlainRow, from_plain
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.mesh_files import mesh_folded_sheet

STEPS = 65535
CREASES = ("M", "V")
PARAMETERS = ("rest_fold_angle_deg", "strip_grading", *OTHER_PARAMETERS)
"""Columns of the form that the sector angle stands beside."""


@dataclass(frozen=True)
class FoldedCandidate:
    """A sheet that was folded for a search: `arrays` of folded.npz, its state with the reason, and
    what is measured: length of folds (m), depth of the rest state (m), angles of a Miura sheet."""

    design: Design
    arrays: FoldedArrays
    state: str
    reason: str
    quality: QualityMeasures
    crease_length: float
    depth: float | None = None
    angles: Mapping[str, float] = field(default_factory=dict)

    @property
    def panels(self) -> int:
        """Number of panels."""
        return len(self.arrays.planarity)

    @property
    def facet_panel(self) -> np.ndarray:
        """Panel (F,) of each facet, a number; two facets are one on a grid."""
        known = self.arrays.facet_panel
        return np.arange(len(self.arrays.facets)) // 2 if known is None else known

    @property
    def panel_area(self) -> np.ndarray:
        """Area (P,) of panels, m2."""
        corners = self.arrays.vertices[self.arrays.facets]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(normal, axis=1) / 2
        return np.bincount(self.facet_panel, area, self.panels)

    def mesh(self, subdivisions: int) -> dict[str, np.ndarray]:
        """Return the arrays of mesh.npz; raises `ValueError` for supports that hold nothing."""
        design = self.design
        beam = make_edge_beam(design.edge_beam_depth, design.edge_beam_thickness)
        holding = from_plain(design.holding)
        return mesh_folded_sheet(list_arrays(self.arrays), holding, subdivisions, edge_beam=beam)


def make_design(columns: Plain, supports: Mapping[str, Sequence[PlainRow]] | None = None) -> Design:
    """Return the design of the columns of a candidate; `supports` has the rows of named sets."""
    design = Design.from_row({"tags": "", **columns, "design": "candidate"})
    rows = (supports or {}).get(design.support)
    return replace(design, support_rows=tuple(from_plain(rows))) if rows else design


def fold_candidate(design: Design, settings: StageSettings) -> FoldedCandidate:
    """Make the pattern of a design and fold it; raises `ValueError` where there is no sheet."""
    target = find_target(design.surface, design.span, design.height, design.file_unit, design.sides)
    outline = read_outline(design.outline, design.openings, design.file_unit)
    if design.pattern not in GRID_PATTERNS:
        return _fold_panels(design, target, outline, settings)
    angle = design.sector_angle_deg or float(np.degrees(settings.pattern.sector_angle))
    sheet = design_sheet(
        design.pattern, target.section_lengths(), design.zigzag, design.strip, round(angle, 10), 0,
        measure_turning(target), design.rest_fold_angle_deg, design.strip_grading,
    )  # fmt: skip
    result = fold_sheet(sheet, target, design.fold_mode, settings.fold)
    grid, vertices = sheet.grid, result.shape.vertices
    creases = np.flatnonzero(np.isin(grid.assignments, CREASES))
    if outline is None:
        arrays = folded_arrays(sheet, result)
    else:
        arrays = cut_arrays(cut_folded_sheet(sheet, result, outline), outline)
    angles = {key: sheet.settings[key] for key in ANGLES if key in sheet.settings}
    return FoldedCandidate(
        design, arrays, result.state, result.reason, result.quality,
        measure_creases(vertices, grid.edges, creases), measure_depth(sheet.rest), angles,
    )  # fmt: skip


def _fold_panels(design: Design, target, outline, settings: StageSettings) -> FoldedCandidate:
    form = {column: getattr(design, column) for column in PARAMETERS}
    counts = design.zigzag, design.strip
    mesh = make_panels(design.pattern, design.folded, design.file_unit, target, counts, **form)
    result = fold_panels(mesh, target, design.fold_mode, settings.fold)
    if outline is None:
        arrays = panel_arrays(result)
    else:
        arrays = cut_arrays(cut_folded_panels(result, outline), outline)
    folded = result.mesh
    creases = np.flatnonzero(np.isin(folded.assignments, CREASES))
    depth = None if mesh.rest is None else measure_depth(mesh.rest)
    return FoldedCandidate(
        design, arrays, result.state, result.reason, result.quality,
        measure_creases(folded.vertices, folded.edges, creases), depth,
    )  # fmt: skip


def measure_sheet(folded: FoldedCandidate) -> dict[str, float | None]:
    """Return what is known of a candidate once it is folded, by the keys of its record."""
    quality = folded.quality
    return {
        "plan_coverage": quality.plan_coverage,
        "edge_strain_max": quality.edge_strain_max,
        "planarity_max": quality.planarity_max,
        **{key: folded.angles.get(key) for key in ANGLES},
        "depth_m": folded.depth,
        "panels": folded.panels,
        "crease_length_m": folded.crease_length,
    }


def pack_geometry(folded: FoldedCandidate) -> str:
    """Return vertices and panels of a candidate as text, for thumbnails.

    Little endian: three uint32 (vertices, panels, strips), six float32 (lowest corner, size; m),
    uint16 V x 3 in shares of the box; then P x 4 of the panels, where strips is 0. Else they are
    those of a grid whose rows have so many vertices. Panels of other than four corners are packed
    as their facets, the last corner twice.
    """
    vertices, arrays = folded.arrays.vertices, folded.arrays
    low, size = vertices.min(axis=0), np.maximum(np.ptp(vertices, axis=0), 1e-9)
    packed = np.round((vertices - low) / size * STEPS).astype("<u2")
    if arrays.quads is None:
        quads, strips = arrays.facets[:, [0, 1, 2, 2]], 0
    else:
        quads, strips = arrays.quads, int(arrays.strip.max()) + 1
        number = np.arange(len(vertices)).reshape(-1, strips)
        corners = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
        plain = np.array_equal(quads, np.stack([one.ravel() for one in corners], axis=1))
        strips = strips if plain else 0
    rest = b"" if strips else quads.astype("<u2").tobytes()
    head = np.array([len(vertices), len(quads), strips], "<u4").tobytes()
    box = np.concatenate([low, size]).astype("<f4").tobytes()
    return base64.b64encode(head + box + packed.tobytes() + rest).decode()
