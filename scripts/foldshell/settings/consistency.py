"""Checks of settings against each other, which a schema cannot state."""

from foldshell.files.errors import InputError
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.options import Combinations, Crosscheck, Sizing


def check_sizing(sizing: Sizing, source: str) -> None:
    """Check least <= start <= largest thickness and the order of the dead band."""
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
    if sizing.utilization_min >= sizing.utilization_max:
        raise InputError(
            f"{source}: sizing.utilization_min: {sizing.utilization_min:g}: less than "
            f"utilization_max = {sizing.utilization_max:g} is allowed"
        )


def check_crosscheck(crosscheck: Crosscheck, combinations: Combinations, source: str) -> None:
    """Check that the compared combinations exist and that each code has two rising meshes."""
    for key in ("strength", "deflection"):
        name = getattr(crosscheck, key)
        known = list(getattr(combinations, key))
        if name not in known:
            raise InputError(
                f"{source}: crosscheck.{key}: {name!r}: a combination under combinations.{key} "
                f"is allowed ({', '.join(known)})" + hint_nearest(name, known)
            )
    coarse, fine = crosscheck.subdivisions
    if coarse >= fine:
        raise InputError(
            f"{source}: crosscheck.subdivisions: {[coarse, fine]}: two rising numbers are allowed"
        )
