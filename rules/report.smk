# The report of the study: ours, and Snakemake's own of what is flagged with `report(...)`.


report: "../docs/report/workflow.rst"


VERIFICATION = f"{SCRIPTS}/../tests/verification/README.md"


rule report_pages:
    input:
        summary=f"{STUDY}/summary.csv",
        verification=[ancient(local(VERIFICATION))],
        content=listed(write_content_list([VERIFICATION], LIBRARY)),
        library=code_inputs("report_pages"),
        assets=assets(),
    output:
        summary=report(
            f"{STUDY}/report/summary.html",
            category="1 Summary",
            caption="../docs/report/summary.rst",
            labels={"page": "all designs"},
        ),
        verification=report(
            f"{STUDY}/report/verification.html",
            category="5 Verification",
            caption="../docs/report/verification.rst",
            labels={"page": "verification of the shell element"},
        ),
        settings=report(
            f"{STUDY}/report/settings.html",
            category="6 Settings and versions",
            caption="../docs/report/settings.rst",
            labels={"page": "settings and versions"},
        ),
    log:
        study_log("report_pages"),
    benchmark:
        study_timing("report_pages")
    conda:
        "../envs/foldshell.yaml"
    params:
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "pages of the report"
    script:
        "../scripts/report_pages.py"


rule claims_page:
    input:
        claims=f"{STUDY}/claims.md",
        library=code_inputs("claims_page"),
        assets=assets(),
    output:
        page=report(
            f"{STUDY}/report/claims.html",
            category="2 Claims",
            caption="../docs/report/claims.rst",
            labels={"page": "claims of the paper"},
        ),
    log:
        study_log("claims_page"),
    conda:
        "../envs/foldshell.yaml"
    message:
        "claims as a page"
    script:
        "../scripts/claims_page.py"


rule report:
    input:
        summary=f"{STUDY}/summary.csv",
        tiles=rules.all_designs.output.tiles,
        verification=ancient(local(VERIFICATION)),
        content=listed(write_content_list([VERIFICATION], LIBRARY)),
        claims=judged_claims,
        reinforced=judged_reinforced,
        fold=answer_of_explorations,
        figures=charts_of_study,
        designs=report_designs,
        library=code_inputs("report"),
        assets=assets(),
    output:
        report=f"{STUDY}/report.html",
    log:
        study_log("report"),
    benchmark:
        study_timing("report")
    conda:
        "../envs/foldshell.yaml"
    params:
        study=SETTINGS.study,
        results=results_folder,
        project=str(HOME),
        settings=stage_parameters(SETTINGS, "study"),
        left_out=LEFT_OUT,
        beside=summaries_beside,
    message:
        "report of the study"
    script:
        "../scripts/report.py"


include: "snakemake_report.smk"
