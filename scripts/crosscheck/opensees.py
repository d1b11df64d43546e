"""A third opinion by OpenSees: flat triangles of a neutral model in its own shell elements.

OpenSees is not among the packages of the workflow: `envs/bench.in` names it.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from crosscheck.comparison import KINDS, Code
from crosscheck.errors import CrosscheckError
from crosscheck.loads import combine_cases, compute_surface_loads
from crosscheck.model import Model

ELEMENT = "ASDShellT3"
"""Three-node shell with drilling rotations, of first order unless told otherwise."""
SYSTEM = "Mumps"


@dataclass(frozen=True)
class ShellGrid:
    """What OpenSees is told of a shell: `forces` (N, 3, c) in kN, `thickness` (E,) in m."""

    nodes: np.ndarray  # (N, 3) m
    elements: np.ndarray  # (E, corners)
    supported: np.ndarray  # (S,) pinned nodes
    forces: np.ndarray
    thickness: np.ndarray
    youngs_modulus: float  # kPa
    poissons_ratio: float

    @property
    def free(self) -> np.ndarray:
        """Numbers (n,) of the nodes that may move."""
        return np.setdiff1d(np.arange(len(self.nodes)), self.supported)


def open_opensees() -> Any:
    """The interpreter of OpenSees; raises CrosscheckError where it is not installed."""
    try:
        import openseespy.opensees as ops
    except (ImportError, RuntimeError):
        raise CrosscheckError(
            "crosscheck_opensees: openseespy is not installed: `pip install openseespy` adds it, "
            "the study itself does without"
        ) from None
    return ops


def divide_facets(model: Model, subdivisions: int) -> ShellGrid:
    """Divide each facet into n x n triangles, loaded a third at each corner, as uniform loads are.

    The loads are those of the compared combinations; what varies over a facet is taken by its mean.
    """
    if not all(support.is_pin for support in model.supports):
        raise CrosscheckError(
            f"{model.design}: supports: crosscheck_opensees knows edges that are pinned along x, y "
            "and z: other supports are not allowed here"
        )
    n, facets = subdivisions, model.facets
    lattice = np.array([(n - i - j, i, j) for j in range(n + 1) for i in range(n + 1 - j)])
    vertex = np.where(lattice > 0, facets[:, None], -1)  # (F, L, 3)
    order = np.argsort(vertex, axis=2)
    weight = np.take_along_axis(np.broadcast_to(lattice, vertex.shape), order, 2)
    key = np.concatenate([np.take_along_axis(vertex, order, 2), weight], axis=2).reshape(-1, 6)
    key, number = np.unique(key, axis=0, return_inverse=True)
    number = number.reshape(len(facets), -1)
    nodes = np.einsum("nk,nkx->nx", key[:, 3:] / n, model.vertices[key[:, :3]])
    elements = number[:, _list_triangles(lattice)]
    a, b, c = (model.vertices[facets[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1) / 2
    surface = _find_surface(model, normal / (2 * area[:, None]))
    share = surface * (area / (3 * n * n))[:, None, None]
    forces = np.zeros((len(nodes), *share.shape[1:]))
    for corner in range(3):
        np.add.at(forces, elements[:, :, corner], share[:, None])
    return ShellGrid(
        nodes,
        elements.reshape(-1, 3),
        _find_supported(model, key),
        forces,
        np.repeat(model.thickness, n * n),
        model.material.youngs_modulus,
        model.material.poissons_ratio,
    )


def _find_surface(model: Model, normal: np.ndarray) -> np.ndarray:
    """Mean load of each compared combination on each facet: (F, 3, k) kN/m2."""
    chosen = model.compared_combinations
    if not model.own_loads:
        return combine_cases(compute_surface_loads(model, normal), chosen)
    from crosscheck.own_forces import mean_own_loads

    return combine_cases(mean_own_loads(model), chosen, model.cases)


def _list_triangles(lattice: np.ndarray) -> np.ndarray:
    """Places in the lattice of the n x n triangles of a facet, counter-clockwise: (n^2, 3)."""
    place = {(i, j): k for k, (_, i, j) in enumerate(lattice.tolist())}
    shapes = (((0, 0), (1, 0), (0, 1)), ((1, 0), (1, 1), (0, 1)))
    triangles = [[(i + a, j + b) for a, b in shape] for shape in shapes for i, j in place]
    return np.array([[place[p] for p in three] for three in triangles if place.keys() >= {*three}])


def _find_supported(model: Model, key: np.ndarray) -> np.ndarray:
    """Nodes on supported edges; `key` (N, 6) holds vertices, -1 for none, and their weights."""
    count = len(model.vertices)
    pairs = np.sort(model.supported_edges, axis=1) @ [count, 1]
    between = (key[:, 0] < 0) & (key[:, 1] >= 0) & np.isin(key[:, 1] * count + key[:, 2], pairs)
    corner = (key[:, 1] < 0) & np.isin(key[:, 2], model.supported_edges)
    return np.flatnonzero(between | corner)


def enter_shell(ops: Any, grid: ShellGrid, element: str = ELEMENT, flags: Sequence = ()) -> None:
    """Enter nodes, supports, a section for each thickness, and elements."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for tag, point in enumerate(grid.nodes.tolist(), 1):
        ops.node(tag, *point)
    for tag in (grid.supported + 1).tolist():
        ops.fix(tag, 1, 1, 1, 0, 0, 0)
    sizes, section = np.unique(grid.thickness, return_inverse=True)
    for tag, size in enumerate(sizes.tolist(), 1):
        ops.section("ElasticMembranePlateSection", tag, grid.youngs_modulus,
                    grid.poissons_ratio, size, 0.0)  # fmt: skip
    rows = zip((grid.elements + 1).tolist(), (section + 1).tolist(), strict=True)
    for tag, (nodes, own) in enumerate(rows, 1):
        ops.element(element, tag, *nodes, own, *flags)


def prepare_linear(ops: Any, system: str = SYSTEM) -> None:
    """Set up first-order analysis with one factorisation for all loads."""
    ops.constraints("Plain")
    ops.numberer("RCM" if system != "UmfPack" else "Plain")
    ops.system(system)
    ops.algorithm("Linear", "-factorOnce")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")


def solve_columns(ops: Any, grid: ShellGrid, steps: int = 1) -> Iterable[int]:
    """Solve for one column of forces after the other; yields its number while it acts."""
    free = grid.free
    for number in range(grid.forces.shape[2]):
        ops.timeSeries("Linear", number + 1)
        ops.pattern("Plain", number + 1, number + 1)
        columns = grid.forces[free, :, number].tolist()
        for tag, force in zip((free + 1).tolist(), columns, strict=True):
            ops.load(tag, *force, 0.0, 0.0, 0.0)
        ops.setTime(0.0)
        if ops.analyze(steps) != 0:
            raise ArithmeticError("OpenSees did not converge")
        yield number
        ops.remove("loadPattern", number + 1)


def list_opensees_values(model: Model, subdivisions: int) -> dict[str, dict[str, float]]:
    """First-order displacements and work of each compared combination on n x n triangles."""
    ops = open_opensees()
    grid = divide_facets(model, subdivisions)
    enter_shell(ops, grid)
    prepare_linear(ops)
    names, result = list(model.compared_combinations), {}
    for number in solve_columns(ops, grid):
        moved = np.array([ops.nodeDisp(tag)[:3] for tag in range(1, len(grid.nodes) + 1)])
        result[names[number]] = {
            "displacement_down_max_m": float(-moved[:, 2].min()),
            "displacement_max_m": float(np.sqrt((moved**2).sum(axis=1).max())),
            "work_knm": float((moved * grid.forces[..., number]).sum()),
        }
    ops.wipe()
    return result


def list_rows(
    design: str, primary: Code, opensees: Code, subdivisions: Sequence[int]
) -> list[dict[str, Any]]:
    """One row per combination and quantity: both limits, their difference, OpenSees' meshes."""
    rows = []
    for combination, values in opensees.values.items():
        for name, meshes in values.items():
            limit, aim = (code.limit(combination, name)[0] for code in (primary, opensees))
            row = {"design": design, "combination": combination, "quantity": name}
            row |= {"unit": KINDS[name][1], "primary": limit, "opensees": aim}
            row["relative_difference"] = aim / limit - 1
            rows.append(
                row | {f"opensees_n{n}": v for n, v in zip(subdivisions, meshes, strict=True)}
            )
    return rows
