"""Cost of second order and of one sizing iteration, and what they are measured against."""

import time

import numpy as np
from scipy.sparse import csr_array

from foldshell.checks.utilization import compute_utilization
from foldshell.loads.cases import combination_matrix, make_load_cases, surface_loads
from foldshell.settings.loads import Loads
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.geometric import apply_geometric, geometric_tables, pull_back
from foldshell.shell.linear_solver import factorise
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.second_order import solve_second_order
from foldshell.shell.stress import membrane_forces
from verification.folded_cases import CONCRETE, load_sheet

COMBINATIONS = {
    "S1": {"SW": 1.4, "SDL": 1.4},
    "S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5},
    "S3": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WY": 0.5},
    "S4": {"SW": 1.2, "SDL": 1.2, "LL": 1.0, "WX": 1.0},
    "S5": {"SW": 1.2, "SDL": 1.2, "LL": 1.0, "WY": 1.0},
    "D1": {"SW": 1.0, "SDL": 1.0},
    "D2": {"SW": 1.0, "SDL": 1.0, "LL": 1.0},
    "D3": {"SW": 1.0, "SDL": 1.0, "WX": 1.0},
}


class Clock:
    """CPU and wall seconds since it was made."""

    def __init__(self) -> None:
        self._cpu, self._wall = time.process_time(), time.perf_counter()

    def read(self) -> tuple[float, float]:
        return time.process_time() - self._cpu, time.perf_counter() - self._wall


class Problem:
    """A folded case on one mesh, with its factor and the loads of eight combinations."""

    def __init__(self, case, n: int, solver: str) -> None:
        arrays = mesh_folded_sheet(load_sheet(case.sheet), case.support, n)
        self.mesh = mesh_from_arrays(arrays)
        self.model = build_model(self.mesh, arrays["supported_nodes"], CONCRETE.poissons_ratio)
        self.thickness = np.full(len(self.mesh.elements), case.thickness)
        self.modulus, self.solver = CONCRETE.youngs_modulus, solver
        self.operators, self.pattern = self.model.operators, self.model.pattern
        normal = self.operators.geometry.frame[:, 2]
        surface = surface_loads(
            normal, self.thickness, make_load_cases(Loads(), CONCRETE.unit_weight)
        )
        cases = nodal_forces(self.operators, surface)
        self.forces = (cases @ combination_matrix(COMBINATIONS))[self.pattern.dofs]
        self.values = assemble_stiffness(self.operators, self.pattern, self.thickness, self.modulus)
        self.factor = factorise(self.pattern, self.values, solver)

    def membrane(self, reduced):
        """Return N and the full displacements of free ones (size, c)."""
        full = np.zeros((self.mesh.dof_count, reduced.shape[1]))
        full[self.pattern.dofs] = reduced
        return membrane_forces(self.operators, full, self.thickness, self.modulus), full

    def value(self, reduced) -> float:
        """Return the largest downward displacement of combination S2 (m)."""
        full = self.membrane(reduced[:, [1]])[1]
        return float(-full[2 : 3 * len(self.mesh.nodes) : 3].min())


def second_order_on_one_factor(problem: Problem):
    """Factorise once; all eight combinations by Anderson's method."""
    clock = Clock()
    problem.factor.refactor(problem.values)

    def correction(displacement, _columns):
        force, full = problem.membrane(displacement)
        push = apply_geometric(problem.operators, force, full)
        return -problem.factor.solve(push[problem.pattern.dofs])

    found = solve_second_order(problem.factor.solve(problem.forces), correction)
    return *clock.read(), problem.value(found.displacement)


def second_order_by_refactorising(problem: Problem, tolerance: float = 1e-8):
    """(K + K_g(N(u))) u = F, factorised anew at each step of each combination."""
    clock = Clock()
    answer = problem.factor.solve(problem.forces)
    for column in range(answer.shape[1]):
        change = 1.0
        while change > tolerance:
            force, _ = problem.membrane(answer[:, [column]])
            problem.factor.refactor(problem.values + packed_geometric(problem, force))
            moved = problem.factor.solve(problem.forces[:, [column]])[:, 0]
            change = np.abs(moved - answer[:, column]).max() / np.abs(moved).max()
            answer[:, column] = moved
    return *clock.read(), problem.value(answer)


def packed_geometric(problem: Problem, force):
    """Return K_g(N) as nonzeros of the pattern."""
    operators = problem.operators
    nodes = problem.mesh.elements.shape[1]
    product = geometric_tables(problem.mesh.order).product
    element = pull_back(operators, force)[..., 0].reshape(len(force), -1) @ product
    i, j = np.tril_indices(3 * nodes)
    same = np.flatnonzero(i % 3 == j % 3)
    a, b = i[same] // 3, j[same] // 3
    put = problem.pattern.put[:, same].ravel()
    values = element[:, a * (a + 1) // 2 + b].ravel()
    count = len(problem.values)
    return np.bincount(put, values, count + 1)[:count]


def sizing_iteration(problem: Problem):
    """Assembly, factor, factors of eight combinations, second order, utilization; warm start."""
    rng = np.random.default_rng(1)
    first = analyse_shell(
        problem.model,
        problem.thickness,
        CONCRETE,
        make_load_cases(Loads(), CONCRETE.unit_weight),
        COMBINATIONS,
    )
    changed = (
        problem.thickness
        * rng.choice([0.9, 1.0, 1.1], problem.mesh.panel.max() + 1)[problem.mesh.panel]
    )
    clock = Clock()
    result = analyse_shell(
        problem.model,
        changed,
        CONCRETE,
        make_load_cases(Loads(), CONCRETE.unit_weight),
        COMBINATIONS,
        start_modes=first.buckling.modes,
    )
    compute_utilization(problem.model, result.displacement[:, :5], changed, CONCRETE)
    return *clock.read(), float(result.buckling.factors.min())


def refactor_and_solve(problem: Problem):
    """The floor of an iteration: one numeric factor and one block of eight solutions."""
    clock = Clock()
    problem.factor.refactor(problem.values)
    answer = problem.factor.solve(problem.forces)
    return *clock.read(), problem.value(answer)


def pardiso_refactor_and_solve(problem: Problem):
    """The same by PARDISO, where pypardiso is installed."""
    from pypardiso import PyPardisoSolver

    size = problem.pattern.size
    upper = csr_array((problem.values, problem.pattern.indices, problem.pattern.indptr),
                      shape=(size, size))  # fmt: skip
    upper.indices, upper.indptr = upper.indices.astype(np.int32), upper.indptr.astype(np.int32)
    pardiso = PyPardisoSolver(mtype=2)
    pardiso.set_matrix_type(2)
    pardiso.factorize(upper)
    right = np.asfortranarray(problem.forces)
    clock = Clock()
    pardiso.set_phase(22)
    pardiso._call_pardiso(upper, np.zeros((size, 1)))
    pardiso.set_phase(33)
    answer = pardiso._call_pardiso(upper, right)
    cpu, wall = clock.read()
    return cpu, wall, problem.value(np.ascontiguousarray(answer))


TASKS = {
    "second_order8": second_order_on_one_factor,
    "second_order8_refactor_each": second_order_by_refactorising,
    "sizing_iteration": sizing_iteration,
    "refactor_solve8": refactor_and_solve,
    "refactor_solve8_pardiso": pardiso_refactor_and_solve,
}
