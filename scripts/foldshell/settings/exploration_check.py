"""An exploration against the settings of its study: designs that there may be, aims that exist."""

from collections.abc import Iterator
from dataclasses import replace

from foldshell.files.errors import InputError
from foldshell.settings.design import Design, leave_out_names
from foldshell.settings.designs import check_row
from foldshell.settings.exploration import ENGINEERING_AIMS, Exploration, list_sizing
from foldshell.settings.field import Plain
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.study import Settings
from foldshell.settings.supports import SupportFinder


def settle_exploration(exploration: Exploration, settings: Settings, source: str) -> Exploration:
    """Return an exploration with the sets of supports that it names, its base as a table has it.

    Raises `InputError` for ends of ranges and choices that make no design of the table, for an
    aim that no design has under these settings, for a measure without what the search needs.
    """
    base = leave_out_names(_check(exploration.base, settings, f"{source}: base").to_row())
    settled = replace(exploration, base={**exploration.base, **base})
    for place, values in list_ends(settled):
        _check(settled.make_row("base", values), settings, f"{source}: variables, {place}")
    _check_measure(settled, settings, source)
    _check_aims(settled, settings, source)
    return replace(settled, supports=_find_supports(settled, settings, source))


def list_ends(exploration: Exploration) -> Iterator[tuple[str, Plain]]:
    """Yield rows of columns with the words for them: all lows, all highs, each choice alone."""
    ends = {}
    for side in ("least", "most"):
        share = 0.0 if side == "least" else 1.0
        ends[side] = {v.name: v.to_value(share) for v in exploration.variables}
        yield f"all at their {side}", ends[side]
    for variable in exploration.variables:
        for word in variable.choices:
            yield f"{variable.name} {word}", ends["least"] | {variable.name: word}


def _check(row: Plain, settings: Settings, place: str) -> Design:
    """Return the design of a row as the table would have it."""
    plain = Design(name="base", **vars(settings.defaults)).to_row()
    cells = {
        key: f"{value}" for key, value in row.items() if key in plain and value != plain[key]
    }  # fmt: skip
    return check_row({**cells, "design": "base"}, settings, place)


def _find_supports(exploration: Exploration, settings: Settings, source: str) -> dict[str, list]:
    words = [(f"{source}: base.support", str(exploration.base["support"]))]
    for variable in exploration.variables:
        if variable.name == "support":
            words = [(f"{source}: variables.support", word) for word in variable.choices]
    finder = SupportFinder(settings.supports)
    found = {word: finder.find(word, place) for place, word in words}
    return {word: [row.to_plain() for row in rows] for word, rows in found.items() if rows}


def _check_measure(exploration: Exploration, settings: Settings, source: str) -> None:
    search = exploration.search
    asked = f"search.measure: {search.measure!r}"
    if list_sizing(exploration, settings.sizing)["measure"] != REINFORCED:
        return
    if search.rule == "optimality":
        raise InputError(
            f"{source}: {asked}: reinforced has no gradients for the rule optimality: dead_band or "
            "filtered_dead_band is allowed as search.rule"
        )
    if search.gradient_step:
        raise InputError(
            f"{source}: search.gradient_step: True: reinforced has no gradients: False is allowed"
        )


def _check_aims(exploration: Exploration, settings: Settings, source: str) -> None:
    for aim in exploration.aims:
        why = _say_missing(aim, exploration, settings)
        if why:
            raise InputError(f"{source}: aims: {aim!r}: no design has this value: {why}")


def _say_missing(aim: str, exploration: Exploration, settings: Settings) -> str:
    """Say why no design has the value of an aim under these settings; empty where designs do."""
    if aim not in ENGINEERING_AIMS:
        return ""
    kind, prices = settings.material.kind, settings.prices
    if kind != "concrete":
        return f"material.kind is {kind}: concrete is due"
    if settings.reinforcement.kind == "none":
        return "reinforcement.kind is none: bars, central_mesh or textile is due"
    if aim == "cost" and not (prices.concrete_m3 or prices.steel_kg or prices.crease_m):
        return "no price is given: prices.concrete_m3, steel_kg or crease_m is due"
    measure = list_sizing(exploration, settings.sizing)["measure"]
    if aim == "engineering_volume_m3" and measure != REINFORCED:
        return "it is that of shells sized by reinforced: search.measure: reinforced is due"
    return ""
