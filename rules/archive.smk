# The study as one file that a stranger can verify and run again; no part of `all`.


rule archive_study:
    input:
        files=lambda wildcards: study_files(SETTINGS.study),
        study=[f"{STUDY}/summary.csv", f"{STUDY}/report.html", f"{STUDY}/manifest.json"],
        library=code_inputs("archive"),
    output:
        pointer=f"{STUDY}/archive/archive.json",
    log:
        study_log("archive"),
    conda:
        "../envs/foldshell.yaml"
    params:
        tag=SETTINGS.study,
        designs=lambda wildcards: names_of_tag(SETTINGS.study),
        results=results_folder,
        project=str(HOME),
        config=parse_group(type(SETTINGS), config),
        tables=[SETTINGS.designs, *filter(os.path.isfile, [SETTINGS.load_table, SETTINGS.supports])],
        own=sorted(SETTINGS.own),
        settings=stage_parameters(SETTINGS, "archive"),
    message:
        "archive of {params.tag}"
    script:
        "../scripts/archive.py"


rule archive:
    input:
        rules.archive_study.output,
