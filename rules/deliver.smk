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
        library=code_inputs("draw"),
    output:
        **{name: f"{RESULTS}/{{design}}/figures/{name}.png" for name in PICTURES},
        vtu=f"{RESULTS}/{{design}}/design.vtu",
        lines=f"{RESULTS}/{{design}}/design_lines.vtu",
    params:
        **of_design("span_m", "pattern"),
        settings=lambda wildcards: of_stage("size")(wildcards) | of_stage("figures")(wildcards),
    priority: AFTER_LOOP
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
        mesh_convergence=rules.mesh_convergence.output.study,
        comparison=rules.compare.output.comparison,
        pictures=[rules.draw.output[name] for name in PICTURES],
        library=code_inputs("page"),
        assets=assets(),
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
    priority: AFTER_LOOP
    benchmark:
        timing("page")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/page.py"
