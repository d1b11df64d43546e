"""What design.vtu says of itself in FieldData: title, units and meaning of its fields."""

from collections.abc import Mapping, Sequence

import numpy as np

from foldshell.results.state import DesignState

_FACET = "in the facet's axes x (axis_x), y, normal (upward)"
_MEANINGS = {
    "panel": ("-", "number of the panel, those of an edge beam after the sized panels"),
    "thickness": ("m", "thickness of the panel"),
    "thickness_class": ("-", "class of the panel, 1 for the thinnest, 0 for an edge beam"),
    "class_thickness": ("m", "thickness of that class"),
    "utilization": ("-", "largest over strength combinations and surfaces, mean of a cell"),
    "utilization_panel_mean": ("-", "its mean over the panel"),
    "governing_combination": ("-", "number of the strength combination with the largest mean"),
    "nx": ("kN/m", f"membrane force of force_combination {_FACET}, tension positive"),
    "ny": ("kN/m", "the same along y"),
    "nxy": ("kN/m", "the same, shear"),
    "axis_x": ("-", "the facet's x: global x laid on the facet"),
    "n1": ("kN/m", "larger principal membrane force of force_combination"),
    "n2": ("kN/m", "smaller principal membrane force of force_combination"),
    "direction_1": ("-", "unit direction of n1"),
    "direction_2": ("-", "unit direction of n2"),
    "principal_1": ("kN/m", "direction of n1 times n1"),
    "principal_2": ("kN/m", "direction of n2 times n2"),
    "force_combination": ("-", "number of the strength combination that governs most area"),
    "supported": ("-", "1 on a support"),
    "displacement": ("m", "displacement in displacement_combination"),
    "displacement_combination": ("-", "number of the combination with the largest downward one"),
}
_OF_COMBINATION = {
    "utilization": ("-", "utilization in"),
    "displacement": ("m", "displacement in"),
    "buckling_mode": ("-", "buckling mode, largest translation 1, under"),
    "direction_1": ("-", "unit direction of the larger principal membrane force in"),
    "n12": ("kN/m", "principal membrane forces, larger first, in"),
    "n": ("kN/m", f"membrane forces xx, yy, xy {_FACET}, tension positive, in"),
    "m": ("kNm/m", f"moments xx, yy, xy {_FACET}, positive with the lower side in tension, in"),
    "v": ("kN/m", "transverse shear forces x, y: divergence of the moments, in"),
}
_ENVELOPES = {
    f"{group}_{end}": f"the {group} combinations, {word} of each component"
    for group in ("strength", "deflection")
    for end, word in (("max", "largest"), ("min", "least"))
}


def describe_fields(
    state: DesignState, names: Sequence[str], combinations: Mapping[str, Mapping[str, float]]
) -> dict[str, np.ndarray | list[str]]:
    """Return the FieldData of design.vtu: title, verdict, units and legend of its fields.

    Arrays are (k,), of text or numbers; units are among what they say.
    """
    report, factors = state.report, known_factors(state)
    found = {name: _describe(name, state) for name in names}
    verdict = list(filter(None, (report.verdict, report.reason)))
    data: dict[str, np.ndarray | list[str]] = {
        "title": [f"foldshell: final state of {state.name}"],
        "verdict": verdict,
        "length_unit": ["m"],
        "combinations": [
            f"{number}: {name}" + _factors(combinations.get(name, {}))
            for number, name in enumerate(state.combinations, start=1)
        ],
        "units": [f"{name} [{unit}]" for name, (unit, _) in found.items()],
        "legend": [f"{name} [{unit}]: {words}" for name, (unit, words) in found.items()],
    }
    if factors:
        data["buckling_factor_of"] = list(factors)
        data["buckling_factor"] = np.array(list(factors.values()), dtype=float)
    return data


def known_factors(state: DesignState) -> dict[str, float]:
    """Return the buckling factors of the combinations whose modes are at hand."""
    if state.final.buckling_modes is None:
        return {}
    factors = state.report.buckling_factor
    return {name: factors[name] for name in state.combinations if factors.get(name) is not None}


def _describe(name: str, state: DesignState) -> tuple[str, str]:
    """Return unit and meaning of a field."""
    if name in _MEANINGS:
        return _MEANINGS[name]
    for prefix, (unit, words) in _OF_COMBINATION.items():
        rest = name.removeprefix(f"{prefix}_")
        if rest != name and (rest in state.combinations or rest in _ENVELOPES):
            return unit, f"{words} {_ENVELOPES.get(rest, rest)}"
    raise KeyError(name)


def _factors(factors: Mapping[str, float]) -> str:
    terms = [f"{factor:g} {case}" for case, factor in factors.items()]
    return f" = {' + '.join(terms)}" if terms else ""
