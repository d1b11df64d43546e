# The engineering verdict on the final state: checks of its own, beside the paper's criteria.


rule check:
    input:
        mesh=rules.mesh.output.mesh,
        arrays=rules.size.output.arrays,
        final=rules.size.output.final,
        mesh_convergence=rules.mesh_convergence.output.study,
        library=code_inputs("check"),
    output:
        record=f"{RESULTS}/{{design}}/checks/engineering.json",
        arrays=f"{RESULTS}/{{design}}/checks/engineering.npz",
        workbook=f"{RESULTS}/{{design}}/checks/engineering.xlsx",
    log:
        log_of("check"),
    benchmark:
        timing("check")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("analyse"),
    params:
        **of_design("span_m"),
        settings=lambda wildcards: of_stage("size")(wildcards) | of_stage("checks")(wildcards),
    message:
        "{wildcards.design}: engineering checks"
    script:
        "../scripts/check.py"


include: "reinforcement.smk"


rule design_workbook:
    input:
        final=rules.size.output.final,
        arrays=rules.size.output.arrays,
        history=rules.size.output.csv,
        panels=rules.size.output.panels,
        classes=CLASSES["json"],
        class_arrays=CLASSES["arrays"],
        engineering=rules.check.output.record,
        engineering_arrays=rules.check.output.arrays,
        folded=panels_of_file,
        library=code_inputs("design_workbook"),
    output:
        workbook=f"{RESULTS}/{{design}}/design.xlsx",
    log:
        log_of("design_workbook"),
    benchmark:
        timing("design_workbook")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        **LOOP_PARAMS["size"],
    message:
        "{wildcards.design}: workbook"
    script:
        "../scripts/design_workbook.py"
