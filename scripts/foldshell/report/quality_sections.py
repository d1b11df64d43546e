"""Sections of a page on how good its numbers are: cross-check and mesh error."""

from foldshell.records.comparison import ComparedQuantity, ComparisonRecord
from foldshell.records.entry import SIGNS, entries, name_key
from foldshell.records.mesh_convergence import CombinationStudy, MeshConvergenceRecord
from foldshell.report.markup import make_table
from foldshell.report.reading import say_compared
from foldshell.report.section import Box, Folded, Section, judge_met

COMPARED = ("quantity", "primary", "independent", "difference [%]", "tolerance [%]", "within")
STEEL = {
    "steel_kg_m2": "reinforcement, no least steel",
    "steel_max_kn_m": "reinforcement, largest of one layer and direction",
    "moment_max_knm_m": "moment, largest mean",
    "shear_max_kn_m": "shear, largest mean (open at ends of folds)",
}
NOISE = 1e-6
"""Share of the largest force up to which one is rounding and shown as 0."""


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
    rows = [_compare(name, item) for name, item in comparison.quantities.items()
            if not _is_reaction(name)]  # fmt: skip
    rows += _compare_steel(comparison)
    said = [say_compared(comparison), say_shear(comparison), say_steel(comparison)]
    return Section(
        "Cross-check by the independent code",
        Box("good" if passed else "bad", f"{words}: {note}" if note else words),
        words=" ".join(filter(None, said)),
        table=make_table(COMPARED, rows) if rows else None,
        folded=_fold_reactions(comparison),
    )


def _compare_steel(comparison: ComparisonRecord) -> list[tuple]:
    """Return the rows of reinforcement, moments and shear; the last two decide nothing."""
    steel = comparison.reinforcement
    return [] if steel is None else [
        (
            f"{STEEL[name]} [{SIGNS.get(item.unit, item.unit)}]", item.primary, item.independent,
            _percent(item.relative_difference), _percent(item.tolerance), judge_met(item.passed),
        )
        for name, item in steel.quantities.items()
    ]  # fmt: skip


def say_steel(comparison: ComparisonRecord) -> str:
    """Return under which loads both codes designed steel, and why they differ where they do."""
    steel = comparison.reinforcement
    if steel is None:
        return ""
    words = (
        f"Steel: each code by its own forces, of first order, for {', '.join(steel.combinations)} "
        "together; largest means of facets and strips, finest meshes; it does not decide whether "
        "the cross-check passes."
    )
    return f"{words} {steel.reason[0].upper()}{steel.reason[1:]}." if steel.reason else words


def _is_reaction(name: str) -> bool:
    return name.split()[-1].startswith("reaction")


def _compare(name: str, item: ComparedQuantity, noise: float = 0.0) -> tuple:
    """Return a row of both codes; values (in `unit`) up to `noise` are shown as 0."""
    values = (0.0 if abs(one) <= noise else one for one in (item.primary, item.independent))
    return (
        name_quantity(name, "mm" if item.unit == "m" else item.unit),
        *(_show(one, item.unit) for one in values),
        _percent(item.relative_difference),
        _percent(item.tolerance),
        judge_met(item.passed),
    )


def _fold_reactions(comparison: ComparisonRecord) -> Folded | None:
    """Return the rows of reactions, which are many; open where one is not within tolerance."""
    found = {name: one for name, one in comparison.quantities.items() if _is_reaction(name)}
    forces = [abs(one) for item in found.values() if item.unit == "kN"
              for one in (item.primary, item.independent)]  # fmt: skip
    noise = NOISE * max(forces, default=0.0)
    rows = [_compare(name, item, noise if item.unit == "kN" else 0.0)
            for name, item in found.items()]  # fmt: skip
    thrusts = comparison.reactions or {}
    rows += [
        (
            f"{name}, thrust [kN]",
            item.primary_thrust_kn,
            item.independent_thrust_kn,
            _percent(item.relative_difference),
            _percent(item.tolerance),
            judge_met(item.passed),
        )
        for name, item in thrusts.items()
    ]
    if not rows:
        return None
    missed = any(item.passed is False for item in (*found.values(), *thrusts.values()))
    return Folded(f"Reactions of both codes: {len(rows)} rows", make_table(COMPARED, rows), missed)


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
