"""The comparison with the independent code."""

from foldshell.settings.field import Group, setting, settings_group


@settings_group
class Tolerance(Group):
    """Largest relative differences of the extrapolated values."""

    displacement: float = setting(0.04, above=0, maximum=1, meaning="Largest displacement.")
    work: float = setting(0.04, above=0, maximum=1, meaning="Work of the loads.")
    utilization_p99: float = setting(
        0.08, above=0, maximum=1, meaning="99th percentile of utilization."
    )
    buckling_factor: float = setting(0.08, above=0, maximum=1, meaning="Least buckling factor.")
    reaction_balance: float = setting(
        1e-6, above=0, maximum=1,
        meaning="Sum of reactions against sum of loads, in each code.",
    )  # fmt: skip


@settings_group
class Crosscheck(Group):
    """Comparison with the independent finite-element code."""

    subdivisions: tuple[int, int] = setting(
        (1, 2), minimum=1, maximum=16,
        meaning="Two meshes of the independent code, coarse then fine, to extrapolate from; codes "
        "that differ are compared once more, one mesh finer.",
    )  # fmt: skip
    strength: str = setting("S2", meaning="Strength combination that is compared.")
    deflection: str = setting("D2", meaning="Deflection combination that is compared.")
    solver: str = setting(
        "multifrontal", choices=("multifrontal", "scipy"),
        meaning="Solver of the independent code; scipy is the plain path, slower, for audits.",
    )  # fmt: skip
    tolerance: Tolerance
