"""The claims that sized designs answer, C4 to C13."""

from collections.abc import Mapping, Sequence

from foldshell.claims import limits, structure
from foldshell.claims.design_result import Comparer, DesignResult
from foldshell.claims.statement import Claim
from foldshell.records.measures import FlatEqualRecord


def judge_sized(
    design_results: Sequence[DesignResult],
    equal: Sequence[DesignResult],
    flats: Mapping[str, FlatEqualRecord],
    comparer: Comparer,
) -> list[Claim]:
    """Return C4 to C13, the claims that sized designs answer.

    `equal` are states of one thickness for all panels, `flats` what the flat sheet of equal volume
    does, by folded design.
    """
    return [
        structure.judge_curvature(design_results, comparer),
        structure.judge_material(design_results, comparer),
        structure.judge_surfaces(design_results, comparer),
        structure.judge_supports(design_results, comparer, equal),
        structure.judge_zigzags(design_results, comparer, equal),
        structure.judge_strips(design_results, comparer),
        limits.judge_buckling(design_results, comparer),
        limits.judge_free_edges(design_results),
        limits.judge_deflected_edges(design_results, comparer),
        limits.judge_folds(design_results, flats, comparer),
    ]
