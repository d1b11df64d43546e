# The thickness loop: workbook NN -> analyse NN -> resize NN -> workbook NN + 1, one real job each.
# `analyse` is a checkpoint; `size` follows NN = 00, 01, ... until a verdict ends the loop.

import json

LOOP = f"{RESULTS}/{{design}}/sizing"
STEP = f"{LOOP}/{{iteration}}"


def before(name):
    """Return a function of the wildcards: a file of the iteration before, none for the first."""

    def find(wildcards):
        number = int(wildcards.iteration) - 1
        folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
        return [f"{folder}/{file}" for file in name] if number >= 0 else []

    return find


def memory_before_last(wildcards):
    """Return what the sizing rule remembers of the step before the one it takes now."""
    number = int(wildcards.iteration) - 1
    folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
    return [f"{folder}/memory.npz"] if number > 0 else []


def iterations(wildcards):
    """Return every analysis.json up to the first whose verdict ends the loop.

    A file that cannot be read ends the list; `size` says what is wrong with it.
    """
    files = []
    for number in range(100):
        step = checkpoints.analyse.get(design=wildcards.design, iteration=f"{number:02d}")
        files.append(step.output.json)
        try:
            going_on = json.loads(Path(files[-1]).read_text())["verdict"] == "continue"
        except (OSError, ValueError, KeyError, TypeError):
            going_on = False
        if not going_on:
            break
    return files


rule start:
    message:
        "{wildcards.design}: start thickness"
    input:
        library=library("start"),
    output:
        workbook=f"{LOOP}/00/thickness.xlsx",
        record=f"{LOOP}/00/written.json",
    params:
        **of_design("zigzag", "strip"),
        **{
            name: getattr(SETTINGS.sizing, name)
            for name in ("start_thickness", "least_thickness", "largest_thickness")
        },
        settings_hash=settings_hash_of("start"),
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
        previous=before(["analysis.json", "analysis.npz"]),
        library=library("analyse"),
    output:
        json=f"{STEP}/analysis.json",
        arrays=f"{STEP}/analysis.npz",
    params:
        **of_design("span_m", "zigzag", "strip"),
        settings=of_stage("analyse"),
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
        analysis=before(["analysis.json", "analysis.npz"]),
        memory=memory_before_last,
        library=library("resize"),
    output:
        workbook=f"{STEP}/thickness.xlsx",
        memory=f"{STEP}/memory.npz",
        record=f"{STEP}/written.json",
    params:
        **of_design("zigzag", "strip"),
        settings=of_stage("resize"),
        settings_hash=settings_hash_of("resize"),
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
        library=library("group"),
    output:
        json=f"{LOOP}/classes.json",
        arrays=f"{LOOP}/classes.npz",
    params:
        **of_design("span_m"),
        classes=SETTINGS.sizing.classes,
        settings=of_stage("analyse"),
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
        library=library("size"),
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
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/size.py"
