"""What the engineering verdict on a final state is made by; lengths in m."""

from foldshell.settings.field import Group, setting, settings_group

_STAGES = ("checks", "study")


@settings_group
class Checks(Group):
    """Engineering verdict, beside that of the paper's criteria."""

    strip_width: float = setting(
        0.3, unit="m", above=0, maximum=100, stages=(*_STAGES, "analyse", "size", "reinforced"),
        meaning="Width of the strips beside folds and borders over which forces and moments are "
        "averaged for the local measure of utilization, also that of sizing.measure: strip.",
    )  # fmt: skip
    partial_factor: float = setting(
        1.0, minimum=1, maximum=5, stages=_STAGES,
        meaning="gamma_M, by which the strengths of steel and of user materials are divided; 1 "
        "where they are design values already.",
    )  # fmt: skip
    buckling_partial_factor: float = setting(
        1.2, minimum=1, maximum=5, stages=_STAGES,
        meaning="gamma_E of the elastic modulus in checks of stability (gamma_cE of EN 1992-1-1, "
        "5.8.6 (3)).",
    )  # fmt: skip
    creep_coefficient: float = setting(
        2.0, minimum=0, maximum=10, stages=_STAGES,
        meaning="Final creep phi under sustained load, of concrete and user materials "
        "(EN 1992-1-1, 3.1.4: about 2 for C25/30 loaded at 28 days); long-term displacements are "
        "those at E / (1 + phi).",
    )  # fmt: skip
    permanent_share: float = setting(
        0.45, minimum=0, maximum=1, stages=_STAGES,
        meaning="Share of sustained load in that which makes the shell buckle: phi_ef is phi times "
        "it (EN 1992-1-1, 5.8.4 (2)).",
    )  # fmt: skip
    buckling_imperfection: float = setting(
        0.8, above=0, maximum=1, stages=_STAGES,
        meaning="Part of the elastic buckling load that imperfections leave: a choice for folded "
        "plates, whose strength after buckling is not counted on.",
    )  # fmt: skip
    buckling_cracking: float = setting(
        0.5, above=0, maximum=1, stages=_STAGES,
        meaning="Part of the stiffness of concrete that cracks leave when it buckles (EN 1998-1, "
        "4.3.1 (7)); 1 for uncracked shells.",
    )  # fmt: skip
    characteristic_load_factor: float = setting(
        1.5, minimum=1, maximum=10, stages=_STAGES,
        meaning="Load factor by which the buckling factor that is required rises for combinations "
        "without partial factors.",
    )  # fmt: skip
    cracked_stiffness: float = setting(
        0.5, above=0, maximum=1, stages=_STAGES,
        meaning="Part of the stiffness of cracked panels of concrete that is left in long-term "
        "displacements; 1 leaves that check out. A panel is cracked where the principal tension "
        "of a facet or strip passes strength_tension under a characteristic combination.",
    )  # fmt: skip
    displacement_limit_span_over: float = setting(
        240, minimum=1, maximum=100000, stages=_STAGES,
        meaning="Downward displacements, short-term and long-term, are at most span / this.",
    )  # fmt: skip
    horizontal_limit_height_over: float = setting(
        300, minimum=1, maximum=100000, stages=_STAGES,
        meaning="Horizontal displacements are at most this part of the height of the shell.",
    )  # fmt: skip
