# The thickness loop: workbook NN -> analyse NN -> resize NN -> workbook NN + 1, one real job each.
# `analyse` is a checkpoint; `size` follows NN = 00, 01, ... until a verdict ends the loop.


rule start:
    input:
        folded=panels_of_file,
        library=code_inputs("start"),
    output:
        workbook=f"{LOOP}/00/thickness.xlsx",
        record=f"{LOOP}/00/written.json",
    log:
        log_of("start"),
    benchmark:
        timing("start")
    priority: BEFORE_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        **LOOP_PARAMS["start"],
    message:
        "{wildcards.design}: start thickness"
    script:
        "../scripts/start.py"


checkpoint analyse:
    input:
        mesh=rules.mesh.output.mesh,
        workbook=f"{STEP}/thickness.xlsx",
        previous=previous_iteration(["analysis.json", "analysis.npz"]),
        folded=panels_of_file,
        library=code_inputs("analyse"),
    output:
        json=f"{STEP}/analysis.json",
        arrays=f"{STEP}/analysis.npz",
    log:
        log_of("analyse", "-{iteration}"),
    benchmark:
        timing("analyse", "-{iteration}")
    conda:
        "../envs/foldshell.yaml"
    threads: threads_of
    resources:
        **needs_of("analyse"),
    params:
        **LOOP_PARAMS["analyse"],
    message:
        "{wildcards.design}: analysis {wildcards.iteration}"
    script:
        "../scripts/analyse.py"


rule resize:
    input:
        analysis=previous_iteration(["analysis.json", "analysis.npz"]),
        memory=memory_before_last,
        folded=panels_of_file,
        library=code_inputs("resize"),
    output:
        workbook=f"{STEP}/thickness.xlsx",
        memory=f"{STEP}/memory.npz",
        record=f"{STEP}/written.json",
    log:
        log_of("resize", "-{iteration}"),
    benchmark:
        timing("resize", "-{iteration}")
    wildcard_constraints:
        iteration=r"0[1-9]|[1-9]\d",
    conda:
        "../envs/foldshell.yaml"
    params:
        **LOOP_PARAMS["resize"],
    message:
        "{wildcards.design}: thickness {wildcards.iteration}"
    script:
        "../scripts/resize.py"
