# What is said over all designs.


# On a cluster: where Snakemake runs.
localrules:
    schemas,


rule schemas:
    input:
        library=code_inputs("schemas"),
    output:
        SCHEMAS,
    log:
        study_log("schemas"),
    conda:
        "../envs/foldshell.yaml"
    message:
        "schemas of the result files"
    script:
        "../scripts/schemas.py"


rule summary:
    input:
        results=lambda wildcards: summary_inputs(wildcards.tag),
        library=code_inputs("summary"),
    output:
        csv=f"{RESULTS}/{STUDIES}/{{tag}}/summary.csv",
        xlsx=f"{RESULTS}/{STUDIES}/{{tag}}/summary.xlsx",
    log:
        study_log("summary", "{tag}"),
    benchmark:
        study_timing("summary", "{tag}")
    conda:
        "../envs/foldshell.yaml"
    params:
        designs=lambda wildcards: summary_rows(wildcards.tag),
        results=results_folder,
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "summary of {wildcards.tag}"
    script:
        "../scripts/summary.py"


rule timings:
    input:
        lambda wildcards: timed_files(),
        library=code_inputs("timings"),
    output:
        csv=report(
            f"{STUDY}/timings.csv",
            category="6 Settings and versions",
            caption="../docs/report/timings.rst",
            labels={"page": "time of each rule"},
        ),
    log:
        study_log("timings"),
    conda:
        "../envs/foldshell.yaml"
    params:
        folder=lambda wildcards: f"{place()}/benchmarks",
    message:
        "time of each rule"
    script:
        "../scripts/timings.py"


include: "claims.smk"
include: "claims_reinforced.smk"
