"""Pages over all designs."""

from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.report.study_pages import write_settings_page, write_summary_page
from foldshell.settings.loads import Combinations
from foldshell.settings.stage import StageSettings
from record_cases import make_summary


def test_every_design_is_a_row_with_its_units(tmp_path):
    """Metres become mm, shares per cent; a design without results has dashes and its reason."""
    path = tmp_path / "summary.csv"
    good = {
        "volume_m3": 95.28, "volume_per_area_m": 0.0646, "utilization_mean": 0.64,
        "displacement_vertical_max_m": 0.0979, "mesh_error": 0.045, "crosscheck": "pass",
        "iterations": 15, "edited_panels": 7, "utilization_panel_mean_max": 0.9234,
    }  # fmt: skip
    rows = [
        make_summary(design="a", **good),
        make_summary(design="b", state="unstable", iterations=1, reason="<b>mechanism</b>"),
    ]
    write_rows(path, SummaryRow, rows)
    page = write_summary_page(path)
    assert '<a href="../a/page.html">a</a>' in page
    words = "1 converged, 1 unstable: 2 in all"
    for text in ("64.6", "97.9", "4.5", "volume / area [mm]", words, "0.9234",
                 "utilization, largest panel mean [-]", "panels changed by a person"):  # fmt: skip
        assert text in page
    assert "&lt;b&gt;mechanism" in page
    assert page.count("<tr>") == 3
    for cell in ('"good">converged', '"good">pass', '"bad">unstable', '"">–'):
        assert f"<td class={cell}</td>" in page


def test_settings_are_listed_with_hash_and_versions():
    """Nested settings get dotted names."""
    page = write_settings_page(StageSettings(Combinations()), "abc123",
                               {"numpy": "2.0"})  # fmt: skip
    for text in ("strength.S1.SW", "1.4", "abc123", "numpy", "2.0"):
        assert text in page
