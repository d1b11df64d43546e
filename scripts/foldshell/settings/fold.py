"""The crease pattern and how it is folded; angles in rad."""

from typing import Any

from foldshell.settings.field import Group, setting, settings_group

_DIAGONAL = "Fold angle across a panel's shorter diagonal against flat."
_STEEP = "The same where height / span is 0.8 or more."


def _weight(default: float, meaning: str) -> Any:
    return setting(default, minimum=0, maximum=1e6, meaning=meaning)


@settings_group
class Pattern(Group):
    """Crease pattern."""

    sector_angle: float = setting(
        60, unit="deg", above=0, below=90,
        meaning="Acute angle of a panel. The rest fold angle follows from it, so that the folded "
        "sheet has a Poisson's ratio of -1.",
    )  # fmt: skip


@settings_group
class FoldWeights(Group):
    """Weights of the terms, all without dimension."""

    # The steep ones were chosen by trial on the study's own 28 m / 28 m designs: neighbouring
    # values leave one to four of those 25 short of their figures (hinge_steep 0.1: about ten).
    stretch: float = _weight(10, "Change of length of every triangulated edge.")
    hinge: float = _weight(0.01, "Fold angle of creases against the rest angle.")
    hinge_steep: float = _weight(0.03, _STEEP)
    neutral_fold: float = _weight(
        0.01, "Fold angle across a panel's shorter diagonal against flat."
    )
    neutral_fold_steep: float = _weight(0.04, _STEEP)
    attraction: float = _weight(100, "Distance of the attracted vertices to the target surface.")
    plan_edge: float = _weight(0.03, "Distance of the border to the edge of the square plan.")
    plan_edge_steep: float = _weight(0.05, _STEEP)


@settings_group
class ExactWeights(Group):
    """Weights of the modes exact and rigid, while their constraints are tightened."""

    stretch: float = _weight(0.02, "Change of length against the standard Miura sheet.")
    hinge: float = _weight(0.01, "Fold angle of creases against the rest angle.")
    neutral_fold: float = _weight(
        0.01, "Fold angle across a panel's shorter diagonal against flat."
    )
    plan_edge: float = _weight(0.1, "Distance of the border to the edge of the square plan.")
    fairness: float = _weight(0.1, "Third differences of the vertices along zig-zags and strips.")
    attraction: float = _weight(
        100, "Distance of the attracted vertices to the target surface, in mode rigid."
    )
    margin: float = _weight(1, "Holds panels convex and folds on their own side.")


@settings_group
class FoldLimits(Group):
    """What a folded sheet must keep to be called ok."""

    rms_over_span: float = setting(
        0.002, above=0, maximum=1,
        meaning="Largest root mean square of the distances to the target, over the span; isometric "
        "mode allows 0.0016 at most.",
    )  # fmt: skip
    plan_coverage: float = setting(
        0.8, minimum=0, maximum=1,
        meaning="Least plan cover, as a share of what the sheet covers as it is first laid on the "
        "target.",
    )  # fmt: skip


@settings_group
class Fold(Group):
    """Folding onto the target surface."""

    engine: str = setting(
        "levenberg_marquardt", choices=("levenberg_marquardt", "averaged_projections"),
        meaning="Solver; averaged projections are the paper's way, kept for comparison.",
    )  # fmt: skip
    attract: str = setting(
        "lowest", choices=("lowest", "highest", "all"),
        meaning="Which vertices of the folded sheet are drawn to the target surface; a set "
        "`attract` in the file of a pattern stands above it.",
    )  # fmt: skip
    weights: FoldWeights
    exact: ExactWeights
    max_iterations: int = setting(
        60, unit="iterations", minimum=1, maximum=100000,
        meaning="Iterations of the engine before it gives up.",
    )  # fmt: skip
    tolerance: float = setting(
        1e-4, above=0, maximum=1,
        meaning="Relative fall of the cost below which the engine stops.",
    )  # fmt: skip
    limits: FoldLimits
