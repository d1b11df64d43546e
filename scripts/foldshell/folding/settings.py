"""Settings of the folding stage, from plain values."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from foldshell.files.errors import InputError
from foldshell.folding.exact import ExactWeights
from foldshell.folding.problem import Weights

MODES = ("paper", "isometric", "exact", "rigid")
# 2e-3 is what rigid domes are to reach; isometric saddles come nearer, or something went wrong.
SADDLE_RMS = 1.6e-3
ENGINES = ("levenberg_marquardt", "averaged_projections")


@dataclass(frozen=True)
class Limits:
    """What a folded sheet must keep to be called ok.

    `plan_coverage` is the share of what the sheet covers as it is first laid on the target.
    """

    rms_over_span: float = 2e-3
    plan_coverage: float = 0.8

    def allowed_rms(self, mode: str) -> float:
        """rms distance over span that `mode` may leave: an isometric saddle at most SADDLE_RMS."""
        return min(self.rms_over_span, SADDLE_RMS) if mode == "isometric" else self.rms_over_span


@dataclass(frozen=True)
class FoldSettings:
    """Engine, attracted vertices, weights, stopping rules and limits.

    `tolerance` is the relative fall of the cost below which the engine stops.
    """

    engine: str = "levenberg_marquardt"
    attract: str = "lowest"
    weights: Weights = field(default_factory=Weights)
    max_iterations: int = 60
    tolerance: float = 1e-4
    limits: Limits = field(default_factory=Limits)
    exact: ExactWeights = field(default_factory=ExactWeights)


def read_settings(values: Mapping[str, Any], where: str = "fold") -> FoldSettings:
    """Build settings from the `fold:` section of the configuration.

    Raises InputError for an unknown key, a wrong type or a value out of range.
    """
    known = {
        "weights": lambda v: _read_numbers(Weights, v, f"{where}.weights"),
        "exact": lambda v: _read_numbers(ExactWeights, v, f"{where}.exact"),
        "limits": lambda v: _read_numbers(Limits, v, f"{where}.limits"),
        "engine": lambda v: _read_choice(v, ENGINES, f"{where}.engine"),
        "attract": lambda v: _read_choice(v, ("lowest", "highest"), f"{where}.attract"),
        "max_iterations": lambda v: _read_count(v, f"{where}.max_iterations"),
        "tolerance": lambda v: _read_number(v, f"{where}.tolerance"),
    }
    unknown = sorted(set(values) - set(known))
    if unknown:
        raise InputError(f"{where}: {unknown[0]}: unknown key: one of {', '.join(known)}")
    return FoldSettings(**{key: known[key](value) for key, value in values.items()})


def _read_numbers(kind: type, values: Any, where: str) -> Any:
    names = [f.name for f in fields(kind)]
    if not isinstance(values, Mapping):
        raise InputError(f"{where}: {values!r}: must be a mapping of numbers")
    unknown = sorted(set(values) - set(names))
    if unknown:
        raise InputError(f"{where}: {unknown[0]}: unknown key: one of {', '.join(names)}")
    return kind(**{key: _read_number(value, f"{where}.{key}") for key, value in values.items()})


def _read_number(value: Any, where: str) -> float:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not number or not 0 <= value < float("inf"):
        raise InputError(f"{where}: {value!r}: must be a number of 0 or more")
    return float(value)


def _read_count(value: Any, where: str) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or value < 1:
        raise InputError(f"{where}: {value!r}: must be a whole number of 1 or more")
    return value


def _read_choice(value: Any, allowed: tuple[str, ...], where: str) -> str:
    if value not in allowed:
        raise InputError(f"{where}: {value!r}: must be one of {', '.join(allowed)}")
    return value
