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
