"""How a shell is analysed."""

from foldshell.settings.field import Group, setting, settings_group


@settings_group
class Analysis(Group):
    """Shell analysis."""

    subdivisions: int = setting(
        4, minimum=1, maximum=16, stages=("mesh", "study"),
        meaning="Refinement n of each planar facet of a panel.",
    )  # fmt: skip
    subdivisions_demo: int = setting(
        2, minimum=1, maximum=16, stages=("study",),
        meaning="The same for designs with the tag demo.",
    )  # fmt: skip
    second_order: bool = setting(
        True,
        meaning="Second-order theory (Th.II), each combination with its own membrane forces.",
    )
    second_order_tolerance: float = setting(
        1e-6, above=0, maximum=0.01,
        meaning="Relative change of displacement at which the second-order iteration ends.",
    )  # fmt: skip
    second_order_iterations_max: int = setting(
        60, unit="iterations", minimum=1, maximum=1000,
        meaning="Iterations after which the second-order iteration counts as failed.",
    )  # fmt: skip
    solver: str = setting(
        "cholmod", choices=("cholmod", "superlu"), meaning="Sparse factorisation."
    )
    imperfection: float = setting(
        0, unit="mm", minimum=0, maximum=1000,
        meaning="Largest displacement of the stress-free initial shape of second order, the mode "
        "of the least buckling factor, turned to the side to which its loads push it; 0 for none, "
        "as in the paper.",
    )  # fmt: skip
    creep_coefficient: float = setting(
        0, minimum=0, maximum=10, stages=("study",),
        meaning="Creep phi of the material. Young's modulus is divided by 1 + phi wherever it is "
        "used; 0 for none, as in the paper.",
    )  # fmt: skip
