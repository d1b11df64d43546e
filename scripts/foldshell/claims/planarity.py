"""Planarity against utilization over all panels, which the paper left open."""

from collections.abc import Sequence

import numpy as np

from foldshell.claims.design_result import DesignResult, select_folded
from foldshell.records.claims import ClaimNumbers, ClaimRecord, Correlation, Uncertainty
from foldshell.results.correlation import linear_correlation, rank_correlation

STRONG, WEAK = 0.5, 0.3
"""Sizes of a correlation from which it is called strong, and below which weak."""

RULE = (
    f"The verdict is on Spearman's correlations within designs: holds from {STRONG:g} in every "
    f"design and of one sign, fails below {WEAK:g} in every design, by absolute value; else mixed."
)
SIZED = (
    "Utilization is that of the sized designs. Sizing gives each panel its own thickness, which "
    "evens utilization out, so a correlation is of what sizing leaves."
)


def describe_planarity(design_results: Sequence[DesignResult]) -> ClaimRecord:
    """Return Spearman's and Pearson's correlation of planarity and mean utilization of panels.

    Of each design, of all panels pooled, and pooled by surface. Within a design loads and supports
    are one; pooled numbers mix designs of different utilization.
    """
    designs = [one for one in select_folded(design_results) if one.panels is not None]
    each = {one.name: _correlate(one.panels) for one in designs}
    surfaces = dict.fromkeys(one.row.surface for one in designs)
    pooled = {
        surface: _correlate(np.hstack([d.panels for d in designs if d.row.surface == surface]))
        for surface in surfaces
    }
    ranks = [one.spearman for one in each.values() if one.spearman is not None]
    numbers = ClaimNumbers(
        pooled=_correlate(np.hstack([one.panels for one in designs])) if designs else None,
        by_surface=pooled,
        by_design=each,
        spearman_median=float(np.median(ranks)) if ranks else None,
        spearman_range=(min(ranks), max(ranks)) if ranks else None,
        designs_positive=sum(rank > 0 for rank in ranks),
    )
    method = "none is estimated for correlations"
    return ClaimRecord(
        id="open_planarity",
        claim="Planarity and utilization of panels are related (left open by the paper)",
        verdict=judge_correlations(ranks),
        numbers=numbers,
        designs=tuple(sorted(each)),
        uncertainty=Uncertainty(largest_relative={}, method=method),
        notes=(RULE, SIZED),
    )


def judge_correlations(ranks: Sequence[float]) -> str:
    """Return holds where all are strong and of one sign, fails where all are weak."""
    if not ranks:
        return "cannot_be_told"
    sizes = [abs(rank) for rank in ranks]
    if min(sizes) >= STRONG and len({rank > 0 for rank in ranks}) == 1:
        return "holds"
    return "fails" if max(sizes) < WEAK else "mixed"


def _correlate(panels: np.ndarray) -> Correlation:
    values = {"spearman": rank_correlation(*panels), "pearson": linear_correlation(*panels)}
    known = {name: value if np.isfinite(value) else None for name, value in values.items()}
    return Correlation(panels=panels.shape[1], **known)
