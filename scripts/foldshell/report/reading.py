"""How numbers are to be read: order of the theory, which utilization decides, what was compared."""

from collections.abc import Iterable

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.comparison import ComparisonRecord

SECOND_ORDER = "Th.II"
"""Part of a combination's name in the cross-check that tells its values of second order."""


def say_theory(final: AnalysisRecord) -> str:
    """Return of which order displacement and utilization are, nothing where there are none."""
    if final.state != "ok":
        return ""
    if final.second_order_residual is None:
        order = "first order: equilibrium on the undeformed shell"
    else:
        order = "second order (Th.II): equilibrium on the deformed shell"
    return f"Displacement and utilization are of {order}."


def say_measure(final: AnalysisRecord) -> str:
    """Return which utilization decides, nothing where none was held against a limit."""
    if final.criteria.utilization_element_max is not None:
        return "The largest utilization of all points decides."
    if final.criteria.utilization_strip is not None:
        return "The largest mean over a facet or a strip beside a fold or border decides."
    if final.criteria.utilization_reinforced is not None:
        return "The largest share of what steel and concrete of a panel allow decides."
    if final.criteria.utilization_panel_mean is not None:
        return (
            "The mean utilization of a panel decides; peaks above the limit at points (red in the "
            "pictures) are for information."
        )
    return ""


def say_both(finals: Iterable[AnalysisRecord]) -> str:
    """Return theory and measure of one or more designs, each sentence once."""
    pairs = [(say_theory(final), say_measure(final)) for final in finals]
    columns = zip(*pairs, strict=True)
    return " ".join(words for column in columns for words in dict.fromkeys(column) if words)


def say_compared(comparison: ComparisonRecord) -> str:
    """Return what the values of the cross-check are: limits of meshes, first and second order."""
    orders = [item.primary_order for item in comparison.quantities.values()]
    if not any(orders):
        limit = ""
    else:
        limit = (
            "Values are extrapolated from the meshes of each code to their limit where they have "
            "one, those of the primary code too: they differ a little from the final state. "
        )
    linear = any(SECOND_ORDER not in name.split() for name in comparison.quantities)
    second = any(SECOND_ORDER in name.split() for name in comparison.quantities)
    if not (linear and second):
        return limit.strip()
    return (
        f"{limit}Rows with Th.II are of second order, as the final state is; the others are "
        "linear, of first order."
    )
