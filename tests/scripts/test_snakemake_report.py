"""Rule snakemake_report: by a second Snakemake, or one sentence on why there is none."""

import subprocess
import sys

import pytest

import snakemake_report
from foldshell.files.errors import InputError

pytestmark = pytest.mark.workflow
SNAKEFILE = """
rule all:
    input: "page.html"
rule page:
    output: report("page.html", category="pages")
    params: word=config.get("word", "none")
    shell: "echo '<p>{params.word}</p>' > {output}"
"""


STYLE = "#rulegraph { overflow: auto; }"


@pytest.fixture
def workflow(tmp_path, monkeypatch):
    """Return a Snakefile of one rule, in the current folder."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "Snakefile"
    path.write_text(SNAKEFILE)
    (tmp_path / "report.css").write_text(STYLE)
    return str(path)


def test_report_shows_what_is_flagged(workflow, tmp_path):
    """The page made with a setting of the command line is in the report, which asks no host."""
    command = [sys.executable, "-m", "snakemake", "--cores", "1", "--config", "word=hello"]
    subprocess.run(command, check=True, capture_output=True)
    snakemake_report.main(
        tmp_path / "report.html", tmp_path / "report.css", workflow, "all", {"word": "hello"}
    )
    text = (tmp_path / "report.html").read_text()
    assert '"page.html": {"name": "page.html"' in text
    assert STYLE in text
    assert 'src="http' not in text
    assert sorted(path.name for path in tmp_path.glob("*.html")) == ["page.html", "report.html"]


def test_missing_results_are_one_sentence(workflow, tmp_path):
    """Nothing has been run: no report is left behind."""
    with pytest.raises(InputError, match=r"report\.html: snakemake --report: .+"):
        snakemake_report.main(
            tmp_path / "report.html", tmp_path / "report.css", workflow, "all", {}
        )
    assert not list(tmp_path.glob("*.html"))
