"""The loads and the combinations of a design: of the set that its row names."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import product
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.combination_rules import Action, Combination, generate_combinations
from foldshell.settings.consistency import check_crosscheck, check_loading
from foldshell.settings.design import SURFACES, Design
from foldshell.settings.field import Factors
from foldshell.settings.load_rows import NAMED_ACTIONS, LoadRow, place_rows
from foldshell.settings.load_table import PAPER, LoadSets, read_load_sets
from foldshell.settings.loads import LOAD_CASES, Combinations, Loads
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.study import LOAD_TABLE, Settings
from foldshell.settings.zones import read_zone

PAPER_ACTIONS = tuple(Action(case, kind, kind == "wind") for case, kind in NAMED_ACTIONS.items())


def find_load_sets(path: object, source: str = "configuration") -> LoadSets:
    """Return the sets of a table of loads; none where the table of the default name is missing.

    Raises `InputError` that names `source` and the setting where there is no such file.
    """
    if not isinstance(path, str):
        return {}
    if not Path(path).is_file():
        if path == LOAD_TABLE:
            return {}
        raise InputError(f"{source}: load_table: {path!r}: no such file")
    return read_load_sets(path)


def list_cases(sets: LoadSets) -> tuple[str, ...]:
    """Return the names of all cases of all sets, each once."""
    return tuple(dict.fromkeys(row.case for rows in sets.values() for row in rows))


def place_set(sets: LoadSets, design: Design) -> tuple[LoadRow, ...]:
    """Return the loads of a design with a set of its own; raises `ValueError` in some words."""
    rows = sets[design.loads]
    _check_reach(rows, design)
    if design.on_grid:
        return place_rows(rows, design.zigzag, design.strip)
    for row in rows:
        if read_zone(row.zone).kind in ("zigzag", "strip"):
            raise ValueError(
                f"case {row.case}: zone: {row.zone!r}: a sheet that is no grid has no polylines"
            )
    return rows


def _check_reach(rows: Iterable[LoadRow], design: Design) -> None:
    """Refuse zones that lie beyond any sheet on a target whose plan is known; others are told when
    the sheet is there."""
    if design.surface not in SURFACES or not design.on_grid:
        return
    for row in rows:
        zone = read_zone(row.zone)
        points = zone.region.corners if zone.region else zone.points
        for axis, side in enumerate(design.sides):
            places = [point[axis] for point in points]
            if places and (min(places) > side or max(places) < -side):
                x, y = design.sides
                raise ValueError(
                    f"case {row.case}: zone: {row.zone!r}: it meets no panel of a plan of {x:g} m "
                    f"by {y:g} m, whose middle is the origin"
                )


def list_actions(rows: Iterable[LoadRow]) -> tuple[Action, ...]:
    """Return each case of a set once, as combination rules see it.

    Wind acts both ways where its sign says so, or all of it acts along an axis or a vector:
    pressures on facets turned round are no wind from the other side.
    """
    found: dict[str, list[LoadRow]] = {}
    for row in rows:
        found.setdefault(row.case, []).append(row)
    return tuple(
        Action(case, own[0].action, any(row.sign == "both" for row in own) or _is_axial_wind(own))
        for case, own in found.items()
    )


def _is_axial_wind(rows: Iterable[LoadRow]) -> bool:
    return all(row.action == "wind" and "normal" not in row.direction for row in rows)


def combinations_of(settings: Settings, design: Design) -> Combinations:
    """Return the combinations that a design is sized by: those listed, or those of the rule.

    Raises `ValueError` for a rule that makes too many.
    """
    given = settings.combinations
    own = design.loads != PAPER
    rows = settings.load_sets[design.loads] if own else ()
    if given.rule == "listed":
        both = list(dict.fromkeys(row.case for row in rows if row.sign == "both"))
        if not both:
            return given
        return replace(
            given,
            strength=_turn_round(given.strength, both),
            deflection=_turn_round(given.deflection, both),
        )
    actions = list_actions(rows) if own else PAPER_ACTIONS
    made = generate_combinations(given.rule, actions, settings.codes)
    return replace(
        given,
        strength=_rename("S", made.strength),
        deflection=_rename("D", made.characteristic),
    )


def _rename(letter: str, found: Mapping[str, Combination]) -> Factors:
    return {f"{letter}{number}": one for number, one in enumerate(found.values(), start=1)}


def _turn_round(given: Factors, both: list[str]) -> Factors:
    """Return the combinations and those with cases that act both ways turned round: S4, S4n."""
    found: dict[str, Mapping[str, float]] = {}
    for name, factors in given.items():
        turned = [case for case in both if factors.get(case)]
        for number, signs in enumerate(product((1, -1), repeat=len(turned))):
            sign = dict(zip(turned, signs, strict=True))
            suffix = "" if number == 0 else "n" if len(turned) == 1 else f"n{number}"
            own = name + suffix
            if number and own.casefold() in {other.casefold() for other in given}:
                raise ValueError(
                    f"{name} turned round would be {own}, which stands there: another name for one "
                    "of them is allowed"
                )
            found[own] = {k: v * sign.get(k, 1) for k, v in factors.items()}
    return found


def check_loads(designs: Iterable[Design], settings: Settings, table: str, source: str) -> None:
    """Check the loads and combinations of each design, and the names that the cross-check takes.

    Raises `InputError` for a set that is unknown, panels or polylines that the sheet has not, and
    combinations that name a case which the set has not, or load nothing.
    """
    known: set[str] = set()
    for design in designs:
        if design.loads != PAPER:
            _check_set_of(design, settings, f"{table}: design {design.name!r}")
        if design.loads not in known:
            known.add(design.loads)
            _check_combinations_of(design, settings, source)


def _check_combinations_of(design: Design, settings: Settings, source: str) -> None:
    try:
        found = combinations_of(settings, design)
    except ValueError as error:
        raise InputError(f"{source}: combinations: set {design.loads!r}: {error}") from None
    _check_cases(design, found, settings, source)
    if found is not settings.combinations:
        check_crosscheck(settings.crosscheck, found, f"{source}: design {design.name!r}")


def _check_set_of(design: Design, settings: Settings, where: str) -> None:
    known = [PAPER, *settings.load_sets]
    if design.loads not in known:
        raise InputError(
            f"{where}: loads: {design.loads!r}: {settings.load_table} has no such set: one of "
            f"{', '.join(known)} is allowed" + hint_nearest(design.loads, known)
        )
    try:
        place_set(settings.load_sets, design)
    except ValueError as error:
        raise InputError(
            f"{settings.load_table}: set {design.loads!r}: {error} ({where})"
        ) from None


def _check_cases(design: Design, found: Combinations, settings: Settings, source: str) -> None:
    if design.loads == PAPER:
        cases = LOAD_CASES
        check_loading(found, settings.loads, source)
    else:
        cases = list_cases({design.loads: settings.load_sets[design.loads]})
    for group in ("strength", "deflection"):
        for name, factors in getattr(found, group).items():
            place = f"{source}: combinations.{group}.{name}"
            wrong = [case for case in factors if case not in cases]
            if wrong:
                raise InputError(
                    f"{place}: {wrong[0]}: the set {design.loads!r} of design {design.name!r} has "
                    f"no such case: one of {', '.join(cases)} is allowed, or combinations.rule "
                    "makes them" + hint_nearest(wrong[0], cases)
                )
            if not any(factors.values()):
                raise InputError(
                    f"{place}: combination {name} loads nothing of the set {design.loads!r}: at "
                    "least one factor other than 0 is allowed"
                )


def note_idle_loads(settings: Settings, designs: Iterable[Design], source: str) -> list[str]:
    """Say which values of the set `paper` are changed while no design uses it."""
    if any(design.loads == PAPER for design in designs):
        return []
    plain = Loads()
    changed = [
        name for name, value in vars(settings.loads).items() if value != getattr(plain, name)
    ]
    if not changed:
        return []
    return [
        f"{source}: loads: {', '.join(changed)} is changed, but no design has the set {PAPER!r}: "
        "it acts on nothing"
    ]
