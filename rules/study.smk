# What is said over all designs.


def summary_inputs(tag):
    """Return the result files that the summary of a tag's designs reads."""
    files = ["folded/quality.json", "sizing/final.json", "mesh_convergence.json"]
    files.append("crosscheck/comparison.json")
    return [f"{RESULTS}/{name}/{file}" for name in names_of_tag(tag) for file in files]


def summary_rows(tag):
    """Return the rows of designs.tsv that a summary lists, with their subdivisions."""
    return [
        BY_NAME[name].to_row()
        | {"mesh_subdivisions": choose_subdivisions(SETTINGS, BY_NAME[name])}
        for name in names_of_tag(tag)
    ]


rule schemas:
    message:
        "schemas of the result files"
    input:
        library=code_inputs("schemas"),
    output:
        SCHEMAS,
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/schemas.py"


rule summary:
    message:
        "summary of the study"
    input:
        results=summary_inputs(SETTINGS.study),
        library=code_inputs("summary"),
    output:
        csv=f"{RESULTS}/summary.csv",
        xlsx=f"{RESULTS}/summary.xlsx",
    params:
        designs=summary_rows(SETTINGS.study),
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "study"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/summary.py"


use rule summary as summary_of_tag with:
    message:
        "summary of {wildcards.tag}"
    input:
        results=lambda wildcards: summary_inputs(wildcards.tag),
        library=code_inputs("summary"),
    output:
        csv=f"{RESULTS}/tags/{{tag}}/summary.csv",
        xlsx=f"{RESULTS}/tags/{{tag}}/summary.xlsx",
    params:
        designs=lambda wildcards: summary_rows(wildcards.tag),
        results=RESULTS,
        settings=stage_parameters(SETTINGS, "study"),


rule timings:
    message:
        "time of each rule"
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
    params:
        folder=f"{RESULTS}/benchmarks",
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/timings.py"


include: "claims.smk"
