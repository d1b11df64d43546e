"""What the checks of a concrete shell need of its geometry: built once, for any thickness."""

from dataclasses import dataclass, replace

import numpy as np

from foldshell.checks.concrete.layout import Layout, lay_out
from foldshell.checks.concrete.sampling import Sampling, sample_strips
from foldshell.checks.strips import find_strips
from foldshell.settings.reinforcement import Reinforcement
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.stiffness import ShellOperators


@dataclass(frozen=True)
class ConcreteModel:
    """Geometry, points and strips of a shell with `panels` sized ones, and what lies in it.

    `local` are the strips of steel and struts, `shear` those of shear; `area` (P,) m2;
    `edge` (S, 2) vertices of the strips of `local`, and `shear_edge` of the others.
    """

    operators: ShellOperators
    panels: int
    asked: Reinforcement
    layout: Layout
    local: Sampling
    shear: Sampling
    area: np.ndarray
    edge: np.ndarray
    shear_edge: np.ndarray

    @property
    def mesh(self) -> ShellMesh:
        """The shell mesh."""
        return self.operators.mesh


def build_concrete_model(
    operators: ShellOperators, panels: int, asked: Reinforcement, strip_width: float
) -> ConcreteModel:
    """Weigh the points of all strips; `strip_width` in m, `panels` of which thickness is sized."""
    strips = find_strips(operators, strip_width, asked.diagonals)
    wide = find_strips(operators, asked.shear_strip_width, False)
    local = sample_strips(operators, strips, strip_width)
    shear = sample_strips(operators, wide, asked.shear_strip_width)
    area = np.bincount(operators.mesh.panel, operators.geometry.area)[:panels]
    return ConcreteModel(
        operators, panels, asked, lay_out(asked), local,
        replace(shear, angle=local.angle), area, strips.edge, wide.edge,
    )  # fmt: skip
