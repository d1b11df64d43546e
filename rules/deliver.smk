# What leaves the pipeline: pictures, pages and the report.


rule draw:
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        report=rules.size.output.final,
        classes=CLASSES["arrays"],
        library=code_inputs("draw"),
    output:
        **{name: f"{RESULTS}/{{design}}/figures/{name}.png" for name in PICTURES},
        vtu=f"{RESULTS}/{{design}}/design.vtu",
        lines=f"{RESULTS}/{{design}}/design_lines.vtu",
    log:
        log_of("draw"),
    benchmark:
        timing("draw")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("draw"),
    params:
        **of_design("span_m", "pattern"),
        settings=lambda wildcards: of_stage("size")(wildcards) | of_stage("figures")(wildcards),
    message:
        "{wildcards.design}: pictures and final fields"
    script:
        "../scripts/draw.py"


rule page:
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        quality=rules.fold.output.quality,
        arrays=rules.size.output.arrays,
        final=rules.size.output.final,
        iterations=rules.size.output.panels,
        history=rules.size.output.csv,
        classes=CLASSES["json"],
        class_arrays=CLASSES["arrays"],
        mesh_convergence=rules.mesh_convergence.output.study,
        comparison=rules.compare.output.comparison,
        engineering=rules.check.output.record,
        pictures=[rules.draw.output[name] for name in PICTURES] + rules.reinforcement.output,
        library=code_inputs("page"),
        assets=assets(),
    output:
        page=report(
            f"{RESULTS}/{{design}}/page.html",
            category="4 Designs",
            caption="../docs/report/page.rst",
            labels={"design": "{design}"},
        ),
    log:
        log_of("page"),
    benchmark:
        timing("page")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("page"),
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        settings=of_stage("size"),
    message:
        "{wildcards.design}: page"
    script:
        "../scripts/page.py"
