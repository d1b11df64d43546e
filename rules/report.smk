# The report: Snakemake's own, of pages and figures that are flagged with `report(...)`.


report: "../docs/report/workflow.rst"


def has_claims():
    """Tell whether the claims are judged or asked for: they need many more runs than the study."""
    asked = {"report", "claims"} & set(map(str, workflow.dag_settings.targets))
    return bool(asked) or Path(f"{RESULTS}/claims.json").exists()


def report_files(wildcards):
    """Return what the report shows."""
    pages = [f"{RESULTS}/report/{name}.html" for name in ("summary", "verification", "settings")]
    pages += [f"{RESULTS}/timings.csv"] + [f"{RESULTS}/report/claims.html"] * has_claims()
    figures = [f"{RESULTS}/figures/{name}.png" for name in CHARTS + PANEL_CHARTS + SHEETS]
    designs = [f"{RESULTS}/{name}/page.html" for name in names_of_tag(SETTINGS.study)]
    return pages + figures + designs


rule report_pages:
    message:
        "pages of the report"
    input:
        summary=rules.summary.output.csv,
        verification=[f"{SCRIPTS}/../tests/verification/README.md"],
        library=code_inputs("report_pages"),
        assets=assets(),
    output:
        summary=report(
            f"{RESULTS}/report/summary.html",
            category="1 Summary",
            caption="../docs/report/summary.rst",
            labels={"page": "all designs"},
        ),
        verification=report(
            f"{RESULTS}/report/verification.html",
            category="5 Verification",
            caption="../docs/report/verification.rst",
            labels={"page": "verification of the shell element"},
        ),
        settings=report(
            f"{RESULTS}/report/settings.html",
            category="6 Settings and versions",
            caption="../docs/report/settings.rst",
            labels={"page": "settings and versions"},
        ),
    params:
        settings=stage_parameters(SETTINGS, "study"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/report_pages.py"


rule claims_page:
    message:
        "claims as a page"
    input:
        claims=f"{RESULTS}/claims.md",
        library=code_inputs("claims_page"),
        assets=assets(),
    output:
        page=report(
            f"{RESULTS}/report/claims.html",
            category="2 Claims",
            caption="../docs/report/claims.rst",
            labels={"page": "claims of the paper"},
        ),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/claims_page.py"


rule report_contents:
    input:
        report_files,


rule report:
    message:
        "report"
    input:
        report_files,
        library=code_inputs("report"),
        stylesheet=f"{SCRIPTS}/foldshell/report/report.css",
    output:
        report=f"{RESULTS}/report.html",
    params:
        snakefile=workflow.main_snakefile,
        target="report_contents",
        config=dict(workflow.config_settings.overwrite_config or {}),
    script:
        "../scripts/report.py"
