# Snakemake's own report.

from foldshell.settings.check import parse_group


rule report_contents:
    input:
        report_files,


rule snakemake_report:
    input:
        report_files,
        library=code_inputs("snakemake_report"),
        stylesheet=ancient(local(f"{PAGES}/snakemake_report.css")),
        assets=assets(),
    output:
        report=f"{STUDY}/snakemake_report.html",
    log:
        study_log("snakemake_report"),
    conda:
        "../envs/foldshell.yaml"
    params:
        snakefile=MAIN_SNAKEFILE,
        target="report_contents",
        config=parse_group(type(SETTINGS), config),
    message:
        "Snakemake's own report"
    script:
        "../scripts/snakemake_report.py"
