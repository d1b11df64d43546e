# What leaves the pipeline: pictures.


rule draw:
    message:
        "{wildcards.design}: pictures and final fields"
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        report=rules.size.output.final,
        library=library("draw"),
    output:
        **{name: f"{RESULTS}/{{design}}/figures/{name}.png" for name in PICTURES},
        vtu=f"{RESULTS}/{{design}}/design.vtu",
        lines=f"{RESULTS}/{{design}}/design_lines.vtu",
    params:
        **of_design("span_m"),
        settings=lambda wildcards: of_stage("size")(wildcards) | of_stage("figures")(wildcards),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/draw.py"
