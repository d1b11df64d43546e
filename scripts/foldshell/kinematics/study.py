"""The kinematics study as one table of plain data: claims C1, C2, C3 and C14."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass

from foldshell.folding.targets import make_target
from foldshell.kinematics.force_ratios import sweep_force_ratios
from foldshell.kinematics.mechanism import (
    count_mechanisms,
    find_soft_modes,
    measure_isometry,
    measure_ratios,
)
from foldshell.pattern.design import design_sheet
from foldshell.pattern.miura import Miura, folded_vertices, rest_fold_angle
from foldshell.records.kinematics import (
    ForceRatioTrial,
    MechanismCount,
    RatioRow,
    SheetRecord,
    SoftMode,
)
from foldshell.settings.fold import Fold

FOLD_ANGLES_DEG = (10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0)
PANEL_STIFFNESSES = (1.0, 10.0)  # over that of creases
SURFACES = ("paraboloid", "hypar")


def tabulate_ratios(sector_angle: float) -> tuple[RatioRow, ...]:
    """Poisson's ratios on the folding path and at rest, beside the closed forms."""
    angles = [math.radians(a) for a in FOLD_ANGLES_DEG] + [rest_fold_angle(sector_angle)]
    pattern = Miura(1.0, 1.0, sector_angle, 7, 8)
    return tuple(
        RatioRow(fold_angle_deg=math.degrees(angle), **asdict(measure_ratios(pattern, angle)))
        for angle in angles
    )


def study_sheet(sector_angle: float, zigzag_count: int, strip_count: int) -> SheetRecord:
    """Mechanisms, isometries and soft modes of one sheet in its rest state."""
    pattern, rest = (
        Miura(1.0, 1.0, sector_angle, zigzag_count, strip_count),
        rest_fold_angle(sector_angle),
    )
    vertices, grid = folded_vertices(pattern, rest), pattern.grid
    return SheetRecord(
        zigzag=zigzag_count,
        strip=strip_count,
        rigid_panels=MechanismCount(**asdict(count_mechanisms(vertices, grid, True))),
        bending_panels=MechanismCount(**asdict(count_mechanisms(vertices, grid, False))),
        isometry_residual=measure_isometry(vertices, grid),
        modes=tuple(
            SoftMode(panel_over_crease=ratio, **asdict(mode))
            for ratio in PANEL_STIFFNESSES
            for mode in find_soft_modes(pattern, rest, ratio)
        ),
    )


@dataclass(frozen=True)
class Sweeps:
    """Strengths of the forces that are tried on a dome and a saddle of 28 x 28 x 10 m.

    Fewer by averaged projections, the engine of the paper's kind, which is stopped after 500
    iterations; strengths are non-dimensional.
    """

    attractions: tuple[float, ...] = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
    panels: tuple[float, ...] = (1e-4, 1e-2, 1.0, 100.0)
    explicit_attractions: tuple[float, ...] = (0.01, 1.0, 100.0)
    explicit_panels: tuple[float, ...] = (1e-2, 1.0)
    span_m: float = 28.0
    height_m: float = 10.0


SWEEPS = Sweeps()


def study_sheets(
    sector_angle: float, densities: Sequence[tuple[int, int]]
) -> tuple[SheetRecord, ...]:
    """Study one sheet for each pair of zig-zags and strips."""
    return tuple(study_sheet(sector_angle, *density) for density in densities)


def sweep_surfaces(sector_angle: float, sweeps: Sweeps) -> tuple[ForceRatioTrial, ...]:
    """Fold quadrilaterals and triangles by every pair of strengths, by either engine in turn."""
    explicit = Fold(engine="averaged_projections", max_iterations=10)
    engines = [
        (sweeps.attractions, sweeps.panels, Fold()),
        (sweeps.explicit_attractions, sweeps.explicit_panels, explicit),
    ]
    rows = []
    for attractions, panels, settings in engines:
        for surface in SURFACES:
            target = make_target(surface, sweeps.span_m, sweeps.height_m)
            angle = math.degrees(sector_angle)
            sheet = design_sheet("miura", target.section_lengths(), 15, 16, angle, 0)
            trials = sweep_force_ratios(sheet, target, settings, attractions, panels)
            rows += [ForceRatioTrial(surface=surface, **asdict(trial)) for trial in trials]
    return tuple(rows)
