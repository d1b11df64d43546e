"""How much of what steel and concrete allow each panel uses, for sizing and for the verdict."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.panel_shear import PanelShear, find_panel_shear
from foldshell.checks.concrete.panels import PanelSteel, find_panel_steel
from foldshell.shell.stress import StressResultants


@dataclass(frozen=True)
class PanelUse:
    """Of P panels and the k uses asked for: `names` of these, `shares` (P, k), `combination`
    (P, k) that governs each as a number."""

    names: tuple[str, ...]
    shares: np.ndarray
    combination: np.ndarray
    steel: PanelSteel
    shear: PanelShear | None

    @property
    def largest(self) -> np.ndarray:
        """Return the largest share of each panel, (P,). Without unit."""
        return self.shares.max(axis=1)

    @property
    def governing(self) -> np.ndarray:
        """Return the combination under which each panel is used most, (P,) as numbers."""
        which = self.shares.argmax(axis=1)[:, None]
        return np.take_along_axis(self.combination, which, axis=1)[:, 0]


def find_panel_use(
    model: ConcreteModel,
    resultants: StressResultants,
    thickness: np.ndarray,
    names: tuple[str, ...],
) -> PanelUse:
    """Shares of strut, ratio, shear and fit, those of `names`.

    Parameters
    ----------
    resultants : of c strength combinations, (E, 3, m, c) kN/m and kNm/m
    thickness : (P,) m of the sized panels
    """
    steel = find_panel_steel(model, resultants, thickness)
    shear = find_panel_shear(model, resultants, steel) if "shear" in names else None
    most = steel.envelope.value[:, :4].argmax(axis=1)[:, None]
    by_steel = np.take_along_axis(steel.envelope.combination[:, :4], most, axis=1)[:, 0]
    known = {
        "strut": (steel.strut_use, steel.envelope.combination[:, 4]),
        "ratio": (steel.ratio_use, by_steel),
        "fit": (steel.fit_use, by_steel),
    }
    if shear is not None:
        known["shear"] = (shear.use, shear.envelope.combination[:, 0])
    shares, combination = (np.stack([known[name][k] for name in names], axis=1) for k in (0, 1))
    return PanelUse(tuple(names), shares, combination, steel, shear)
