"""Where in a panel, and under which combination, each check of its reinforcement governs."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.envelope import Envelope
from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.use import PanelUse
from foldshell.checks.strips import NO_EDGE
from foldshell.settings.reinforcement import USES
from foldshell.shell.mesh import ShellMesh

CHECKS = (*USES, "crack", "punching")


@dataclass(frozen=True)
class Places:
    """Of P panels and the checks of `CHECKS`: `words` (P, 6) say where in the panel each governs,
    `combination` (P, 6) names under which loads."""

    words: np.ndarray
    combination: np.ndarray


def find_places(
    model: ConcreteModel,
    use: PanelUse,
    cracks: Envelope,
    names: Sequence[str],
    sustained: Sequence[str],
) -> Places:
    """Say where the largest of each check stands: a facet, a fold and the panel beyond it, a
    border, a diagonal or a vertex, with its middle in m.

    `names` are the strength combinations, `sustained` those that cracks are found under.
    """
    steel, shear = use.steel.envelope, use.shear
    most = steel.value[:, :4].argmax(axis=1)
    side = cracks.value.argmax(axis=1)
    edges = describe_rows(model.mesh, model.edge, model.local.panel, model.local.diagonal)
    wide = describe_rows(model.mesh, model.shear_edge, model.shear.panel, model.shear.diagonal)
    by_steel, by_strut = _pick(steel, most), _pick(steel, np.full(len(most), 4))
    by_shear = _pick(shear.envelope, np.zeros(len(most), dtype=int))
    by_crack = _pick(cracks, side)
    vertex = np.array([
        f"vertex at {_place(one)}" for one in model.mesh.nodes[shear.vertex]
    ])  # fmt: skip
    rows = {
        "strut": (edges[by_strut[0]], by_strut[1], names),
        "ratio": (edges[by_steel[0]], by_steel[1], names),
        "shear": (wide[by_shear[0]], by_shear[1], names),
        "fit": (edges[by_steel[0]], by_steel[1], names),
        "crack": (edges[by_crack[0]], by_crack[1] % len(sustained), sustained),
        "punching": (vertex, shear.punching_combination, names),
    }
    return Places(
        np.stack([rows[name][0] for name in CHECKS], axis=1),
        np.stack([np.array(list(rows[name][2]))[rows[name][1]] for name in CHECKS], axis=1),
    )


def _pick(found: Envelope, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return rows and combinations (P,) of one quantity of each panel."""
    at = np.arange(len(which)), which
    return found.row[at], found.combination[at]


def describe_rows(
    mesh: ShellMesh, edge: np.ndarray, panel: np.ndarray, diagonal: np.ndarray
) -> np.ndarray:
    """Say where each row of weights stands, (S,) texts: rows without an edge are facets in order.

    edge (S, 2) vertices, panel (S,) of each row, diagonal (S,) bool.
    """
    middle = np.zeros((int(mesh.facet.max()) + 1, 3))
    np.add.at(middle, mesh.facet, mesh.nodes[mesh.corners].mean(axis=1))
    middle /= np.bincount(mesh.facet)[:, None]
    beyond: dict[tuple[int, int], list[int]] = {}
    pairs = [tuple(one) for one in edge.tolist()]
    for pair, own in zip(pairs, panel.tolist(), strict=True):
        beyond.setdefault(pair, []).append(own)
    words = []
    for row, pair in enumerate(pairs):
        if pair[0] == NO_EDGE:
            words.append(f"mean of the facet at {_place(middle[row])}")
            continue
        others = [str(one) for one in beyond[pair] if one != panel[row]]
        along = f"fold to panel {', '.join(others)}" if others else "border"
        if diagonal[row]:
            along = "diagonal"
        words.append(f"{along}, middle at {_place(mesh.nodes[list(pair)].mean(axis=0))}")
    return np.array(words)


def _place(point: np.ndarray) -> str:
    """Return a place (3,) m in words."""
    return "({:.2f}, {:.2f}, {:.2f}) m".format(*point)
