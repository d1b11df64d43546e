"""The thickness loop; thicknesses in m, volumes in m3."""

from foldshell.settings.field import Group, setting, settings_group

_LOOP = ("analyse", "resize", "size", "study")
_VERDICT = ("analyse", "size", "study")
_STEP = ("resize", "size", "study")
"""Stages that get settings of the loop, of the verdict on an analysis, of the next thickness."""


REINFORCED = "reinforced"
"""The measure that takes the settings of reinforcement."""


@settings_group
class Sizing(Group):
    """Thickness loop, criteria of Table 3 of the paper. Results depend on start, step and least
    thickness."""

    rule: str = setting(
        "dead_band",
        choices=(
            "dead_band", "filtered_dead_band", "fully_stressed", "optimality", "stress_ratio"
        ),
        former={"literal": "fully_stressed"}, stages=_LOOP,
        meaning="Grow above utilization_max and shrink below utilization_min; "
        "(filtered_dead_band) the same as far as predicted displacement and buckling factor keep "
        "their limits; (stress_ratio) the same with steps by the ratio of utilization to its lower "
        "limit while a panel is far below it; (fully_stressed) shrink whenever below "
        "utilization_max; or (optimality) "
        "least volume that keeps utilization, displacement and buckling factor, by gradients.",
    )  # fmt: skip
    measure: str = setting(
        "panel_mean", choices=("panel_mean", "element_max", "strip", REINFORCED), stages=_LOOP,
        meaning="Utilization of a panel: its area mean (does not hang on the mesh), the largest "
        "value in it (the paper's), or the largest of its facet means and of the means over "
        "strips along its folds and borders (local, and settles with the mesh); or (reinforced) "
        "the largest share of what steel and concrete allow, by reinforcement.sizing_checks.",
    )  # fmt: skip
    start_thickness: float = setting(
        150, unit="mm", above=0, maximum=10000, stages=("start", "size", "study"),
        meaning="Thickness of every panel in iteration 00.",
    )  # fmt: skip
    least_thickness: float = setting(40, unit="mm", above=0, maximum=10000, meaning="Lower bound.")
    largest_thickness: float = setting(
        1000, unit="mm", above=0, maximum=10000, meaning="Upper bound."
    )
    step: float = setting(
        0.10, above=0, maximum=0.5, stages=_STEP,
        meaning="Relative change of a thickness in one iteration.",
    )  # fmt: skip
    move_limit: float = setting(
        0.3, above=0, maximum=0.9, stages=_STEP,
        meaning="Largest relative change of a thickness in one iteration by the rule optimality; "
        "panels that turn back get less.",
    )  # fmt: skip
    thickness_step: float = setting(
        0, unit="mm", minimum=0, maximum=1000, stages=("start", *_LOOP),
        meaning="Thicknesses that can be built are multiples of this (5 or 10 mm, say): each step "
        "of the loop is rounded up to them, thickness classes are too; 0 for any thickness.",
    )  # fmt: skip
    thickness_list: tuple[float, ...] = setting(
        (), unit="mm", above=0, maximum=10000, stages=("start", *_LOOP),
        meaning="The thicknesses that can be built, in rising order; empty for any.",
    )  # fmt: skip
    symmetry: str = setting(
        "none", choices=("none", "x", "y", "both"), stages=("start", "size", "study"),
        meaning="Panels that mirror each other about the middle of x, of y or of both stand in one "
        "group of the first workbook, and take one thickness.",
    )  # fmt: skip
    analyse_only: bool = setting(
        False, stages=_VERDICT,
        meaning="Analyse the first workbook as it is, judge it by the limits, and size nothing.",
    )  # fmt: skip
    ratio_limit: float = setting(
        0.45, above=0, maximum=0.9, stages=_STEP,
        meaning="Largest relative change of a thickness in one iteration by the rule stress_ratio.",
    )  # fmt: skip
    utilization_min: float = setting(
        0.6, minimum=0, maximum=10, stages=_LOOP,
        meaning="Lower end of the dead band, and least value of the largest utilization.",
    )  # fmt: skip
    utilization_max: float = setting(
        1.0, above=0, maximum=10, stages=_LOOP,
        meaning="Upper end of the dead band, and largest utilization allowed.",
    )  # fmt: skip
    displacement_limit_span_over: float = setting(
        240, minimum=1, maximum=100000, stages=_VERDICT,
        meaning="The largest downward displacement must stay below span / this.",
    )  # fmt: skip
    volume_change_max: float = setting(
        10, unit="m3", above=0, maximum=100000, stages=_VERDICT,
        meaning="Change of volume since the iteration before must be below this.",
    )  # fmt: skip
    volume_change_max_relative: float = setting(
        0.01, above=0, maximum=1, stages=_VERDICT,
        meaning="The same relative to the volume, since 10 m3 never bites on small shells.",
    )  # fmt: skip
    buckling_factor_min: float = setting(
        0, minimum=0, maximum=1000, stages=_VERDICT,
        meaning="Least value of the least buckling factor for a design to converge; 0 for no such "
        "criterion, as in the paper.",
    )  # fmt: skip
    thinning_buckling_factor_min: float = setting(
        1.5, minimum=0, maximum=1000, stages=_LOOP,
        meaning="No panel is made thinner while the least buckling factor is below this; the rule "
        "optimality keeps it.",
    )  # fmt: skip
    iterations_max: int = setting(
        30, unit="iterations", minimum=1, maximum=99, stages=_VERDICT,
        meaning="Analyses after which a design counts as not converged.",
    )  # fmt: skip
    stop: str = setting(
        "table3", choices=("table3", "stationary"), stages=_VERDICT,
        meaning="End at the first iteration that meets Table 3, or go on until the volume is "
        "stationary as well.",
    )  # fmt: skip
    classes: int = setting(
        4, unit="classes", minimum=1, maximum=50, stages=("size", "study"),
        meaning="Number of thickness classes for fabrication.",
    )  # fmt: skip

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and largest thickness, m."""
        return self.least_thickness, self.largest_thickness
