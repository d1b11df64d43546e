"""The report of a tiny study, as Snakemake makes it from the workflow's own rules."""

import json
import re

import pytest
from study_runner import make_study, run

BROWSERS_LIMIT = 2_000_000
"""Characters of a data URI that Chromium still shows in a frame."""


@pytest.mark.slow
def test_report_holds_every_page_below_the_limit(code, tmp_path):
    """Pages of both designs, summary, verification, settings and figures; no claims, no host."""
    folder = make_study(tmp_path / "study")
    study = "results/studies/tiny"
    done = run(code, folder, f"{study}/snakemake_report.html", f"{study}/report.html")
    assert done.returncode == 0, done.stderr[-3000:]
    text = (folder / "results/studies/tiny/snakemake_report.html").read_text(encoding="utf-8")
    data = re.search(r"var results = (\{.*?\});\n", text, re.S)[1]
    results = json.loads(data)
    pages = [f"{study}/report/{name}" for name in ("summary", "verification", "settings")]
    for name in ("results/tiny-dome/page", "results/tiny-saddle/page", *pages):
        assert len(results[f"{name}.html"]["data_uri"]) < BROWSERS_LIMIT
    assert "results/studies/tiny/figures/all_thickness.png" in results
    assert (code / "scripts/foldshell/report/snakemake_report.css").read_text().strip() in text
    assert "results/studies/tiny/report/claims.html" not in results
    graph = re.search(r"var rulegraph_spec = (\{.*?\});\n", text, re.S)[1]
    assert '"analyse"' in graph and '"resize"' in graph  # though only last analyses are looked at
    assert not re.search(r'<(?:script|link|img)[^>]+(?:src|href)="http', text)
    own = (folder / "results/studies/tiny/report.html").read_text(encoding="utf-8")
    for name in ("tiny-dome", "tiny-saddle"):
        assert f'href="../../{name}/page.html"' in own
        assert f'href="{name}/page.html"' in (folder / "results/report.html").read_text()
    assert "Not drawn: supports, no two designs tagged supports to compare." in own
    assert "snakemake --cores 2 claims" in own
    assert "default-src 'none'" in own
