# What rules about all designs read: functions of their inputs.

from foldshell.claims.sensitivity import DELIVERED, SHEAR
from foldshell.files.errors import InputError
from foldshell.files.whole import hash_file


def delivered_state(wildcards):
    """Return final state and cross-check of a design for a variant that does not size it anew."""
    if wildcards.variant not in (*DELIVERED, SHEAR):
        return []
    files = ["sizing/final.json", "sizing/final.npz", "crosscheck/comparison.json"]
    return [f"{RESULTS}/{wildcards.design}/{file}" for file in files]


def timed_files():
    """Return what is made last of a study: its times are all there then."""
    return [f"{STUDY}/report.html", f"{STUDY}/manifest.json", *study_files(SETTINGS.study)]


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


def explored_beside(wildcards):
    """Return what stands beside those tables, as far as it has been made."""
    folder = Path(RESULTS, "explorations")
    names = ("confirmed.csv", "selected.tsv", "rivals/*.csv", "rivals/about.json")
    return sorted(str(path) for name in names for path in folder.glob(f"*/{name}"))


def table_summary():
    """Return the summary of the study of Table 1 with its hash, nothing where it has not been run.

    No input: as one it would have the whole study made anew where its code has changed.
    """
    path = f"{RESULTS}/{STUDIES}/table1/summary.csv"
    return [path, hash_file(path)] if Path(path).is_file() else []


def name_an_exploration(wildcards):
    """Say which setting the targets `explore` and `beside` need."""
    with user_errors():
        raise InputError(
            "exploration: none is named: type --config exploration=FILE, such as "
            "config/explorations/paraboloid_strip.yaml"
        )


def flat_sheet(wildcards):
    """Return folded.npz of the flat sheet that a design is held against, none without one."""
    named = wildcards.design in {d.name for d in JUDGED["flats"]}
    flat = flat_of(BY_NAME[wildcards.design]) if named else None
    return f"{RESULTS}/{flat}/folded/folded.npz" if flat else []
