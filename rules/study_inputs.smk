# What rules about all designs read: functions of their inputs.

from foldshell.claims.sensitivity import DELIVERED, SHEAR
from foldshell.files.errors import InputError


def delivered_state(wildcards):
    """Return final state and cross-check of a design for a variant that does not size it anew."""
    if wildcards.variant not in (*DELIVERED, SHEAR):
        return []
    files = ["sizing/final.json", "sizing/final.npz", "crosscheck/comparison.json"]
    return [f"{RESULTS}/{wildcards.design}/{file}" for file in files]


def explored_tables(wildcards):
    """Return the explore.tsv of all explorations in the results."""
    found = sorted(map(str, Path(RESULTS).glob("explorations/*/explore.tsv")))
    with user_errors():
        if not found:
            raise InputError(
                f"{RESULTS}/explorations: no exploration has been run: type snakemake explore "
                "--config exploration=FILE first"
            )
    return found


def name_an_exploration(wildcards):
    """Say which setting the targets `explore` and `beside` need."""
    with user_errors():
        raise InputError(
            "exploration: none is named: type --config exploration=FILE, such as "
            "config/explorations/paraboloid_strip.yaml"
        )
