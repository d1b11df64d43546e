"""Whether numbers of a shell may be believed: what theory and mesh do not hold is named.

Width of a panel: the least altitude of its two facets. Bounds and where they come from:

- thickness over width up to 1/10: plate theory without shear deformation (Ventsel and Krauthammer,
  Thin Plates and Shells, 2001, ch. 1: thin from a/h of 8 to 10 on);
- width over thickness up to 80: above 80 to 100 a plate is a membrane (the same), and one element
  per facet is up to 11 % off in displacement (3 % at 48, 14 % at 100, 18 % at 160: three sheets of
  tests/verification, against order 6 on facets divided twice);
- thickness over the radius of the form up to 1/20: a thin shell (Novozhilov, The Theory of Thin
  Shells, 1959, ch. 1), relative errors of its order;
- displacement up to 1/50 of the span: second order here means small displacements; the rotations of
  such a half wave are pi / 50, their square, which is neglected, 0.4 %;
- a support that carries less than 1e-6 of all reactions, under every combination, carries nothing.
"""

from dataclasses import dataclass, field

import numpy as np

from foldshell.shell.mesh import ShellMesh, list_facets

THICKEST = 1 / 10
THINNEST = 1 / 80
OVER_RADIUS = 1 / 20
OVER_SPAN = 1 / 50
IDLE = 1e-6
NEIGHBOURS = 13
"""Panels that a form's radius is fitted to: one and its neighbours."""
FEW = 1000


@dataclass(frozen=True)
class ModelState:
    """What the checks look at, of the P sized panels.

    Attributes
    ----------
    thickness, width : (P,) m
    radius : (P,) m, of the form; inf where it is flat
    span : m
    displacement : largest of all nodes and deflection combinations in m, None without an answer
    reactions : (S, 3, C) kN of supported nodes, None without an answer
    nodes : (S, 3) m, those nodes
    runs : (S,) number of the supported run that each of them belongs to
    edge_beam : (2, B) m, thickness and width of the panels of an edge beam
    """

    thickness: np.ndarray
    width: np.ndarray
    radius: np.ndarray
    span: float
    displacement: float | None
    reactions: np.ndarray | None
    nodes: np.ndarray
    runs: np.ndarray
    edge_beam: np.ndarray = field(default_factory=lambda: np.empty((2, 0)))


def list_warnings(state: ModelState) -> list[str]:
    """Return one sentence for each bound that is passed, none where the model holds."""
    over_width, over_radius = state.thickness / state.width, state.thickness / state.radius
    found = [
        _warn(over_width > THICKEST, over_width, "thicker than 1/10 of their width", state.width,
              state, "shear deformation, which is left out, counts"),
        _warn(over_width < THINNEST, -over_width, "thinner than 1/80 of their width", state.width,
              state, "theory of small displacements and one element per facet do not hold them"),
        _warn(over_radius > OVER_RADIUS, over_radius, "thicker than 1/20 of the form's radius",
              state.radius, state, "thin-shell theory does not hold them"),
    ]  # fmt: skip
    thickness, width = state.edge_beam
    thick = thickness / width > THICKEST
    if thick.any():
        found.append(
            f"{int(thick.sum())} of {len(thick)} panels of the edge beam are thicker than 1/10 of "
            f"their width of {width.min():.3g} m and more: shear deformation, which is left out, "
            "counts"
        )
    if state.displacement is not None and state.displacement > OVER_SPAN * state.span:
        found.append(
            f"displacement of {state.displacement:.3g} m is more than 1/50 of the span of "
            f"{state.span:g} m: displacements are taken as small"
        )
    return [sentence for sentence in found if sentence] + list_idle_supports(state)


def _warn(
    beyond: np.ndarray, worst: np.ndarray, words: str, size: np.ndarray, state: ModelState, why: str
) -> str:
    if not beyond.any():
        return ""
    panel = int(np.argmax(worst))
    return (
        f"{int(beyond.sum())} of {len(beyond)} panels are {words}, worst panel {panel} with "
        f"{1e3 * state.thickness[panel]:.4g} mm on {size[panel]:.3g} m: {why}"
    )


def list_idle_supports(state: ModelState) -> list[str]:
    """Return one sentence for each run of supported nodes whose reactions are all nothing."""
    if state.reactions is None or not len(state.nodes):
        return []
    size = np.linalg.norm(state.reactions, axis=1).max(axis=1)
    carried = np.bincount(state.runs, size)
    idle = np.flatnonzero(carried <= IDLE * carried.sum())
    middle = [state.nodes[state.runs == run].mean(axis=0).round(2).tolist() for run in idle]
    return [f"the support about {place} m carries nothing" for place in middle]


def measure_widths(mesh: ShellMesh) -> np.ndarray:
    """w = min over facets of 2 A / longest side: width (P,) [m] of each panel."""
    facets, panel = list_facets(mesh)
    corner = mesh.nodes[facets]
    area = np.linalg.norm(
        np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
    )
    longest = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).max(axis=1)
    width = np.full(int(panel.max()) + 1, np.inf)
    np.minimum.at(width, panel, area / longest)
    return width


def measure_form_radii(mesh: ShellMesh, panels: int) -> np.ndarray:
    """1 / largest principal curvature of the form (P,) [m] about each of the first P panels.

    The form runs through the panels' middles, since zig-zags rise and fall about them: a quadric
    is fitted to those of a panel and its nearest neighbours, in the frame of their own plane.
    """
    facets, panel = list_facets(mesh)
    count = np.bincount(panel, minlength=panels)[:panels]
    own = panel < panels
    middle = np.zeros((panels, 3))
    np.add.at(middle, panel[own], mesh.nodes[facets[own]].mean(axis=1))
    middle /= count[:, None]
    if panels < NEIGHBOURS:
        return np.full(panels, np.inf)
    return fit_radii(middle)


def fit_radii(points: np.ndarray) -> np.ndarray:
    """Radius (P,) [m] of the surface through points (P, 3) [m] about each of them; inf for a plane.

    z = a + b x + c y + d x2 + e x y + f y2 by least squares over the nearest points; the principal
    curvatures are those of its Hessian at slope (b, c).
    """
    local = points[_find_nearest(points)] - points[:, None]
    _, _, frame = np.linalg.svd(local - local.mean(axis=1, keepdims=True), full_matrices=False)
    x, y, z = np.einsum("pki,pji->jpk", local, frame)
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
    fit = np.einsum("pij,pj->pi", np.linalg.pinv(terms, rcond=1e-9), z)
    _, b, c, d, e, f = fit.T
    first = np.stack([1 + b * b, b * c, b * c, 1 + c * c], axis=-1).reshape(-1, 2, 2)
    second = np.stack([2 * d, e, e, 2 * f], axis=-1).reshape(-1, 2, 2)
    second /= np.sqrt(1 + b * b + c * c)[:, None, None]
    curvature = np.abs(np.linalg.eigvals(np.linalg.solve(first, second))).max(axis=1)
    with np.errstate(divide="ignore"):
        return np.where(curvature > 1e-9, 1 / curvature, np.inf)


def _find_nearest(points: np.ndarray) -> np.ndarray:
    """Rows (P, k) of the points nearest to each (P, 3), itself among them."""
    if len(points) <= FEW:  # a tree is not worth the time of its import
        square = ((points[:, None] - points[None]) ** 2).sum(axis=2)
        return np.argpartition(square, NEIGHBOURS - 1, axis=1)[:, :NEIGHBOURS]
    from scipy.spatial import cKDTree

    return cKDTree(points).query(points, NEIGHBOURS)[1]


def find_support_runs(mesh: ShellMesh, supported: np.ndarray) -> np.ndarray:
    """Number the connected runs of supported nodes: those that share an element belong together.

    `supported` (S,) are node numbers; returns (S,) numbers from 0 in their order.
    """
    lowest = np.full(len(mesh.nodes), len(mesh.nodes))
    lowest[supported] = np.arange(len(supported))
    held = np.zeros(len(mesh.nodes), dtype=bool)
    held[supported] = True
    elements = mesh.elements[held[mesh.elements].any(axis=1)]
    while True:  # the lowest number of each run spreads from element to element
        before = lowest.copy()
        least = np.broadcast_to(lowest[elements].min(axis=1, keepdims=True), elements.shape)
        np.minimum.at(lowest, elements[held[elements]], least[held[elements]])
        if (lowest == before).all():
            return np.unique(lowest[supported], return_inverse=True)[1]
