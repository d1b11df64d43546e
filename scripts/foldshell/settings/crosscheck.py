"""The comparison with the independent code."""

from foldshell.settings.field import Group, setting, settings_group

GOVERNING = "governing"
"""In place of the names of combinations: those that govern a criterion of the final state."""


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
    strength: tuple[str, ...] = setting(
        GOVERNING,
        meaning="Strength combinations that are compared: names, or `governing` for those of the "
        "largest panel mean of utilization and of the least buckling factor.",
    )
    deflection: tuple[str, ...] = setting(
        GOVERNING,
        meaning="Deflection combinations that are compared: names, or `governing` for that of the "
        "largest displacement.",
    )
    solver: str = setting(
        "multifrontal", choices=("multifrontal", "scipy"),
        meaning="Solver of the independent code; scipy is the plain path, slower, for audits.",
    )  # fmt: skip
    tolerance: Tolerance
