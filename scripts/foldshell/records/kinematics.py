"""kinematics.json: what a Miura sheet can do."""

from dataclasses import dataclass

from foldshell.records.entry import COUNT, entry


@dataclass(frozen=True, kw_only=True)
class RatioRow:
    """Poisson's ratios at one state of folding."""

    fold_angle_deg: float = entry("fold angle of the cell", "deg")
    in_plane: float = entry("in-plane ratio by finite steps", "-")
    in_plane_exact: float = entry("the same in closed form", "-")
    bending: float = entry("ratio in bending, found", "-")
    bending_exact: float = entry("the same in closed form", "-")
    bending_residual: float = entry("how far the bending mode is from one of no stretch", "-")


@dataclass(frozen=True, kw_only=True)
class MechanismCount:
    """Freedoms and redundant constraints of a bar-hinge sheet."""

    freedoms: int = entry("freedoms beyond the six rigid ones", COUNT)
    self_stresses: int = entry("redundant constraints", COUNT)


@dataclass(frozen=True, kw_only=True)
class SoftMode:
    """One soft mode of the free sheet."""

    panel_over_crease: float = entry("bending stiffness of panels over that of creases", "-")
    stiffness: float = entry("stiffness over that of the softest mode", "-")
    shape: str = entry("shape that it is most alike")
    agreement: float = entry("how alike", "-")


@dataclass(frozen=True, kw_only=True)
class SheetRecord:
    """One density of polylines."""

    zigzag: int = entry("zig-zag polylines", COUNT)
    strip: int = entry("strip polylines", COUNT)
    rigid_panels: MechanismCount = entry("with panels that stay flat")
    bending_panels: MechanismCount = entry("with panels that fold along a diagonal")
    isometry_residual: dict[str, float] = entry(
        "share of a shape that the sheet misses without stretching", "-"
    )
    modes: tuple[SoftMode, ...] = entry("soft modes by stiffness of panels, softest first")


@dataclass(frozen=True, kw_only=True)
class ForceRatioTrial:
    """One choice of strengths and what it led to."""

    surface: str = entry("target surface")
    engine: str = entry("solver")
    panels: str = entry("quadrilaterals or triangles")
    attraction: float = entry("strength of the attraction to the target", "-")
    panel: float = entry("strength that keeps panels flat", "-")
    rms_over_span: float = entry("rms distance to the target over the span", "-")
    crease_strain_max: float = entry("largest strain of a crease", "-")
    shear_max: float = entry("largest strain of a panel's diagonal", "-")
    planarity_max: float = entry("largest planarity of a panel", "-")
    flipped_folds: int = entry("creases folded against their assignment", COUNT)
    self_intersections: int = entry("pairs of facets that cut each other", COUNT)
    iterations: int = entry("iterations of the solver", COUNT)
    reached: bool = entry("whether the target was met, every fold its own way, without cuts")
    folded: bool = entry("whether besides no diagonal was sheared")


@dataclass(frozen=True, kw_only=True)
class RuleDifference:
    """A sheet folded by the paper's geometric rules, against the closed form."""

    side_a_m: float = entry("side of a panel along a zig-zag", "m")
    side_b_m: float = entry("side of a panel along a strip", "m")
    sector_angle_deg: float = entry("sector angle of the cell", "deg")
    fold_angle_deg: float = entry("fold angle of the cell", "deg")
    travel_m: float = entry("travel of the point that drives the rules", "m")
    travel_over_largest: float = entry("the same over its largest value", "-")
    vertices_max_m: float = entry("largest distance of a vertex from the closed form", "m")
    edge_strain_max: float = entry("largest strain of an edge", "-")
    planarity_max: float = entry("largest planarity of a panel", "-")
    angle_defect_max_rad: float = entry("largest defect of a vertex's angle sum", "rad")
    kawasaki_max_rad: float = entry("largest defect of Kawasaki's sum at a vertex", "rad")


@dataclass(frozen=True, kw_only=True)
class KinematicsRecord:
    """The contents of kinematics.json."""

    sector_angle_deg: float = entry("sector angle of the Miura cell", "deg")
    ratios: tuple[RatioRow, ...] = entry("Poisson's ratios on the folding path and at rest")
    sheets: tuple[SheetRecord, ...] = entry("mechanisms, isometries and soft modes by density")
    force_ratios: tuple[ForceRatioTrial, ...] = entry("the sweep of force strengths")
    geometric_rules: tuple[RuleDifference, ...] = entry(
        "the geometric rules of the paper's Fig. 1 against the closed form"
    )
