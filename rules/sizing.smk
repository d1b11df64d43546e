# The thickness loop: workbook NN -> analyse NN -> resize NN -> workbook NN + 1, one real job each.
# `analyse` is a checkpoint; `size` follows NN = 00, 01, ... until a verdict ends the loop.


rule start:
    message:
        "{wildcards.design}: start thickness"
    input:
        library=code_inputs("start"),
    output:
        workbook=f"{LOOP}/00/thickness.xlsx",
        record=f"{LOOP}/00/written.json",
    params:
        **of_design("zigzag", "strip"),
        **{name: getattr(SETTINGS.sizing, name) for name in THICKNESSES},
        settings_hash=settings_hash_of("start"),
    priority: BEFORE_LOOP
    benchmark:
        timing("start")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/start.py"


checkpoint analyse:
    message:
        "{wildcards.design}: analysis {wildcards.iteration}"
    input:
        mesh=rules.mesh.output.mesh,
        workbook=f"{STEP}/thickness.xlsx",
        previous=previous_iteration(["analysis.json", "analysis.npz"]),
        library=code_inputs("analyse"),
    output:
        json=f"{STEP}/analysis.json",
        arrays=f"{STEP}/analysis.npz",
    params:
        **of_design("span_m", "zigzag", "strip"),
        settings=of_stage("analyse"),
    benchmark:
        timing("analyse", "-{iteration}")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/analyse.py"


rule resize:
    wildcard_constraints:
        iteration=r"0[1-9]|[1-9]\d",
    message:
        "{wildcards.design}: thickness {wildcards.iteration}"
    input:
        analysis=previous_iteration(["analysis.json", "analysis.npz"]),
        memory=memory_before_last,
        library=code_inputs("resize"),
    output:
        workbook=f"{STEP}/thickness.xlsx",
        memory=f"{STEP}/memory.npz",
        record=f"{STEP}/written.json",
    params:
        **of_design("zigzag", "strip"),
        settings=of_stage("resize"),
        settings_hash=settings_hash_of("resize"),
    benchmark:
        timing("resize", "-{iteration}")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/resize.py"


rule group:
    message:
        "{wildcards.design}: thickness classes"
    input:
        mesh=rules.mesh.output.mesh,
        analyses=iterations,
        library=code_inputs("group"),
    output:
        json=f"{LOOP}/classes.json",
        arrays=f"{LOOP}/classes.npz",
    params:
        **of_design("span_m"),
        classes=SETTINGS.sizing.classes,
        settings=of_stage("analyse"),
    priority: AFTER_LOOP
    benchmark:
        timing("group")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/group.py"


rule size:
    message:
        "{wildcards.design}: history and final state"
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
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        settings=of_stage("size"),
        settings_hash=settings_hash_of("size"),
    priority: AFTER_LOOP
    benchmark:
        timing("size")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/size.py"
