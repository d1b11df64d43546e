"""The combinations by which the engineering verdict judges a design's final state."""

from dataclasses import dataclass

from foldshell.settings.field import Factors
from foldshell.settings.stage import StageSettings

PERMANENT = {"SW": 1.0, "SDL": 1.0}
WIND = ({"WX": 1.0}, {"WX": -1.0}, {"WY": 1.0}, {"WY": -1.0})
PSI_WIND = 0.6


@dataclass(frozen=True)
class CombinationSet:
    """Factors of load cases by name of the combination, by purpose."""

    strength: Factors
    characteristic: Factors
    quasi_permanent: Factors


def find_engineering_combinations(settings: StageSettings) -> CombinationSet:
    """1.35 G + 1.5 Q1 + 1.5 psi0 Q2 of EN 1990 (6.10), wind along each axis both ways, and wind
    with 1.0 G; characteristic (6.14b) and quasi-permanent (6.16b) ones."""
    variable = [{"LL": 1.0}, *({"LL": 1.0} | _times(PSI_WIND, w) for w in WIND), *WIND]
    strength = [_times(1.35, PERMANENT)]
    strength += [_times(1.35, PERMANENT) | _times(1.5, one) for one in variable]
    strength += [PERMANENT | _times(1.5, one) for one in WIND]
    service = [PERMANENT, *(PERMANENT | one for one in variable)]
    return CombinationSet(
        _number("ULS", strength), _number("SLS", service), _number("QP", [PERMANENT])
    )


def _times(factor: float, cases: dict[str, float]) -> dict[str, float]:
    return {case: round(factor * value, 12) for case, value in cases.items()}


def _number(prefix: str, found: list[dict[str, float]]) -> Factors:
    return {f"{prefix}{number}": one for number, one in enumerate(found, start=1)}
