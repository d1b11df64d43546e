"""Designs under settings of their own stand beside those of the study, and no others."""

import pytest

from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.report.own_settings import HEADER, compare_settings
from record_cases import make_summary

STEEL = {
    "steel_kg_m2": 12.0, "co2_kg_m2": 30.0, "co2_low_kg_m2": 22.0, "co2_high_kg_m2": 41.0,
    "steel_governing": "fit in 62 % of the panels", "steel_over_share": 0.05,
}  # fmt: skip


@pytest.fixture
def beside(tmp_path):
    """The summary of another study: the design `dome` with bars, and one of another height."""
    own = {"settings": "config/reinforced.yaml", "volume_m3": 120.0, **STEEL}
    rows = [
        make_summary(design="bars-dome", tags="reinforced", **own),
        make_summary(design="bars-high", tags="reinforced", **own | {"height_m": 28.0}),
    ]
    write_rows(tmp_path / "summary.csv", SummaryRow, rows)
    return {"reinforced": tmp_path / "summary.csv"}


def show(table):
    return [dict(zip(HEADER, (cell.value for cell in row), strict=True)) for row in table.rows]


def test_the_same_design_under_both_settings_with_the_ratio_of_volumes(beside):
    rows = [make_summary(design="dome", volume_m3=80.0)]
    first, second = show(compare_settings(rows, beside))
    assert (first["design"], second["design"]) == ("dome", "bars-dome")
    assert (first["settings"], second["settings"]) == ("the study's", "reinforced.yaml")
    assert (first["over the study's"], second["over the study's"]) == (1.0, 1.5)
    assert second["CO2e [kg/m²]"] == "30 (22 to 41)" and first["CO2e [kg/m²]"] is None
    assert second["panels over [%]"] == 5.0
    assert second["governs"] == "fit in 62 % of the panels"


def test_nothing_stands_beside_designs_that_have_one_setting_alone(beside, tmp_path):
    assert not compare_settings([make_summary(design="dome", height_m=3.0)], beside).rows
    assert not compare_settings([make_summary(design="dome")], {}).rows
    broken = tmp_path / "broken.csv"
    broken.write_text("design,volume_m3\na,many\n", encoding="utf-8")
    assert not compare_settings([make_summary(design="dome")], {"x": broken}).rows
