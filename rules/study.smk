# What is said over all designs.


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
        results=summary_inputs(SETTINGS.study),
        library=code_inputs("summary"),
    output:
        csv=f"{RESULTS}/summary.csv",
        xlsx=f"{RESULTS}/summary.xlsx",
    log:
        study_log("summary"),
    conda:
        "../envs/foldshell.yaml"
    params:
        designs=summary_rows(SETTINGS.study),
        results=results_folder,
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "summary of the study"
    script:
        "../scripts/summary.py"


use rule summary as summary_of_tag with:
    input:
        results=lambda wildcards: summary_inputs(wildcards.tag),
        library=code_inputs("summary"),
    output:
        csv=f"{RESULTS}/tags/{{tag}}/summary.csv",
        xlsx=f"{RESULTS}/tags/{{tag}}/summary.xlsx",
    log:
        study_log("summary-{tag}"),
    params:
        designs=lambda wildcards: summary_rows(wildcards.tag),
        results=results_folder,
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "summary of {wildcards.tag}"


rule timings:
    input:
        rules.summary.output.csv,
        study_files(SETTINGS.study),
        library=code_inputs("timings"),
    output:
        csv=report(
            f"{RESULTS}/timings.csv",
            category="6 Settings and versions",
            caption="../docs/report/timings.rst",
            labels={"page": "time of each rule"},
        ),
    log:
        study_log("timings"),
    conda:
        "../envs/foldshell.yaml"
    params:
        folder=f"{RESULTS}/benchmarks",
    message:
        "time of each rule"
    script:
        "../scripts/timings.py"


include: "claims.smk"
