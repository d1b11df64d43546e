"""Rules report_pages and claims_page: pages of the report from files."""

import claims_page
import report_pages
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from record_cases import make_summary


def test_three_pages_are_written(tmp_path):
    """Summary from CSV, verification from Markdown, settings with hash and versions."""
    write_rows(tmp_path / "summary.csv", SummaryRow, [make_summary(crosscheck="pass")])
    (tmp_path / "a.md").write_text("# Shell\n\n| problem | value |\n|---|---|\n| plate | 4 |\n")
    pages = {name: tmp_path / f"{name}.html" for name in ("summary", "verification", "settings")}
    report_pages.main(tmp_path / "summary.csv", [tmp_path / "a.md"], pages,
                      stage_parameters(make_settings({}), "study"))  # fmt: skip
    text = {name: path.read_text(encoding="utf-8") for name, path in pages.items()}
    assert "1 converged: 1 in all" in text["summary"]
    assert "<td>plate</td>\n<td>4</td>" in text["verification"]
    for part in ("<td>step</td>", "snakemake", "numpy"):
        assert part in text["settings"]


def test_claims_become_a_page(tmp_path):
    """The verdict in claims.md stands in the page."""
    (tmp_path / "claims.md").write_text("# Claims\n\n## C1: holds\n\nIt is `auxetic`.\n")
    claims_page.main(tmp_path / "claims.md", tmp_path / "claims.html")
    assert "<h2>C1: holds</h2>" in (tmp_path / "claims.html").read_text(encoding="utf-8")
