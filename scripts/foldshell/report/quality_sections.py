"""Sections of a page on how good its numbers are: cross-check and mesh error."""

from foldshell.records.comparison import ComparisonRecord
from foldshell.records.entry import SIGNS, entries, name_key
from foldshell.records.mesh_convergence import CombinationStudy, MeshConvergenceRecord
from foldshell.report.markup import make_table
from foldshell.report.section import Box, Section, judge_met


def name_quantity(key: str, unit: str = "-") -> str:
    """Return the words of a compared quantity, `S2 work_knm`, with its unit in brackets."""
    *combination, name = key.split(" ")
    about = entries(CombinationStudy).get(name)
    words = about.words if about else name_key(name, "m" if unit == "mm" else unit)
    shown = "" if unit == "-" else f" [{SIGNS.get(unit, unit)}]"
    return " ".join([*combination, words]) + shown


def make_mesh_error(record: MeshConvergenceRecord) -> Section:
    """Return how far each headline number is from that of a finer mesh."""
    errors = record.errors
    if not errors:
        reason = record.study.reason or "no results"
        return Section("Mesh error", words=f"Not measured: {reason}")
    names = list(dict.fromkeys(name for one in errors.values() for name in one))
    header = ["difference to the fine mesh", *(f"{name} [%]" for name in errors)]
    rows = [
        (name_quantity(name), *(_percent(one.get(name)) for one in errors.values()))
        for name in names
    ]
    return Section("Mesh error", table=make_table(header, rows))


def make_crosscheck(comparison: ComparisonRecord) -> Section:
    """Return both codes side by side with their tolerance."""
    passed = comparison.passed
    words = "every quantity is within its tolerance" if passed else "not within tolerance"
    note = comparison.reason
    rows = [
        (
            name_quantity(name, "mm" if item.unit == "m" else item.unit),
            _show(item.primary, item.unit),
            _show(item.independent, item.unit),
            _percent(item.relative_difference),
            _percent(item.tolerance),
            judge_met(item.passed),
        )
        for name, item in comparison.quantities.items()
    ]
    rows += [
        (
            f"{name}, thrust [kN]",
            item.primary_thrust_kn,
            item.independent_thrust_kn,
            _percent(item.relative_difference),
            _percent(item.tolerance),
            judge_met(item.passed),
        )
        for name, item in (comparison.reactions or {}).items()
    ]
    header = ("quantity", "primary", "independent", "difference [%]", "tolerance [%]", "within")
    return Section(
        "Cross-check by the independent code",
        Box("good" if passed else "bad", f"{words}: {note}" if note else words),
        words=say_shear(comparison),
        table=make_table(header, rows) if rows else None,
    )


def say_shear(comparison: ComparisonRecord) -> str:
    """Return what shear deformation, which both codes leave out, adds to each limited value."""
    sentences = []
    for name, item in (comparison.shear or {}).items():
        unit = "mm" if name.endswith("_m") else "-"
        value, limit, sheared = (
            f"{_show(number, 'm' if unit == 'mm' else unit):.4g}"
            for number in (item.value, item.limit, item.with_shear)
        )
        end = "within" if item.with_shear <= item.limit else "not within"
        turns = " (the verdict turns)" if item.turns else ""
        if item.turns_refined and not item.turns:
            turns = " (the verdict turns with mesh error added)"
        sentences.append(
            f"Shear deformation adds {100 * item.share:.2g} % to "
            f"{name_quantity(f'{item.combination} {name}', unit)}: {value} becomes {sheared}, "
            f"{end} {limit}{turns}."
        )
    return " ".join(sentences)


def _show(value: float, unit: str) -> float:
    """Return a value in the unit that people read: displacements in mm."""
    return 1e3 * value if unit == "m" else value


def _percent(value: float | None) -> float | None:
    return None if value is None else 100 * value
