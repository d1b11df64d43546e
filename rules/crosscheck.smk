# The final state once more, by an independent FE code, each code on two meshes.


rule neutral_model:
    message:
        "{wildcards.design}: neutral model"
    input:
        mesh=rules.mesh.output.mesh,
        final=rules.size.output.arrays,
        library=library("neutral_model"),
    output:
        model=f"{RESULTS}/{{design}}/crosscheck/model.json",
    params:
        settings=of_stage("crosscheck"),
    priority: AFTER_LOOP
    benchmark:
        timing("neutral_model")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/neutral_model.py"


rule refine:
    message:
        "{wildcards.design}: mesh error"
    input:
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        library=library("refine"),
    output:
        study=f"{RESULTS}/{{design}}/mesh_study.json",
        primary=f"{RESULTS}/{{design}}/crosscheck/primary.json",
    params:
        **of_design("support"),
        edge_beam=edge_beam,
        subdivisions=subdivisions,
        settings=of_stage("crosscheck"),
    priority: AFTER_LOOP
    benchmark:
        timing("refine")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/refine.py"


rule crosscheck:
    message:
        "{wildcards.design}: cross-check by the independent code"
    input:
        model=rules.neutral_model.output.model,
        primary=rules.refine.output.primary,
        library=library("crosscheck"),
    output:
        comparison=f"{RESULTS}/{{design}}/crosscheck/comparison.json",
        workbook=f"{RESULTS}/{{design}}/crosscheck/comparison.xlsx",
    params:
        subdivisions=SETTINGS.crosscheck.subdivisions,
        tolerance=stage_parameters(SETTINGS, "crosscheck")["crosscheck"]["tolerance"],
    priority: AFTER_LOOP
    benchmark:
        timing("crosscheck")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/crosscheck.py"


THIRD = [f"{RESULTS}/{d.name}/crosscheck" for d in DESIGNS if "supports" in d.tags]


rule crosscheck_opensees:
    message:
        "A third opinion by OpenSees, where openseespy is installed"
    input:
        models=[f"{folder}/model.json" for folder in THIRD],
        primaries=[f"{folder}/primary.json" for folder in THIRD],
        library=library("crosscheck_opensees"),
    output:
        table=f"{RESULTS}/crosscheck_opensees.csv",
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/crosscheck_opensees.py"
