# The claims of the paper: judged by the study, the baselines and runs with other settings.

# A loop in one job leaves its first analysis as well, but does not say so to Snakemake.
SIZED = [file for file in SIZED if CHOICE == "steps" or "/00/" not in file]


rule sensitivity:
    input:
        mesh=rules.mesh.output.mesh,
        delivered=delivered_state,
        library=code_inputs("sensitivity"),
    output:
        json=f"{RESULTS}/sensitivity/{{variant}}/{{design}}.json",
    log:
        log_of("sensitivity", "-{variant}"),
    benchmark:
        timing("sensitivity", "-{variant}")
    wildcard_constraints:
        variant="|".join(VARIANTS),
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("analyse", SETTINGS.sizing.iterations_max),
    params:
        **of_design("span_m"),
        layout=lambda wildcards: layout_of(wildcards.design),
        settings=of_stage("size"),
    message:
        "{wildcards.design}: sized with {wildcards.variant}"
    script:
        "../scripts/sensitivity.py"


rule flat_equal:
    input:
        flat=lambda wildcards: f"{RESULTS}/{flat_of(BY_NAME[wildcards.design])}/folded/folded.npz",
        final=rules.size.output.final,
        library=code_inputs("flat_equal"),
    output:
        json=f"{RESULTS}/{{design}}/flat_equal.json",
    log:
        log_of("flat_equal"),
    benchmark:
        timing("flat_equal")
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("analyse"),
    params:
        **of_design("span_m"),
        flat=lambda wildcards: flat_of(BY_NAME[wildcards.design]),
        layout=lambda wildcards: layout_of(wildcards.design),
        subdivisions=subdivisions,
        settings=of_stage("size"),
    message:
        "{wildcards.design}: the flat sheet of the same volume"
    script:
        "../scripts/flat_equal.py"


rule claims:
    input:
        sized=[f"{RESULTS}/{d.name}/{file}" for d in JUDGED["sized"] for file in SIZED],
        folds=[f"{RESULTS}/{d.name}/{file}" for d in JUDGED["folds"] for file in SIZED[:2]],
        flats=[f"{RESULTS}/{d.name}/flat_equal.json" for d in JUDGED["flats"]],
        runs=[
            f"{RESULTS}/sensitivity/{variant}/{design.name}.json"
            for variant in VARIANTS
            for design in JUDGED["runs"]
        ],
        kinematics=rules.kinematics.output.table,
        library=code_inputs("claims"),
    output:
        json=f"{STUDY}/claims.json",
        page=f"{STUDY}/claims.md",
        runs=f"{STUDY}/sensitivity.csv",
    log:
        study_log("claims"),
    conda:
        "../envs/foldshell.yaml"
    params:
        results=results_folder,
        designs={name: [d.to_row() for d in designs] for name, designs in JUDGED.items()},
        variants=list(VARIANTS),
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "claims of the paper"
    script:
        "../scripts/claims.py"
