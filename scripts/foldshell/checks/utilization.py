"""Utilization of a state of stress: at points, in cells, as means of panels."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.strength import CRITERIA
from foldshell.files.threads import divide_rows, run_parts
from foldshell.settings.material import Material
from foldshell.shell.analysis import ShellModel
from foldshell.shell.results import panel_area
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import outer_stresses, sample_basis, sample_points, stress_resultants

ELEMENTS = 512
"""Elements of a large mesh whose stresses stand in memory at once."""


@dataclass(frozen=True)
class Utilization:
    """Utilization, the largest over top, middle and bottom surface at each point.

    `point` (E, cells^2, s^2) is the largest over combinations at sample points, `combination`
    (c, E, cells^2, s^2) that of each; `cell` (E, cells^2) the mean of `point` over a result cell;
    `governing` (E, cells^2) the combination with the largest mean there.
    """

    point: np.ndarray
    combination: np.ndarray
    cell: np.ndarray
    governing: np.ndarray


def compute_utilization(
    model: ShellModel,
    displacement: np.ndarray,
    thickness: np.ndarray,
    material: Material,
    imposed: np.ndarray | None = None,
) -> Utilization:
    """Evaluate the strength criterion at the sample points of every result cell.

    Parameters
    ----------
    displacement : (dofs, c) m and rad, of the strength combinations
    thickness : (E,) m
    imposed : (E, 2, c or more) imposed strain and curvature (1/m) of these and further combinations
    """
    own = None if imposed is None else imposed[..., : displacement.shape[1]]
    combination = utilization_of_combinations(
        model.operators, displacement, thickness, material, own
    )
    point = combination.max(axis=0)
    governing = combination.mean(axis=3).argmax(axis=0)
    return Utilization(point, combination, point.mean(axis=2), governing)


def utilization_of_combinations(
    operators: ShellOperators,
    displacement: np.ndarray,
    thickness: np.ndarray,
    material: Material,
    imposed: np.ndarray | None = None,
) -> np.ndarray:
    """Return (c, E, cells^2, s^2): the criterion of each load column at the sample points.

    Parameters
    ----------
    displacement : (dofs, c) m and rad
    thickness : (E,) m
    imposed : (E, 2, c) imposed strain and curvature (1/m)
    """
    modulus = material.youngs_modulus
    resultants = stress_resultants(operators, displacement, thickness, modulus, imposed)
    points = sample_points(operators.mesh.cells)
    basis = sample_basis(operators.mesh.order, operators.mesh.cells)
    criterion = CRITERIA[material.criterion]
    combination = np.empty((displacement.shape[1], len(thickness), *points.shape[:2]))

    def evaluate(column: int) -> None:
        """Fill in the criterion of one combination at every point."""
        own = resultants.column(column)
        for some in divide_rows(len(thickness), operators.mesh.dof_count, ELEMENTS):
            stress = outer_stresses(own.elements(some), thickness[some], basis)[:, :, 0]
            value = criterion(np.moveaxis(stress, 1, -1), material).max(axis=0)
            combination[column, some] = value.reshape(-1, *points.shape[:2])

    list(run_parts(evaluate, range(displacement.shape[1])))
    return combination


def panel_utilization(model: ShellModel, cell: np.ndarray, measure: str) -> np.ndarray:
    """Return (P,): `panel_mean`, the area mean over the cells of a panel, or `element_max`.

    cell (E, cells^2) without unit, as are the results.
    """
    panel = model.mesh.panel
    if measure == "element_max":
        largest = np.zeros(panel.max() + 1)
        np.maximum.at(largest, panel, cell.max(axis=1))
        return largest
    area = model.operators.geometry.area
    return np.bincount(panel, cell.mean(axis=1) * area) / panel_area(model)


def area_percentile(model: ShellModel, point: np.ndarray, percent: float = 99.0) -> float:
    """Return the value that a share of the mesh area does not exceed.

    `point` (E, ...) holds equally weighted values of each element, or of the first ones only.
    """
    value = point.ravel()
    area = model.operators.geometry.area[: len(point)]
    weight = np.repeat(area, value.size // len(point))
    above = (1 - percent / 100) * weight.sum()
    # only the largest values are put in order: as many as hold that share of the area for certain
    count = min(value.size, int(above / weight.min()) + 2)
    largest = np.argpartition(value, value.size - count)[value.size - count :]
    order = largest[np.argsort(-value[largest], kind="stable")]
    share = np.cumsum(weight[order])
    return float(value[order][min(np.searchsorted(share, above, side="right"), count - 1)])
