"""The groups of settings as frozen classes; kN, m, kPa and rad.

Field names are the keys of config.yaml without their unit suffix: `youngs_modulus_gpa: 31` becomes
`material.youngs_modulus = 31e6` (kPa), `start_thickness_mm: 150` becomes 0.15 (m).
"""

from dataclasses import dataclass

from foldshell.settings.material import Material

Factors = dict[str, dict[str, float]]


@dataclass(frozen=True)
class Defaults:
    """Values of columns that the table of designs leaves out (m)."""

    pattern: str
    surface: str
    span: float
    height: float
    zigzag: int
    strip: int
    support: str
    fold_mode: str
    edge_beam_depth: float
    edge_beam_thickness: float


@dataclass(frozen=True)
class Pattern:
    """Crease pattern (rad)."""

    sector_angle: float


@dataclass(frozen=True)
class FoldWeights:
    """Weights of the folding terms (-)."""

    stretch: float
    hinge: float
    hinge_steep: float
    neutral_fold: float
    neutral_fold_steep: float
    attraction: float
    plan_edge: float
    plan_edge_steep: float


@dataclass(frozen=True)
class ExactWeights:
    """Weights of the modes exact and rigid (-)."""

    stretch: float
    hinge: float
    neutral_fold: float
    plan_edge: float
    fairness: float
    attraction: float
    margin: float


@dataclass(frozen=True)
class FoldLimits:
    """What a folded sheet must keep (-)."""

    rms_over_span: float
    plan_coverage: float


@dataclass(frozen=True)
class Fold:
    """Folding onto the target surface."""

    engine: str
    attract: str
    weights: FoldWeights
    exact: ExactWeights
    max_iterations: int
    tolerance: float
    limits: FoldLimits


@dataclass(frozen=True)
class Loads:
    """Loads in kN/m2."""

    superimposed_dead: float
    live: float
    wind: float
    wind_fraction: float
    area_basis: str
    uplift: bool


@dataclass(frozen=True)
class Combinations:
    """Factors of load cases by combination, uplift included where it is asked for."""

    strength: Factors
    deflection: Factors


@dataclass(frozen=True)
class Analysis:
    """Shell analysis; subdivisions are per side of a facet."""

    subdivisions: int
    subdivisions_demo: int
    second_order: bool
    second_order_tolerance: float
    second_order_iterations_max: int
    solver: str
    imperfection: float
    creep_coefficient: float


@dataclass(frozen=True)
class Sizing:
    """Thickness loop: thicknesses in m, volume change in m3."""

    rule: str
    measure: str
    start_thickness: float
    least_thickness: float
    largest_thickness: float
    step: float
    move_limit: float
    utilization_min: float
    utilization_max: float
    displacement_limit_span_over: float
    volume_change_max: float
    volume_change_max_relative: float
    thinning_buckling_factor_min: float
    iterations_max: int
    stop: str
    classes: int


@dataclass(frozen=True)
class Tolerance:
    """Largest relative differences of the two codes."""

    displacement: float
    work: float
    utilization_p99: float
    buckling_factor: float
    reaction_balance: float


@dataclass(frozen=True)
class Crosscheck:
    """Comparison with the independent code; subdivisions are (coarse, fine)."""

    subdivisions: list[int]
    strength: str
    deflection: str
    solver: str
    tolerance: Tolerance


@dataclass(frozen=True)
class Limits:
    """Guards."""

    panels_max: int


@dataclass(frozen=True)
class Jobs:
    """How jobs are started; results do not depend on it."""

    fork: bool


@dataclass(frozen=True)
class Figures:
    """Pictures (px)."""

    width_px: int
    height_px: int


@dataclass(frozen=True)
class Drawings:
    """Drawings of patterns and panels; `scale` is drawn over true length."""

    preset: str
    scale: float


@dataclass(frozen=True)
class Exports:
    """Files for other programs (m, s)."""

    formats: list[str]
    sheet_length: float
    sheet_width: float
    nesting_seconds: int


@dataclass(frozen=True)
class Settings:
    """Every setting of a study."""

    designs: str
    study: str
    defaults: Defaults
    pattern: Pattern
    fold: Fold
    material: Material
    loads: Loads
    combinations: Combinations
    analysis: Analysis
    sizing: Sizing
    crosscheck: Crosscheck
    limits: Limits
    jobs: Jobs
    figures: Figures
    drawings: Drawings
    exports: Exports
