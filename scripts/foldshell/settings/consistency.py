"""Checks of settings against each other, which no single one can state."""

from collections.abc import Container

from foldshell.files.errors import InputError
from foldshell.settings.crosscheck import GOVERNING, Crosscheck
from foldshell.settings.design import Design
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.sizing import REINFORCED, Sizing

NO_GRADIENT = (REINFORCED,)
"""Measures whose gradient is not known."""


def check_sizing(sizing: Sizing, source: str) -> None:
    """Check least <= start <= largest thickness, the order of the dead band and the measure."""
    if sizing.measure in NO_GRADIENT and sizing.rule == "optimality":
        raise InputError(
            f"{source}: sizing.measure: {sizing.measure!r} has no gradients for the rule "
            "optimality: dead_band, filtered_dead_band or fully_stressed is allowed"
        )
    least, start = sizing.least_thickness, sizing.start_thickness
    if least > sizing.largest_thickness:
        raise InputError(
            f"{source}: sizing.least_thickness_mm: {1e3 * least:g}: at most "
            f"largest_thickness_mm = {1e3 * sizing.largest_thickness:g} is allowed"
        )
    if not least <= start <= sizing.largest_thickness:
        raise InputError(
            f"{source}: sizing.start_thickness_mm: {1e3 * start:g}: least_thickness_mm = "
            f"{1e3 * least:g} to largest_thickness_mm = {1e3 * sizing.largest_thickness:g} "
            "is allowed"
            + (
                ", the value looks like m"
                if least <= 1e3 * start <= sizing.largest_thickness
                else ""
            )
        )
    _check_buildable(sizing, source)
    if sizing.utilization_min >= sizing.utilization_max:
        raise InputError(
            f"{source}: sizing.utilization_min: {sizing.utilization_min:g}: less than "
            f"utilization_max = {sizing.utilization_max:g} is allowed"
        )


def _check_buildable(sizing: Sizing, source: str) -> None:
    """Check that thicknesses which can be built lie within the bounds."""
    least, largest = 1e3 * sizing.least_thickness, 1e3 * sizing.largest_thickness
    bounds = f"least_thickness_mm = {least:g} to largest_thickness_mm = {largest:g}"
    step, listed = 1e3 * sizing.thickness_step, [1e3 * one for one in sizing.thickness_list]
    if step and listed:
        raise InputError(
            f"{source}: sizing.thickness_step_mm: {step:g}: 0 is allowed beside a thickness_list_mm"
        )
    outside = [one for one in listed if not least * (1 - 1e-9) <= one <= largest * (1 + 1e-9)]
    if outside:
        raise InputError(
            f"{source}: sizing.thickness_list_mm: {outside[0]:g}: values from {bounds} are allowed"
        )
    if step and int(largest / step * (1 + 1e-9)) * step < least * (1 - 1e-9):
        raise InputError(
            f"{source}: sizing.thickness_step_mm: {step:g}: no multiple of it lies from {bounds}: "
            "a smaller step is allowed"
        )


def check_thickness(design: Design, sizing: Sizing, where: str) -> None:
    """Check that the loop begins with, and may end in, panels that are wider than thick.

    A panel's width in plan is the closest distance of two polylines; folded panels are wider.
    """
    x, y = design.sides
    width = min(x / (design.strip - 1), y / (design.zigzag - 1))
    for key in ("start_thickness", "least_thickness"):
        thickness = getattr(sizing, key)
        if thickness >= width:
            raise InputError(
                f"{where}: span_m: {design.span:g} m with {design.zigzag} x {design.strip} lines "
                f"makes panels of {1e3 * width:.4g} mm in plan: a sizing.{key}_mm below that is "
                f"allowed, it is {1e3 * thickness:g}"
            )


def check_combinations(
    combinations: Combinations, loads: Loads, source: str, others: Container[str] = ()
) -> None:
    """Check that names differ by more than case, and that each combination loads the shell.

    `others` are cases of sets of loads, which are not 0.
    """
    seen: dict[str, str] = {}
    for group in ("strength", "deflection"):
        for name in getattr(combinations, group):
            place = f"combinations.{group}.{name}"
            first = seen.setdefault(name.casefold(), place)
            if first != place:
                kind = "a strength" if first.startswith("combinations.strength") else "another"
                same = first.endswith(f".{name}")
                raise InputError(
                    f"{source}: {place}: "
                    + (f"names {kind} combination too, each name may stand once" if same else
                       f"differs from {first} in case alone: names that differ by more are allowed")
                )  # fmt: skip
    check_loading(combinations, loads, source, others)


def check_loading(
    combinations: Combinations, loads: Loads, source: str, others: Container[str] = ()
) -> None:
    """Check that each combination loads the shell, by the values of the set `paper`."""
    wind = loads.wind * loads.wind_fraction
    value = {"SW": 1.0, "SDL": loads.superimposed_dead, "LL": loads.live, "WX": wind, "WY": wind}
    keys = {"SDL": "superimposed_dead_kn_m2", "LL": "live_kn_m2"}
    wind_keys = "wind_kn_m2 x wind_fraction"
    for group in ("strength", "deflection"):
        for name, factors in getattr(combinations, group).items():
            if any(f * (case in others or value.get(case, 0)) for case, f in factors.items()):
                continue
            zero = [keys.get(case, wind_keys) for case, f in factors.items() if f]
            why = f", loads.{' and loads.'.join(dict.fromkeys(zero))} is 0" if zero else ""
            raise InputError(
                f"{source}: combinations.{group}.{name}: combination {name} loads nothing{why}: "
                "at least one factor other than 0 of a load other than 0 is allowed"
            )


def check_crosscheck(
    crosscheck: Crosscheck, combinations: Combinations | None, source: str
) -> None:
    """Check that the compared combinations exist, where these are known yet, and that each code has
    two rising meshes."""
    for key in ("strength", "deflection") if combinations else ():
        names, known = getattr(crosscheck, key), list(getattr(combinations, key))
        wrong = [name for name in names if name not in known]
        if wrong and names != (GOVERNING,):
            raise InputError(
                f"{source}: crosscheck.{key}: {wrong[0]!r}: {GOVERNING} alone or combinations "
                f"under combinations.{key} are allowed ({', '.join(known)})"
                + hint_nearest(wrong[0], known)
            )
    coarse, fine = crosscheck.subdivisions
    if coarse >= fine:
        raise InputError(
            f"{source}: crosscheck.subdivisions: {[coarse, fine]}: two rising numbers are allowed"
        )
