"""Rows of judged rivals from a study's summary and its engineering verdicts."""

from pathlib import Path

from foldshell.records.engineering import EngineeringRecord
from foldshell.records.files import read_record
from foldshell.records.rivals import JudgedRow, name_kind
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows

COPIED = (
    "design", "state", "reason", "iterations", "mesh_subdivisions", "volume_m3",
    "volume_per_area_m", "buckling_factor_min", "displacement_vertical_max_m", "mesh_error",
    "crosscheck", "engineering",
)  # fmt: skip
STEEL = ("steel_kg_m2", "steel_kg", "co2_kg", "co2_low_kg", "co2_high_kg")


def read_judged(summary: str | Path, results: str | Path) -> list[JudgedRow]:
    """Return a row for each design of summary.csv, with what engineering.json in its folder says.

    Names of designs end in that of a candidate: those of round 00 are rivals.
    """
    return [_make_row(row, Path(results, row.design)) for row in read_rows(summary, SummaryRow)]


def _make_row(row: SummaryRow, folder: Path) -> JudgedRow:
    plain = {key: getattr(row, key) for key in COPIED}
    path = folder / "checks/engineering.json"
    more = _judge(read_record(path, EngineeringRecord)) if path.is_file() else {}
    return JudgedRow(
        kind=name_kind("-".join(row.design.split("-")[-2:]), row.pattern), **plain, **more
    )


def _judge(record: EngineeringRecord) -> dict[str, float | str | None]:
    checks = record.checks
    failed = ", ".join(name for name, check in checks.items() if check.met is False)
    found: dict[str, float | str | None] = {"failed": failed}
    for name, key, due in (
        ("stability", "stability", "stability_due"),
        ("displacement_long_term_cracked", "displacement_long_term_m", "displacement_due_m"),
        ("reinforced_strut", "strut", None),
    ):
        if check := checks.get(name):
            found[key] = check.value
            if due:
                found[due] = check.limit
    if steel := record.reinforcement:
        found |= {key: getattr(steel, key) for key in STEEL}
        found["shear_share"] = steel.over_one_share.get("shear")
    return found
