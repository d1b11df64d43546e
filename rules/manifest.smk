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
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        deciding_rules=DECIDING,
        code=str(HOME),
    message:
        "{wildcards.design}: manifest"
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
