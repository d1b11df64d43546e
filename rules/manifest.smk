# What every design is made of, by content: verified without Snakemake's own records.

# What decides the shape and the thicknesses of a design.
DECIDING = ["pattern", "fold", "mesh", "start", "analyse", "resize"]


rule manifest:
    message:
        "{wildcards.design}: manifest"
    input:
        files=lambda wildcards: design_files(wildcards.design),
        library=code_inputs("manifest"),
    output:
        manifest=f"{RESULTS}/{{design}}/manifest.json",
    params:
        deciding_rules=DECIDING,
        code=str(workflow.basedir),
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/manifest.py"


rule verify:
    message:
        "are the results still what was made?"
    params:
        results=RESULTS,
    script:
        "../scripts/verify.py"
