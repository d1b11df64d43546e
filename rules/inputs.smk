# Files: logs and times of jobs, what the rules over all designs read and write.

from foldshell.claims.sensitivity import VARIANTS
from foldshell.exchange.formats import name_files
from foldshell.records.catalogue import FILES
from foldshell.settings.own import settings_of


def own_settings(wildcards):
    """Return the settings of a design: its own file's, or those of the study."""
    return settings_of(SETTINGS, BY_NAME[wildcards.design])


def results_folder(_wildcards):
    """Return the folder of all results, as a parameter."""
    return place()


def place():
    """Return the folder of all results as it is found on this machine: below the prefix of a
    module, or with the local copies of a storage."""
    return str(rules.pattern.output.fold).partition("/{design}/")[0]


def timing(rule, suffix=""):
    """Return where the time and memory of each job of a rule are kept."""
    return f"{RESULTS}/benchmarks/{rule}/{{design}}{suffix}.tsv"


def log_of(rule, suffix=""):
    """Return where what each job of a rule prints is kept."""
    return f"{RESULTS}/logs/{rule}/{{design}}{suffix}.log"


def study_log(rule, tag=SETTINGS.study):
    """Return where what a job over all designs of a study prints is kept."""
    return f"{RESULTS}/logs/{rule}/{tag}.log"


def study_timing(rule, tag=SETTINGS.study):
    """Return where the time and memory of a job over all designs of a study are kept."""
    return f"{RESULTS}/benchmarks/{rule}/{tag}.tsv"


SCHEMAS = [f"{RESULTS}/schemas/{file.name}.schema.json" for file in FILES]


def design_files(name):
    """Return what is made of a design, but its manifest."""
    files = ["design.xlsx", "design.vtu", "crosscheck/comparison.json", "page.html"]
    files += ["sheet.html", "checks/engineering.json"]
    files += [f"figures/{picture}.png" for picture in [*PICTURES, "reinforcement"]]
    unfolded = [f"pattern/developable_pattern.{kind}" for kind in ("fold", "dxf", "svg")]
    files += unfolded * BY_NAME[name].has_developable
    return [f"{RESULTS}/{name}/{file}" for file in files]


def manifests(tag):
    """Return the manifest of every design with a tag."""
    return [f"{RESULTS}/{name}/manifest.json" for name in names_of_tag(tag)]


def study_files(tag):
    """Return what is made of every design with a tag, their summary, and schemas of all files."""
    files = [file for name in names_of_tag(tag) for file in design_files(name)]
    return SCHEMAS + files + manifests(tag) + [f"{RESULTS}/{STUDIES}/{tag}/summary.csv"]


def summary_inputs(tag):
    """Return the result files that the summary of a tag's designs reads, and take note of the study:
    a copy of what it made is put into the folder of results at the end of the run."""
    RUN["studies"].append(tag)
    files = ["folded/quality.json", "sizing/final.json", "mesh_convergence.json"]
    files += ["crosscheck/comparison.json", "checks/engineering.json"]
    files.append("sizing/classes.json")  # not read: the loops of a summary are whole
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
    "flats": [d for d in STUDIED if d.pattern == "miura" and not d.support_rows and flat_of(d)],
}
SIZED = ["folded/folded.npz", "folded/quality.json", "shell/mesh.npz", "mesh_convergence.json"]
SIZED += ["sizing/00/analysis.json", "sizing/00/analysis.npz", "sizing/final.json"]
SIZED += ["sizing/final.npz", "crosscheck/comparison.json", "checks/engineering.json"]


def exported(design):
    """Return the files of all formats that are asked for, of a design."""
    names = SETTINGS.exports.formats
    files = [file for name in names for file in name_files(name, design)]
    more = [f"records/{name}.json" for name in names] + ["index.html"]
    return [f"{RESULTS}/{design}/exports/{file}" for file in files + more]
