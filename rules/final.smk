# The end of the thickness loop: thickness classes, history and final state.


rule group:
    input:
        mesh=rules.mesh.output.mesh,
        analyses=iterations,
        library=code_inputs("group"),
    output:
        json=f"{LOOP}/classes.json",
        arrays=f"{LOOP}/classes.npz",
    log:
        log_of("group"),
    benchmark:
        timing("group")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        **of_design("span_m"),
        classes=SETTINGS.sizing.classes,
        settings=of_stage("analyse"),
    message:
        "{wildcards.design}: thickness classes"
    script:
        "../scripts/group.py"


rule size:
    input:
        analyses=iterations,
        classes=[rules.group.output.json, rules.group.output.arrays],
        library=code_inputs("size"),
    output:
        csv=f"{LOOP}/history.csv",
        history=f"{LOOP}/history.xlsx",
        design=f"{RESULTS}/{{design}}/design.xlsx",
        final=f"{LOOP}/final.json",
        arrays=f"{LOOP}/final.npz",
    log:
        log_of("size"),
    benchmark:
        timing("size")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        settings=of_stage("size"),
    message:
        "{wildcards.design}: history and final state"
    script:
        "../scripts/size.py"
