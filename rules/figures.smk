# Figures over all designs.

from foldshell.settings.stages import FINAL_STATE

# Two halves, for two cores: nothing but the report comes after them.
CHARTS = ["supports", "surface", "curvature", "axes"]
PANEL_CHARTS = ["density_zigzag", "density_strip", "planarity_utilization"]
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


rule study_figures:
    message:
        "charts over all designs"
    input:
        summary=rules.summary.output.csv,
        designs=final_states,
        library=code_inputs("study_figures"),
    output:
        **charts(CHARTS),
    params:
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "size"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/study_figures.py"


use rule study_figures as panel_figures with:
    message:
        "charts of the panels of all designs"
    output:
        **charts(PANEL_CHARTS),


rule all_designs:
    message:
        "all designs on one page"
    input:
        summary=rules.summary.output.csv,
        designs=final_states,
        library=code_inputs("all_designs"),
    output:
        **{name: figure(name) for name in SHEETS},
    params:
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "size"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/all_designs.py"
