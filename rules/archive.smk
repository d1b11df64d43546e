# The study as one file that a stranger can verify and run again; no part of `all`.


rule archive_study:
    input:
        files=study_files(SETTINGS.study),
        summary=[f"{RESULTS}/summary.csv", f"{RESULTS}/summary.xlsx"],
        library=code_inputs("archive"),
    output:
        pointer=f"{RESULTS}/studies/{SETTINGS.study}/archive/archive.json",
    log:
        study_log("archive"),
    conda:
        "../envs/foldshell.yaml"
    params:
        tag=SETTINGS.study,
        designs=names_of_tag(SETTINGS.study),
        results=RESULTS,
        project=str(workflow.basedir),
        config=config,
        tables=[SETTINGS.designs],
        settings=stage_parameters(SETTINGS, "archive"),
    message:
        "archive of {params.tag}"
    script:
        "../scripts/archive.py"


rule archive:
    input:
        rules.archive_study.output,
