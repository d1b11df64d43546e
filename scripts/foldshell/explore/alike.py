"""How shells are sized that are to be compared: one rule, one measure, one buckling factor."""

from foldshell.records.rivals import KEPT
from foldshell.settings.field import Plain

RULE, MEASURE = "optimality", "panel_mean"
"""The one rule that keeps a buckling factor while it takes concrete away; the paper's measure."""


def size_alike(factor: float) -> Plain:
    """Return the settings of the group sizing for a buckling factor, which is a criterion too."""
    return {
        "rule": RULE, "measure": MEASURE, "thinning_buckling_factor_min": factor,
        "buckling_factor_min": KEPT * factor,
    }  # fmt: skip
