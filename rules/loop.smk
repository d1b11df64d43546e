# How the rules of the thickness loop find the iterations before.

import json

CLASSES = {"json": f"{LOOP}/classes.json", "arrays": f"{LOOP}/classes.npz"}
FINAL = {
    "final": f"{LOOP}/final.json",
    "arrays": f"{LOOP}/final.npz",
    "csv": f"{LOOP}/history.csv",
    "history": f"{LOOP}/history.xlsx",
    "panels": f"{LOOP}/iterations.npz",
}
"""What the end of a loop leaves, by either way to run it."""
LOOP_PARAMS = {
    "start": {
        **of_design("zigzag", "strip"),
        "settings": of_stage("start"),
        "settings_hash": decisions,
    },
    "analyse": {
        **of_design("span_m", "zigzag", "strip"),
        "settings": of_stage("analyse"),
        "settings_hash": decisions,
    },
    "resize": {**of_design("zigzag", "strip"), "settings": of_stage("resize")},
    "group": {
        **of_design("span_m"),
        "classes": lambda wildcards: own_settings(wildcards).sizing.classes,
        "settings": of_stage("analyse"),
    },
    "size": {
        "design": lambda wildcards: BY_NAME[wildcards.design].to_row(),
        "settings": of_stage("size"),
    },
}
"""Parameters of the jobs of a loop."""


def arrays_of(files):
    """Return a function of the wildcards: the .npz beside each .json that another one returns."""
    return lambda wildcards: [f"{path.removesuffix('.json')}.npz" for path in files(wildcards)]


def previous_iteration(names):
    """Return a function of the wildcards: files of the iteration before, none for the first."""

    def find(wildcards):
        number = int(wildcards.iteration) - 1
        folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
        return [f"{folder}/{name}" for name in names] if number >= 0 and not REPORTING else []

    return find


def memory_before_last(wildcards):
    """Return what the sizing rule remembers of the step before the one it takes now."""
    number = int(wildcards.iteration) - 1
    folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
    return [f"{folder}/memory.npz"] if number > 0 and not REPORTING else []


RUN = {"started": False, "studies": []}
"""Whether jobs run already (see `onstart`), and the studies whose summary is up to date at the end."""

REPORTING = "--report" in sys.argv
"""No job will run: the last analysis of a loop stands for all, and makes a thousand jobs a hundred.
The graph has all rules, but not the way back from analyse to resize."""


def asks_for_another(file):
    """Tell whether an analysis asks for another one. One that cannot be read does: unknown is not
    ended, and the job that takes the next step says what is wrong with it."""
    try:
        if getattr(file, "is_storage", False):
            with file.open() as stream:
                return json.load(stream)["verdict"] == "continue"
        return read_verdict(str(file), os.stat(file).st_mtime_ns) == "continue"
    except (OSError, ValueError, KeyError, TypeError):
        return True


def existing_analyses(design, first):
    """Return the analysis.json that exist from iteration `first` on, up to the end of the loop."""
    files = []
    for number in range(first, 100):
        path = f"{design}/sizing/{number:02d}/analysis.json"
        if not Path(f"{place()}/{path}").exists():
            break
        files.append(f"{RESULTS}/{path}")
        if not asks_for_another(f"{place()}/{path}"):
            break
    return files


def iterations(wildcards):
    """Return every analysis.json up to the first whose verdict ends the loop.

    An analysis that is still to be made is returned as what it is waited for, in plain text: the
    exception, and its own name of the file, have Snakemake look at all jobs once more after each
    analysis. All that a former run has left is returned at once: Snakemake then looks at a finished
    study three times, where following it analysis by analysis took thirty looks, and what need not
    be made anew is there. What has to be is followed one by one as soon as the first of it is made.
    """
    if REPORTING:
        return existing_analyses(wildcards.design, 0)[-1:]
    files = []
    for number in range(100):
        path = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}/analysis.json"
        made = find_analysis(design=wildcards.design, iteration=f"{number:02d}")
        if not made:
            return files + (existing_analyses(wildcards.design, number) or [path])
        files.append(path)
        if not asks_for_another(made):
            break
    return files
