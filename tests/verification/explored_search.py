"""Searches in memory, as the rules of an exploration run them; records are kept within a session.

Designs of the even spread that break a limit of the folded sheet are not sized where nothing is
learned from them: they can be neither the best nor on a front.
"""

import functools
from dataclasses import replace
from pathlib import Path

from foldshell.explore.evaluate import evaluate, screen
from foldshell.explore.folded import make_design
from foldshell.explore.rounds import propose_round
from foldshell.settings.config_file import read_config
from foldshell.settings.exploration_check import settle_exploration
from foldshell.settings.exploration_file import read_exploration
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import SEARCHED, search_parameters

CONFIG = Path(__file__).parents[2] / "config"


@functools.cache
def open_search(name, seed, method="gaussian_process", aims=("volume_m3",)):
    """Return an exploration of config/explorations with its settings."""
    settings = make_settings(read_config(CONFIG / "config.yaml"))
    path = CONFIG / f"explorations/{name}.yaml"
    found = settle_exploration(read_exploration(path, settings.defaults), settings, str(path))
    search = found.search.changed(seed=seed, method=method)
    found = replace(found, search=search, aims=aims)
    stage = read_stage(search_parameters(settings, make_design(found.base)), *SEARCHED)
    return found, stage


@functools.cache
def try_round(name, seed, method, aims, number):
    """Return the records of a round; round 1 is the same for all methods and aims."""
    if number == 1 and (method, aims) != ("gaussian_process", ("volume_m3",)):
        return try_round(name, seed, "gaussian_process", ("volume_m3",), 1)
    found, stage = open_search(name, seed, method, aims)
    earlier = run_search(name, seed, number - 1, method, aims)
    rows, _ = propose_round(found, earlier, number, stage)
    if method == "sobol":
        rows = [row for row in rows if not screen(row, stage, found).broken]
    return tuple(evaluate(row["design"], row, stage, found) for row in rows)


def run_search(name, seed, rounds, method="gaussian_process", aims=("volume_m3",)):
    """Return the records of rounds 1 to `rounds`."""
    numbers = range(1, rounds + 1)
    return [one for number in numbers for one in try_round(name, seed, method, aims, number)]
