"""Combination rules of codes of practice and their factors."""

from foldshell.settings.field import Group, setting, settings_group

RULES = ("paper", "asce7", "en1990")
"""Rules by which combinations are made of the actions of load cases."""


def _psi(default: float, meaning: str) -> float:
    return setting(default, minimum=0, maximum=1, meaning=meaning)


@settings_group
class En1990(Group):
    """Factors of EN 1990, expression (6.10) with Tables A1.1 and A1.2(B), recommended values."""

    permanent_unfavourable: float = setting(
        1.35, minimum=0, maximum=10, meaning="gamma_G,sup of permanent actions."
    )
    permanent_favourable: float = setting(
        1.0, minimum=0, maximum=10, meaning="gamma_G,inf, together with wind alone."
    )
    variable: float = setting(1.5, minimum=0, maximum=10, meaning="gamma_Q of variable actions.")
    settlement: float = setting(
        1.2, minimum=0, maximum=10,
        meaning="gamma_SET of settlements (EN 1992-1-1, 2.3.1.3, linear elastic).",
    )  # fmt: skip
    imposed_psi0: float = _psi(0, "Combination value of imposed load, roofs of category H.")
    imposed_psi1: float = _psi(0, "Frequent value of imposed load.")
    imposed_psi2: float = _psi(0, "Quasi-permanent value of imposed load.")
    snow_psi0: float = _psi(0.5, "Combination value of snow, up to 1000 m above the sea.")
    snow_psi1: float = _psi(0.2, "Frequent value of snow.")
    snow_psi2: float = _psi(0, "Quasi-permanent value of snow.")
    wind_psi0: float = _psi(0.6, "Combination value of wind.")
    wind_psi1: float = _psi(0.2, "Frequent value of wind.")
    wind_psi2: float = _psi(0, "Quasi-permanent value of wind.")
    temperature_psi0: float = _psi(0.6, "Combination value of temperature.")
    temperature_psi1: float = _psi(0.5, "Frequent value of temperature.")
    temperature_psi2: float = _psi(0, "Quasi-permanent value of temperature.")


@settings_group
class Codes(Group):
    """What the engineering verdict is combined by; the sizing loop has `combinations`."""

    engineering: str = setting(
        "en1990", choices=RULES,
        meaning="Rule of the combinations of the engineering verdict: EN 1990, ASCE 7, or the "
        "factors of the paper; each with wind both ways.",
    )  # fmt: skip
    en1990: En1990
