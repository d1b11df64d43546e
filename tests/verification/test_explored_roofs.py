"""What a search of the pattern finds on the paraboloid of the paper, as docs/explore.md says.

The limits are those of config/explorations. The bounds stand well above what was found (39.3 m3 on
strip edges, 40.0 and 41.1 on zig-zag edges), and below the lightest density of Table 1 on the same
mesh (87.6 m3): they hold the claim, not the last digits of a search.
"""

from pathlib import Path

import pytest

pytest.importorskip("sklearn", reason="envs/explore.lock is not installed")

from dataclasses import replace

from scipy.stats import spearmanr

from foldshell.explore.evaluate import evaluate
from foldshell.explore.folded import make_design
from foldshell.explore.rounds import propose_round
from foldshell.settings.config_file import read_config
from foldshell.settings.exploration_file import read_exploration
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import SEARCHED, search_parameters

CONFIG = Path(__file__).parents[2] / "config"


def search(name, seed):
    settings = make_settings(read_config(CONFIG / "config.yaml"))
    found = read_exploration(CONFIG / f"explorations/{name}.yaml", settings.defaults)
    found = replace(found, search=found.search.changed(seed=seed))
    design = make_design(found.base)
    stage = read_stage(search_parameters(settings, design), *SEARCHED)
    records = []
    for number in range(1, found.search.rounds + 2):
        rows, _ = propose_round(found, records, number, stage)
        records += [evaluate(row["design"], row, stage, found) for row in rows]
    assert len(records) == 60
    return records


@pytest.mark.verification
@pytest.mark.parametrize(
    ("name", "seed", "most"),
    [("paraboloid_strip", 1, 43.0), ("paraboloid_strip", 2, 43.0), ("paraboloid_strip", 3, 43.0),
     ("paraboloid_zigzag", 1, 50.0), ("paraboloid_zigzag", 2, 50.0)],
)  # fmt: skip
def test_a_lighter_pattern_is_found(name, seed, most):
    records = search(name, seed)
    best = min((one for one in records if one.feasible), key=lambda one: one.volume_m3)
    assert best.volume_m3 <= most and best.buckling_factor_min >= 4
    sized = [one for one in records if one.volume_m3 and one.cheap_m3]
    ranks = spearmanr([one.cheap_m3 for one in sized], [one.volume_m3 for one in sized])
    assert ranks.statistic >= 0.85
