# How the rules of the thickness loop find the iterations before.

import json

from snakemake.exceptions import IncompleteCheckpointException


def before(names):
    """Return a function of the wildcards: files of the iteration before, none for the first."""

    def find(wildcards):
        number = int(wildcards.iteration) - 1
        folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
        return [f"{folder}/{name}" for name in names] if number >= 0 else []

    return find


def memory_before_last(wildcards):
    """Return what the sizing rule remembers of the step before the one it takes now."""
    number = int(wildcards.iteration) - 1
    folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
    return [f"{folder}/memory.npz"] if number > 0 else []


REPORTING = "--report" in sys.argv
"""No job will run: the files that exist are all there is, and need not be followed one by one."""


def iterations(wildcards):
    """Return every analysis.json up to the first whose verdict ends the loop.

    A file that cannot be read ends the list; `size` says what is wrong with it. An analysis that
    is still to be made is returned as what it is waited for. Leaving that to Snakemake, which
    does the same with the exception, makes it look at all loops twice after each analysis.
    """
    files = []
    for number in range(100):
        if REPORTING:
            files.append(f"{RESULTS}/{wildcards.design}/sizing/{number:02d}/analysis.json")
        else:
            try:
                step = checkpoints.analyse.get(design=wildcards.design, iteration=f"{number:02d}")
            except IncompleteCheckpointException as missing:
                return [missing.targetfile]
            files.append(step.output.json)
        try:
            going_on = json.loads(Path(files[-1]).read_text())["verdict"] == "continue"
        except (OSError, ValueError, KeyError, TypeError):
            going_on = False
        if not going_on:
            break
    return files
