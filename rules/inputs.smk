# Files: logs and times of jobs, what the rules over all designs read and write.

from foldshell.claims.sensitivity import VARIANTS
from foldshell.results.comparisons import explain_left_out
from foldshell.settings.stages import FINAL_STATE


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
    """Return the rows of designs.tsv that a summary lists, with their subdivisions."""
    return [
        BY_NAME[name].to_row() | {"mesh_subdivisions": choose_subdivisions(SETTINGS, BY_NAME[name])}
        for name in names_of_tag(tag)
    ]


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


LEFT_OUT = explain_left_out(design.to_row() for design in with_tags(SETTINGS.study))
# Two halves, for two cores: nothing but the report comes after them.
CHARTS = ["supports", "surface", "curvature", "axes"]
CHARTS = [name for name in CHARTS if name not in LEFT_OUT]
PANEL_CHARTS = ["density_zigzag", "density_strip", "planarity_utilization"]
PANEL_CHARTS = [name for name in PANEL_CHARTS if name not in LEFT_OUT]
SHEETS = ["all_thickness", "all_utilization"]


def figure(name):
    """Return a figure over all designs, flagged for the report."""
    return report(
        f"{RESULTS}/figures/{name}.png",
        category="3 Figures",
        caption="../docs/report/figure.rst",
        labels={"figure": name.replace("_", " ")},
    )


def charts(names):
    """Return the outputs of a rule that draws charts."""
    return {name: [figure(name), f"{RESULTS}/figures/{name}.svg"] for name in names}


def final_states(_wildcards):
    """Return what figures over all designs read."""
    names = names_of_tag(SETTINGS.study)
    return [f"{RESULTS}/{name}/{file}" for name in names for file in FINAL_STATE]


def has_claims():
    """Tell whether the claims are judged or asked for: they need many more runs than the study."""
    asked = is_target("report", "snakemake_report", "claims")
    return asked or Path(f"{RESULTS}/claims.json").exists()


def judged_claims(wildcards):
    """Return the claims for the report, nothing where they are not judged."""
    return f"{RESULTS}/claims.json" if has_claims() else []


def charts_of_study(wildcards):
    """Return the charts that compare anything."""
    return [f"{RESULTS}/figures/{name}.png" for name in CHARTS + PANEL_CHARTS]


def report_files(wildcards):
    """Return what Snakemake's own report shows."""
    pages = [f"{RESULTS}/report/{name}.html" for name in ("summary", "verification", "settings")]
    pages += [f"{RESULTS}/timings.csv"] + [f"{RESULTS}/report/claims.html"] * has_claims()
    figures = [f"{RESULTS}/figures/{name}.png" for name in CHARTS + PANEL_CHARTS + SHEETS]
    designs = [f"{RESULTS}/{name}/page.html" for name in names_of_tag(SETTINGS.study)]
    return pages + figures + designs


def report_designs(wildcards):
    """Return the files of designs that our report reads, and the pages that it leads to."""
    files = ["sizing/final.json", "crosscheck/comparison.json", "mesh_convergence.json", "page.html"]
    return [f"{RESULTS}/{name}/{file}" for name in names_of_tag(SETTINGS.study) for file in files]
