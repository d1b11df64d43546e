# Files: logs and times of jobs, what the rules over all designs read and write.

from foldshell.claims.sensitivity import VARIANTS


def results_folder(_wildcards):
    """Return the folder of all results, as a parameter."""
    return RESULTS


def timing(rule, suffix=""):
    """Return where the time and memory of each job of a rule are kept."""
    return f"{RESULTS}/benchmarks/{rule}/{{design}}{suffix}.tsv"


def log_of(rule, suffix=""):
    """Return where what each job of a rule prints is kept."""
    return f"{RESULTS}/logs/{rule}/{{design}}{suffix}.log"


def study_log(name):
    """Return where what a job over all designs prints is kept."""
    return f"{RESULTS}/logs/{name}.log"


def summary_inputs(tag):
    """Return the result files that the summary of a tag's designs reads."""
    files = ["folded/quality.json", "sizing/final.json", "mesh_convergence.json"]
    files.append("crosscheck/comparison.json")
    return [f"{RESULTS}/{name}/{file}" for name in names_of_tag(tag) for file in files]


def summary_rows(tag):
    """Return the rows of designs.tsv that a summary lists."""
    return [BY_NAME[name].to_row() for name in names_of_tag(tag)]


def layout_of(name):
    """Return counts of polylines and supports of a design."""
    return BY_NAME[name].zigzag, BY_NAME[name].strip, BY_NAME[name].support


def with_tags(*tags):
    """Return the designs with at least one of the tags, in the order of the table."""
    return [design for design in DESIGNS if set(tags) & set(design.tags)]


def flat_of(design):
    """Return the flat sheet of a folded design's own size and supports, None without one."""
    rows = {flat.name: flat.to_row() for flat in DESIGNS if flat.pattern == "flat"}
    own = {"design", "tags", "pattern"}
    wanted = {name: value for name, value in design.to_row().items() if name not in own}
    found = [name for name, row in rows.items() if wanted.items() <= row.items()]
    return found[0] if found else None


STUDIED = [d for d in with_tags("supports") if SETTINGS.study in d.tags]
JUDGED = {
    "sized": with_tags(SETTINGS.study, "baseline"),
    "folds": with_tags("fold_modes"),
    "runs": STUDIED,
    "flats": [d for d in STUDIED if d.pattern == "miura" and flat_of(d)],
}
SIZED = ["folded/folded.npz", "folded/quality.json", "shell/mesh.npz", "mesh_convergence.json"]
SIZED += ["sizing/00/analysis.json", "sizing/00/analysis.npz", "sizing/final.json"]
SIZED += ["sizing/final.npz", "crosscheck/comparison.json"]
