# The final state once more, by an independent FE code, each code on two meshes.

FAMILIES = {(d.pattern, d.surface): d.name for d in reversed(DESIGNS)}
"""The first design of each pattern and surface: those that a third mesh is made of."""


rule neutral_model:
    input:
        mesh=rules.mesh.output.mesh,
        final=rules.size.output.arrays,
        report=rules.size.output.final,
        library=code_inputs("neutral_model"),
    output:
        model=f"{RESULTS}/{{design}}/crosscheck/model.json",
    log:
        log_of("neutral_model"),
    benchmark:
        timing("neutral_model")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("mesh"),
    params:
        settings=of_stage("crosscheck"),
    message:
        "{wildcards.design}: neutral model"
    script:
        "../scripts/neutral_model.py"


rule mesh_convergence:
    input:
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        report=rules.size.output.final,
        library=code_inputs("mesh_convergence"),
    output:
        study=f"{RESULTS}/{{design}}/mesh_convergence.json",
        primary=f"{RESULTS}/{{design}}/crosscheck/primary.json",
    log:
        log_of("mesh_convergence"),
    benchmark:
        timing("mesh_convergence")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("mesh_convergence"),
    params:
        support=holding,
        edge_beam=edge_beam,
        subdivisions=subdivisions,
        third=lambda wildcards: wildcards.design in FAMILIES.values(),
        settings=lambda wildcards: of_stage("crosscheck")(wildcards)
        | of_stage("reinforced")(wildcards),
    message:
        "{wildcards.design}: mesh error"
    script:
        "../scripts/mesh_convergence.py"


rule compare:
    input:
        model=rules.neutral_model.output.model,
        primary=rules.mesh_convergence.output.primary,
        library=code_inputs("compare"),
    output:
        comparison=f"{RESULTS}/{{design}}/crosscheck/comparison.json",
        workbook=f"{RESULTS}/{{design}}/crosscheck/comparison.xlsx",
    log:
        log_of("compare"),
    benchmark:
        timing("compare")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("compare"),
    params:
        subdivisions=SETTINGS.crosscheck.subdivisions,
        solver=SETTINGS.crosscheck.solver,
        tolerance=stage_parameters(SETTINGS, "crosscheck")["crosscheck"]["tolerance"],
    message:
        "{wildcards.design}: cross-check by the independent code"
    script:
        "../scripts/compare.py"


THIRD = [f"{RESULTS}/{d.name}/crosscheck" for d in DESIGNS if "supports" in d.tags]


rule crosscheck_opensees:
    input:
        models=[f"{folder}/model.json" for folder in THIRD],
        primaries=[f"{folder}/primary.json" for folder in THIRD],
        library=code_inputs("crosscheck_opensees"),
    output:
        table=f"{STUDY}/crosscheck_opensees.csv",
    log:
        study_log("crosscheck_opensees"),
    conda:
        "../envs/foldshell.yaml"
    message:
        "A third opinion by OpenSees, where openseespy is installed"
    script:
        "../scripts/crosscheck_opensees.py"
