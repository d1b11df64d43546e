# Files: what charts, report and sheets over all designs read.

from foldshell.files.whole import hash_file
from foldshell.results.comparisons import explain_left_out
from foldshell.settings.check import parse_group
from foldshell.settings.stages import FINAL_STATE

LEFT_OUT = explain_left_out(with_tags(SETTINGS.study))
# Two halves, for two cores: nothing but the report comes after them.
CHARTS = ["supports", "surface", "curvature", "axes"]
CHARTS = [name for name in CHARTS if name not in LEFT_OUT]
PANEL_CHARTS = ["density_zigzag", "density_strip", "planarity_utilization"]
PANEL_CHARTS = [name for name in PANEL_CHARTS if name not in LEFT_OUT]
SHEETS = ["all_thickness", "all_utilization"]


def figure(name):
    """Return a figure over all designs, flagged for the report."""
    return report(
        f"{STUDY}/figures/{name}.png",
        category="3 Figures",
        caption="../docs/report/figure.rst",
        labels={"figure": name.replace("_", " ")},
    )


def charts(names):
    """Return the outputs of a rule that draws charts."""
    return {name: [figure(name), f"{STUDY}/figures/{name}.svg"] for name in names}


def final_states(_wildcards):
    """Return what figures over all designs read."""
    names = names_of_tag(SETTINGS.study)
    return [f"{RESULTS}/{name}/{file}" for name in names for file in FINAL_STATE]


def has_claims():
    """Tell whether the claims are judged or asked for: they need many more runs than the study."""
    asked = is_target("report", "claims")
    return asked or Path(f"{STUDY}/claims.json").exists()


def judged_claims(wildcards):
    """Return the claims for the report, nothing where they are not judged."""
    return f"{STUDY}/claims.json" if has_claims() else []


def judged_reinforced(wildcards):
    """Return the claims on shells that stand, nothing where they are neither asked for nor there."""
    path = f"{STUDY}/claims_reinforced.json"
    return path if is_target("claims_reinforced") or Path(path).exists() else []


def summaries_beside(wildcards):
    """Return the summaries of other studies in the results, by tag, with their content: designs of
    them may be those of this study under settings of their own."""
    found = sorted(Path(place()).glob(f"{STUDIES}/*/summary.csv"))
    others = [path for path in found if path.parent.name != SETTINGS.study]
    return {path.parent.name: [str(path), hash_file(path)] for path in others}


def answer_of_explorations(wildcards):
    """Return the page of all explorations and its charts, nothing where none has been run."""
    folder = Path(RESULTS, "explorations")
    names = ["function_follows_fold.md"]
    names += [f"images/fold_answer_{name}.png" for name in ("factors", "panels")]
    return [f"{folder}/{name}" for name in names] if any(folder.glob("*/explore.tsv")) else []


def charts_of_study(wildcards):
    """Return the charts that compare anything."""
    return [f"{STUDY}/figures/{name}.png" for name in CHARTS + PANEL_CHARTS]


def report_files(wildcards):
    """Return what Snakemake's own report shows."""
    pages = [f"{STUDY}/report/{name}.html" for name in ("summary", "verification", "settings")]
    pages += [f"{STUDY}/timings.csv"] + [f"{STUDY}/report/claims.html"] * has_claims()
    figures = [f"{STUDY}/figures/{name}.png" for name in CHARTS + PANEL_CHARTS + SHEETS]
    designs = [f"{RESULTS}/{name}/page.html" for name in names_of_tag(SETTINGS.study)]
    return pages + figures + designs


def report_designs(wildcards):
    """Return the files of designs that our report reads, and the pages that it leads to."""
    files = ["sizing/final.json", "sizing/final.npz", "folded/folded.npz"]
    files += ["crosscheck/comparison.json", "mesh_convergence.json", "page.html", "sheet.html"]
    files.append("checks/engineering.json")
    return [f"{RESULTS}/{name}/{file}" for name in names_of_tag(SETTINGS.study) for file in files]


def sheets_of_study(wildcards):
    """Return the calculation sheets of all designs as PDF."""
    return [f"{RESULTS}/{name}/sheet.pdf" for name in names_of_tag(SETTINGS.study)]
