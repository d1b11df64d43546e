"""Principal stress lines: trajectories of the principal membrane forces, traced across folds.

Inside an element the forces are polynomials and evaluated exactly; a line walks along the
principal direction by the midpoint rule. At an element edge it goes on in the neighbour, with its
direction turned about the edge as if the fold were opened flat; of the two senses of the
neighbour's principal direction it takes the nearer one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.results.line_spacing import PrincipalStressLine, thin_out
from foldshell.shell.element import ElementGeometry
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import EDGES, lattice_points, orthonormal_basis

TURN_MIN = 0.35
"""Least cosine between a line's direction and the principal direction beyond an edge."""

SPREAD_MIN = 0.1
"""Least difference of the principal forces, as a share of the larger, that has a direction."""
WINDING_MAX = 1.25 * np.pi
"""Angle after which a line that turns one way has come round and ends."""
STARTS_MAX = 800
"""Elements in which lines start; of finer meshes every second, third, ... is taken."""
SMOOTH = 0.8
"""Cosine of a turn at a fold below which a line looks at the other principal direction too."""


@dataclass(frozen=True)
class ForceField:
    """Membrane forces in the elements' frames on a mesh: polynomials (E, 3, m) in r^i s^j, kN/m."""

    mesh: ShellMesh
    geometry: ElementGeometry
    polynomial: np.ndarray

    def evaluate(self, element: np.ndarray, place: np.ndarray) -> np.ndarray:
        """Return forces (K, 3) at reference points (K, 2) of elements (K,).

        kN/m; places in the reference triangle have no unit.
        """
        values = monomials(self.mesh.order - 1, place)
        return np.matmul(self.polynomial[element], values[:, :, None])[:, :, 0]

    def principal(
        self, element: np.ndarray, place: np.ndarray, family: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return value, direction and whether there is one, see `choose_principal`.

        Places (K, 2) in the reference triangle of elements (K,) have no unit.
        """
        return choose_principal(self.evaluate(element, place), family)

    def position(self, element: np.ndarray, place: np.ndarray) -> np.ndarray:
        """Return points in space (K, 3) m."""
        corner = self.mesh.nodes[self.mesh.corners[element]]
        return np.einsum("kc,kcx->kx", barycentric(place), corner)


def choose_principal(
    force: np.ndarray, family: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return value (K,) kN/m, local direction (K, 2) and whether there is one (K,).

    Family (K,) 0 is the larger of the principal forces of (K, 3) kN/m, 1 the other. Where both are
    nearly equal no direction is principal.
    """
    xx, yy, xy = force.T
    angle = np.arctan2(2 * xy, xx - yy) / 2 + family * np.pi / 2
    mean, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    value = mean + (1 - 2 * family) * radius
    distinct = 2 * radius >= SPREAD_MIN * (np.abs(mean) + radius)
    direction = np.empty((len(angle), 2))
    np.cos(angle, out=direction[:, 0])
    np.sin(angle, out=direction[:, 1])
    return value, direction, distinct


def make_force_field(
    mesh: ShellMesh, geometry: ElementGeometry, coefficients: np.ndarray
) -> ForceField:
    """Turn coefficients (E, 3, m) of the orthonormal basis into polynomials."""
    points = lattice_points(max(mesh.order - 1, 1))
    basis = orthonormal_basis(mesh.order - 1, points)
    change = np.linalg.lstsq(monomials(mesh.order - 1, points), basis, rcond=None)[0]
    return ForceField(mesh, geometry, coefficients @ change.T)


def monomials(degree: int, place: np.ndarray) -> np.ndarray:
    """Return r^i s^j (K, m), i + j <= degree, at reference points (K, 2)."""
    i, j = _exponents(degree)
    powers = np.ones((degree + 1, *place.shape))
    for k in range(degree):
        np.multiply(powers[k], place, out=powers[k + 1])
    return (powers[i, :, 0] * powers[j, :, 1]).T


@lru_cache(maxsize=8)
def _exponents(degree: int) -> np.ndarray:
    """Return i and j (2, m) with i + j <= degree."""
    return np.array([(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]).T


def barycentric(place: np.ndarray) -> np.ndarray:
    """Return (K, 3) of reference coordinates (K, 2). Without unit."""
    return np.column_stack([1 - place.sum(axis=1), place])


def trace_principal_stress_lines(
    field: ForceField,
    families: Sequence[int],
    spacing: float,
    step: float,
    steps_max: int = 300,
) -> list[PrincipalStressLine]:
    """Return lines of the families, those of each about `spacing` m apart, strongest first.

    A line starts in the middle of elements, `STARTS_MAX` at most, both ways, in steps of at most
    `step` m. At a fold it takes the principal direction of its own family, or the other one where
    that is nearer and pulls or pushes as it did. It ends at a border, where the direction turns by
    more than 70 degrees, where the principal forces are equal, where it has come round, after
    `steps_max` steps, or where it comes close to a stronger line. None starts close to another:
    Jobard and Lefer, Creating evenly-spaced streamlines of arbitrary density (1997).
    """
    elements = len(field.mesh.elements)
    start = np.arange(0, elements, -(-elements // STARTS_MAX))
    count, number = len(start), len(families)
    element = np.tile(start, 2 * number)
    family = np.tile(np.repeat(families, count), 2)
    sense = np.repeat([1.0, -1.0], number * count)
    named = family.copy()  # a line may go over to the other family on its way
    points, forces, lengths = _walk(field, family, element, sense, step, steps_max)
    lines: dict[int, list[PrincipalStressLine]] = {name: [] for name in families}
    for k in range(number * count):
        other = number * count + k
        back, ahead = slice(lengths[other] - 1, 0, -1), slice(0, lengths[k])
        whole = np.concatenate([points[back, other], points[ahead, k]])
        force = np.concatenate([forces[back, other], forces[ahead, k]])
        line = PrincipalStressLine(whole, force, int(named[k]), max(int(lengths[other]) - 1, 0))
        lines[line.family].append(line)
    return [line for found in lines.values() for line in thin_out(found, spacing)]


def _walk(field, family, element, sense, step, steps_max):
    """Walk all lines at once; return points (n, K, 3), forces (n, K), points of each line (K,)."""
    place = np.full((len(element), 2), 1 / 3)
    value, direction, distinct = field.principal(element, place, family)
    direction = sense[:, None] * direction
    winding = np.zeros(len(element))
    neighbour = find_neighbours(field.mesh)
    points = [field.position(element, place)]
    forces = [value]
    lengths = np.ones(len(element), dtype=int)
    active = np.flatnonzero(distinct)
    for _ in range(steps_max):
        if not active.size:
            break
        here = _step(field, family[active], neighbour, element[active], place[active],
                     direction[active], step)  # fmt: skip
        going, element[active], place[active], direction[active], family[active], value, turn = here
        winding[active] += turn
        going &= np.abs(winding[active]) < WINDING_MAX
        points.append(points[-1].copy())
        forces.append(forces[-1].copy())
        points[-1][active] = field.position(element[active], place[active])
        forces[-1][active] = value
        lengths[active] += 1
        active = active[going]
    return np.array(points), np.array(forces), lengths


def _step(field, family, neighbour, element, place, direction, step):
    """One midpoint step, not beyond the element's edge, and over to the neighbour there."""
    half, _ = _advance(field, element, place, direction, step / 2)
    _, middle, _ = field.principal(element, half, family)
    middle = _align(middle, direction)
    place, edge = _advance(field, element, place, middle, step)
    value, after, going = field.principal(element, place, family)
    after = _align(after, middle)
    turn = _angle(direction, middle) + _angle(middle, after)
    direction = after
    out = np.flatnonzero(edge >= 0)
    crossed = _cross(
        field, family[out], neighbour, element[out], place[out], direction[out], edge[out],
        value[out],
    )  # fmt: skip
    goes_on, element[out], place[out], direction[out], family[out] = crossed
    going[out] &= goes_on
    return going, element, place, direction, family, value, turn


def _advance(field, element, place, direction, step):
    """Go `step` m along a local direction or to the edge; return place and the edge met or -1."""
    slope = np.einsum("kab,kb->ka", field.geometry.inverse[element], direction)
    rate = np.column_stack([-slope.sum(axis=1), slope])
    share = barycentric(place)
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.where(rate < 0, np.maximum(share, 0) / -rate, np.inf)
    corner = reach.argmin(axis=1)
    reach = reach[np.arange(len(element)), corner]
    met = reach <= step
    place = place + np.minimum(reach, step)[:, None] * slope
    return place, np.where(met, (corner + 1) % 3, -1)


def _cross(field, family, neighbour, element, place, direction, edge, force):
    """Turn lines about the edge into the neighbour; tell which of them go on."""
    row = np.arange(len(element))
    normal = field.geometry.edge_normal[element, edge]
    along = _turn_left(normal)
    share = barycentric(place)[row, EDGES[edge, 1]]
    next_element, next_edge = neighbour[element, edge].T
    exists = next_element >= 0
    target, gate = np.where(exists, next_element, element), np.where(exists, next_edge, edge)
    new_normal = field.geometry.edge_normal[target, gate]
    tangential = np.einsum("ka,ka->k", direction, along)
    across = np.einsum("ka,ka->k", direction, normal)
    turned = -tangential[:, None] * _turn_left(new_normal) - across[:, None] * new_normal
    bary = np.zeros((len(element), 3))
    bary[row, EDGES[gate, 0]] = share
    bary[row, EDGES[gate, 1]] = 1 - share
    entry = bary[:, 1:]
    family, principal, cosine = _choose_family(field, family, target, entry, turned, force)
    inward = -np.einsum("ka,ka->k", principal, new_normal)
    going = exists & (cosine > TURN_MIN) & (inward > 1e-6)
    keep = going[:, None]
    return (
        going,
        np.where(going, target, element),
        np.where(keep, entry, place),
        np.where(keep, principal, direction),
        family,
    )


def _choose_family(field, family, element, place, direction, force):
    """Return family, direction and cosine of the turn with which lines go on beyond a fold."""
    found, here = [], field.evaluate(element, place)
    for one in (family, 1 - family):
        value, principal, _ = choose_principal(here, one)
        principal = _align(principal, direction)
        found.append((value, principal, np.einsum("ka,ka->k", principal, direction)))
    (_, own, cosine), (value, other, other_cosine) = found
    change = (cosine < SMOOTH) & (other_cosine > cosine) & (value * force > 0)
    return (
        np.where(change, 1 - family, family),
        np.where(change[:, None], other, own),
        np.where(change, other_cosine, cosine),
    )


def _turn_left(vector: np.ndarray) -> np.ndarray:
    return np.stack([-vector[:, 1], vector[:, 0]], axis=1)


def _angle(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the signed angles (K,) from unit vectors (K, 2) to others."""
    sine = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return np.arctan2(sine, np.einsum("ka,ka->k", first, second))


def _align(direction: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Reverse those directions (K, 2) that point against the wanted ones."""
    sign = np.where(np.einsum("ka,ka->k", direction, wanted) < 0, -1.0, 1.0)
    return sign[:, None] * direction


def find_neighbours(mesh: ShellMesh) -> np.ndarray:
    """Return element and edge (E, 3, 2) on the other side of each edge, -1 at a border.

    Numbers, as are the elements (E, n).
    """
    order = np.argsort(mesh.element_edges.ravel(), kind="stable")
    edge = mesh.element_edges.ravel()[order]
    pair = np.flatnonzero(edge[:-1] == edge[1:])
    first, second = order[pair], order[pair + 1]
    other = np.full(mesh.element_edges.size, -1)
    other[first], other[second] = second, first
    neighbour = np.stack([other // 3, other % 3], axis=1)
    neighbour[other < 0] = -1
    return neighbour.reshape(-1, 3, 2)
