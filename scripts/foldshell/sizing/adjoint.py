"""Derivatives of an analysed state with respect to the thickness of each element.

K = E (t K_m + t^3 K_b) and a self-weight in proportion to t: dK/dt u costs two products of
resultants, no new matrix.
"""

from dataclasses import dataclass, replace

import numpy as np

from foldshell.settings.material import Material
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.geometric import geometric_tables
from foldshell.shell.linear_solver import Factor, factorise
from foldshell.shell.reference import reference_triangle
from foldshell.shell.stress import StressResultants, internal_forces, stress_resultants


@dataclass(frozen=True)
class AdjointModel:
    """A state (displacements and resultants of c combinations) and the factor of its K.

    `thickness` (E,) m; `load_slope` (E, 3, c) kN/m3 is how the load of each combination on an
    element grows with its thickness.
    """

    model: ShellModel
    result: AnalysisResult
    resultants: StressResultants
    thickness: np.ndarray
    material: Material
    load_slope: np.ndarray
    factor: Factor

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Return K^-1 of right-hand sides (dofs, k), zero at supports."""
        solution = np.zeros_like(right)
        dofs = self.model.pattern.dofs
        if right.shape[1]:
            solution[dofs] = self.factor.solve(right[dofs])
        return solution

    def push(self, force: np.ndarray, moment: np.ndarray | None = None) -> np.ndarray:
        """Return dg/du (dofs, k) of g = sum force . eps + moment . kappa, (E, 3, m, k) each."""
        operators = self.model.operators
        area = operators.geometry.area[:, None, None, None]
        moment = np.zeros_like(force) if moment is None else moment
        jump = np.zeros((*operators.slope_spring.shape, force.shape[3]))
        return internal_forces(operators, StressResultants(force / area, moment / area, jump))

    def implicit(self, adjoint: np.ndarray, combination: np.ndarray) -> np.ndarray:
        """a^T (dF/dt - dK/dt u), (E, k) for adjoints a (dofs, k) of one combination (k,) each."""
        operators, mesh = self.model.operators, self.model.mesh
        if adjoint.shape[1] == 0:
            return np.empty((len(self.thickness), 0))
        membrane, bending = self.virtual_work(adjoint, combination)
        nodes = mesh.elements.shape[1]
        local = adjoint[operators.dofs[:, : 3 * nodes]].reshape(len(membrane), nodes, 3, -1)
        moved = np.einsum("n,enxk->exk", reference_triangle(mesh.order).load, local)
        weight = (moved * self.load_slope[..., combination]).sum(axis=1)
        stiffness = (membrane + 3 * bending) / self.thickness[:, None]
        return weight * operators.geometry.area[:, None] - stiffness

    def virtual_work(
        self, displacement: np.ndarray, column: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Work of the state's membrane forces and moments of columns (k,) on displacements
        (dofs, k): (E, k) kNm each. D eps = `force` of unit thickness and unit modulus."""
        operators = self.model.operators
        area = operators.geometry.area[:, None]
        unit = stress_resultants(operators, displacement, np.ones(len(area)), 1.0)
        compliance = np.linalg.inv(operators.elasticity)
        force, moment = (
            np.einsum("ab,ebmk->eamk", compliance, part, optimize=True)[..., column]
            for part in (self.resultants.force, self.resultants.moment)
        )
        jump = (self.resultants.jump / operators.slope_spring[:, :, None])[..., column]
        membrane = area * (unit.force * force).sum((1, 2))
        bending = 12 * area * (unit.moment * moment).sum((1, 2)) + (unit.jump * jump).sum(1)
        return membrane, bending

    def sum_panels(self, elements: np.ndarray) -> np.ndarray:
        """Sum (E, k) over the elements of each panel: (k, P). In the unit of what is summed."""
        panel = self.model.mesh.panel
        total = [np.bincount(panel, column) for column in elements.T]
        return np.array(total).reshape(-1, int(panel.max()) + 1)

    def buckling_slope(self, column: int) -> np.ndarray:
        """d lambda / dt (E,) of (K + lambda K_g(N)) x = 0 for a single factor lambda.

        d lambda = x^T (dK + lambda dK_g) x / (-x^T K_g x); N = t E D eps(u) changes by t and by u.

        In 1/m.
        """
        operators, one = self.model.operators, np.zeros(1, dtype=np.int64)
        modulus, t = self.material.youngs_modulus, self.thickness
        imposed = self.result.imposed
        imposed = None if imposed is None else imposed[..., [column]]
        moved = self.result.first_order[:, [column]]
        first = stress_resultants(operators, moved, t, modulus, imposed)
        linear = replace(self, resultants=first, load_slope=self.load_slope[..., [column]])
        mode = np.zeros((len(self.model.pattern.free), 1))
        mode[self.model.pattern.free, 0] = self.result.buckling.modes[:, column]
        own = replace(self, resultants=stress_resultants(operators, mode, t, modulus))
        membrane, bending = own.virtual_work(mode, one)
        per_force = _geometric_work(operators, mode)
        work = (per_force * first.force).sum((1, 2, 3))
        per_strain = np.einsum("ab,ebmk->eamk", modulus * operators.elasticity, per_force)
        adjoint = self.solve(self.push(per_strain * t[:, None, None, None]))
        change = work / t + linear.implicit(adjoint, one)[:, 0]
        stiffness = ((membrane + 3 * bending) / t[:, None])[:, 0]
        return (stiffness + self.result.buckling.factors[column] * change) / -work.sum()


def open_adjoint(
    model: ShellModel,
    result: AnalysisResult,
    thickness: np.ndarray,
    material: Material,
    load_slope: np.ndarray,
    solver: str = "cholmod",
) -> AdjointModel:
    """Factorise K once more for the adjoint solves of a state.

    Parameters
    ----------
    thickness : (E,) m
    load_slope : (E, 3, c) kN/m3, change of the loads of combinations with thickness
    """
    modulus = material.youngs_modulus
    values = assemble_stiffness(model.operators, model.pattern, thickness, modulus)
    resultants = stress_resultants(
        model.operators, result.displacement, thickness, modulus, result.imposed
    )
    factor = factorise(model.pattern, values, solver)
    return AdjointModel(model, result, resultants, thickness, material, load_slope, factor)


def _geometric_work(operators, mode: np.ndarray) -> np.ndarray:
    """Return d(x^T K_g x)/dN, (E, 3, m, 1), for a mode x (dofs, 1)."""
    tables, geometry = geometric_tables(operators.mesh.order), operators.geometry
    count, nodes = operators.mesh.elements.shape
    local = mode[operators.dofs[:, : 3 * nodes], 0].reshape(count, nodes, 3)
    reference = np.matmul(tables.slope, local).reshape(count, 2, -1, 3)
    first, second = np.einsum("ekqx,eka->aeqx", reference, geometry.inverse, optimize=True)
    products = [(first**2).sum(-1), (second**2).sum(-1), 2 * (first * second).sum(-1)]
    work = np.einsum("ceq,e,qm->ecm", np.stack(products), geometry.area, tables.psi, optimize=True)
    return work[..., None]
