# The end of the thickness loop: thickness classes, history and final state.


rule group:
    input:
        mesh=rules.mesh.output.mesh,
        analyses=iterations,
        analysis_arrays=arrays_of(iterations),
        library=code_inputs("group"),
    output:
        **CLASSES,
    log:
        log_of("group"),
    benchmark:
        timing("group")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("analyse"),
    params:
        **LOOP_PARAMS["group"],
    message:
        "{wildcards.design}: thickness classes"
    script:
        "../scripts/group.py"


rule size:
    input:
        mesh=rules.mesh.output.mesh,
        analyses=iterations,
        analysis_arrays=arrays_of(iterations),
        folded=panels_of_file,
        library=code_inputs("size"),
    output:
        **FINAL,
    log:
        log_of("size"),
    benchmark:
        timing("size")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        **LOOP_PARAMS["size"],
    message:
        "{wildcards.design}: history and final state"
    script:
        "../scripts/size.py"
