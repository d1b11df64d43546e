# What leaves the pipeline: pictures.


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
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/draw.py"


CHARTS = ["supports", "surface", "curvature", "density_zigzag", "density_strip", "axes"]
CHARTS += ["planarity_utilization"]
SHEETS = ["all_thickness", "all_utilization"]


rule study_figures:
    message:
        "figures over all designs"
    input:
        summary=rules.summary.output.csv,
        designs=[
            f"{RESULTS}/{name}/{file}"
            for name in names_of_tag(SETTINGS.study)
            for file in ("shell/mesh.npz", "folded/folded.npz", "sizing/final.npz",
                         "sizing/final.json")
        ],
        library=library("study_figures"),
    output:
        **{name: multiext(f"{RESULTS}/figures/{name}", ".png", ".svg") for name in CHARTS},
        **{name: f"{RESULTS}/figures/{name}.png" for name in SHEETS},
    params:
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "size"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/study_figures.py"


rule verify:
    message:
        "do the results still agree with what made them?"
    params:
        results=RESULTS,
    script:
        "../scripts/verify.py"
