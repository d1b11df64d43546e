# What every design is made of, by content: verified without Snakemake's own records.

# What decides the shape and the thicknesses of a design.
DECIDING = ["pattern", "fold", "mesh", "start", "analyse", "resize"]


rule manifest:
    input:
        files=lambda wildcards: design_files(wildcards.design),
        library=code_inputs("manifest"),
    output:
        manifest=f"{RESULTS}/{{design}}/manifest.json",
    log:
        log_of("manifest"),
    benchmark:
        timing("manifest")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        title=lambda wildcards: wildcards.design,
        deciding_rules=DECIDING,
        code=str(HOME),
    message:
        "{wildcards.design}: manifest"
    script:
        "../scripts/manifest.py"


rule study_manifest:
    input:
        files=[f"{STUDY}/report.html", f"{STUDY}/summary.csv"],
        members=lambda wildcards: manifests(SETTINGS.study),
        library=code_inputs("manifest"),
    output:
        manifest=f"{STUDY}/manifest.json",
    log:
        study_log("study_manifest"),
    benchmark:
        study_timing("study_manifest")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        title=SETTINGS.study,
        deciding_rules=[],
        code=str(HOME),
    message:
        "manifest of the study"
    script:
        "../scripts/manifest.py"


rule verify:
    log:
        study_log("verify"),
    conda:
        "../envs/foldshell.yaml"
    params:
        results=results_folder,
    message:
        "are the results still what was made?"
    script:
        "../scripts/verify.py"
