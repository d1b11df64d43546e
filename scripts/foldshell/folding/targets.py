"""Targets by name."""

from foldshell.folding.quadric import SURFACES, Quadric, make_quadric


def make_target(surface: str, span_m: float, height_m: float) -> Quadric:
    """Build the target surface `surface` over a square plan of side span [m]."""
    return make_quadric(surface, span_m, height_m)


__all__ = ["SURFACES", "make_target"]
