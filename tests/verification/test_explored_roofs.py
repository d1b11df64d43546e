"""What a search of the pattern finds on the paraboloid of the paper, as docs/explore.md says.

The limits are those of config/explorations. The bounds stand well above what was found (39.3 m3 on
strip edges; 40.0, 41.1 and 42.4 on zig-zag edges), and below the lightest density of Table 1 on the
same mesh (87.6 m3): they hold the claim, not the last digits of a search.
"""

import pytest

pytest.importorskip("sklearn", reason="envs/explore.lock is not installed")

from explored_search import open_search, run_search
from scipy.stats import spearmanr


@pytest.mark.verification
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(
    ("name", "most"), [("paraboloid_strip", 43.0), ("paraboloid_zigzag", 50.0)]
)
def test_a_lighter_pattern_is_found(name, seed, most):
    """60 designs, the factor of the limits (4), and cheap answers that rank them (Spearman)."""
    rounds = open_search(name, seed)[0].search.rounds + 1
    records = run_search(name, seed, rounds)
    assert len(records) == 60
    best = min((one for one in records if one.feasible), key=lambda one: one.volume_m3)
    assert best.volume_m3 <= most and best.buckling_factor_min >= 4
    sized = [one for one in records if one.volume_m3 and one.cheap_m3]
    ranks = spearmanr([one.cheap_m3 for one in sized], [one.volume_m3 for one in sized])
    assert ranks.statistic >= 0.85
