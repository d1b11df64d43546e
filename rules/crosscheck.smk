# The final state once more, by an independent FE code, each code on two meshes.


rule neutral_model:
    message:
        "{wildcards.design}: neutral model"
    input:
        mesh=rules.mesh.output.mesh,
        final=rules.size.output.arrays,
        library=code_inputs("neutral_model"),
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


rule mesh_convergence:
    message:
        "{wildcards.design}: mesh error"
    input:
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        library=code_inputs("mesh_convergence"),
    output:
        study=f"{RESULTS}/{{design}}/mesh_convergence.json",
        primary=f"{RESULTS}/{{design}}/crosscheck/primary.json",
    params:
        **of_design("support"),
        edge_beam=edge_beam,
        subdivisions=subdivisions,
        settings=of_stage("crosscheck"),
    priority: AFTER_LOOP
    benchmark:
        timing("mesh_convergence")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/mesh_convergence.py"


rule compare:
    message:
        "{wildcards.design}: cross-check by the independent code"
    input:
        model=rules.neutral_model.output.model,
        primary=rules.mesh_convergence.output.primary,
        library=code_inputs("compare"),
    output:
        comparison=f"{RESULTS}/{{design}}/crosscheck/comparison.json",
        workbook=f"{RESULTS}/{{design}}/crosscheck/comparison.xlsx",
    params:
        subdivisions=SETTINGS.crosscheck.subdivisions,
        solver=SETTINGS.crosscheck.solver,
        tolerance=stage_parameters(SETTINGS, "crosscheck")["crosscheck"]["tolerance"],
    priority: AFTER_LOOP
    benchmark:
        timing("compare")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/compare.py"


THIRD = [f"{RESULTS}/{d.name}/crosscheck" for d in DESIGNS if "supports" in d.tags]


rule crosscheck_opensees:
    message:
        "A third opinion by OpenSees, where openseespy is installed"
    input:
        models=[f"{folder}/model.json" for folder in THIRD],
        primaries=[f"{folder}/primary.json" for folder in THIRD],
        library=code_inputs("crosscheck_opensees"),
    output:
        table=f"{RESULTS}/crosscheck_opensees.csv",
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/crosscheck_opensees.py"
