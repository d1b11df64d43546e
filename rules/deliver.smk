# What leaves the pipeline: pictures, pages and the report.


rule draw:
    message:
        "{wildcards.design}: pictures and final fields"
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        report=rules.size.output.final,
        classes=rules.group.output.arrays,
        library=library("draw"),
    output:
        **{name: f"{RESULTS}/{{design}}/figures/{name}.png" for name in PICTURES},
        vtu=f"{RESULTS}/{{design}}/design.vtu",
        lines=f"{RESULTS}/{{design}}/design_lines.vtu",
    params:
        **of_design("span_m", "pattern"),
        settings=lambda wildcards: of_stage("size")(wildcards) | of_stage("figures")(wildcards),
    benchmark:
        timing("draw")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/draw.py"


rule page:
    message:
        "{wildcards.design}: page"
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        quality=rules.fold.output.quality,
        arrays=rules.size.output.arrays,
        final=rules.size.output.final,
        history=rules.size.output.csv,
        classes=rules.group.output.json,
        class_arrays=rules.group.output.arrays,
        mesh_study=rules.refine.output.study,
        comparison=rules.crosscheck.output.comparison,
        pictures=[rules.draw.output[name] for name in PICTURES],
        library=library("page"),
        assets=assets(
            "page.css", "stage.html", "data.js", "renderer.js", "camera.js", "viewer.js"
        ),
    output:
        page=report(
            f"{RESULTS}/{{design}}/page.html",
            category="4 Designs",
            caption="../docs/report/page.rst",
            labels={"design": "{design}"},
        ),
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        settings=of_stage("size"),
    benchmark:
        timing("page")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/page.py"


CHARTS = ["supports", "surface", "curvature", "density_zigzag", "density_strip", "axes"]
CHARTS += ["planarity_utilization"]
SHEETS = ["all_thickness", "all_utilization"]
FILES = ["shell/mesh.npz", "folded/folded.npz", "sizing/final.npz", "sizing/final.json"]


def figure(name):
    """Return a figure over all designs, flagged for the report."""
    return report(
        f"{RESULTS}/figures/{name}.png",
        category="3 Figures",
        caption="../docs/report/figure.rst",
        labels={"figure": name.replace("_", " ")},
    )


def final_states(_wildcards):
    """Return what figures over all designs read."""
    return [f"{RESULTS}/{name}/{file}" for name in names_of_tag(SETTINGS.study) for file in FILES]


rule study_figures:
    message:
        "charts over all designs"
    input:
        summary=rules.summary.output.csv,
        designs=final_states,
        library=library("study_figures"),
    output:
        **{name: [figure(name), f"{RESULTS}/figures/{name}.svg"] for name in CHARTS},
    params:
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "size"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/study_figures.py"


rule all_designs:
    message:
        "all designs on one page"
    input:
        summary=rules.summary.output.csv,
        designs=final_states,
        library=library("all_designs"),
    output:
        **{name: figure(name) for name in SHEETS},
    params:
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "size"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/all_designs.py"


rule verify:
    message:
        "do the results still agree with what made them?"
    params:
        results=RESULTS,
    script:
        "../scripts/verify.py"
