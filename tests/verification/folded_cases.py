"""Six thin folded sheets whose displacement and work are known from refined meshes.

The sheets in tests/data are 28 m x 10 m, 15 x 16 lines. The limits were bracketed by two element
families refined to 16 x 16 sub-triangles per facet; work is u.F / 2 under 1.2(SW+SDL)+1.6LL+0.5Wx.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.checks.strips import find_strips, utilization_of_strips
from foldshell.checks.utilization import area_percentile, compute_utilization
from foldshell.loads.cases import make_load_cases
from foldshell.settings.analysis import Analysis
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material
from foldshell.shell.analysis import analyse_shell, build_model
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays
from foldshell.shell.results import largest_downward
from foldshell.shell.stress import stress_resultants

DATA = Path(__file__).parents[1] / "data"
CONCRETE = Material("C25/30", 31e6, 0.2, 25.0, 16_700.0, 1_670.0)
COMBINATION = {"S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5}}


@dataclass(frozen=True)
class FoldedCase:
    """Sheet, supported edges, thickness (m), limits of displacement (mm) and work (kNm)."""

    sheet: str
    support: str
    thickness: float
    displacement_mm: float
    work_knm: float

    def __str__(self) -> str:
        return f"{self.sheet}-{self.support}-{1e3 * self.thickness:g}mm"


CASES = [
    FoldedCase("paraboloid", "strip", 0.05, 370, 198),
    FoldedCase("arch", "strip", 0.05, 301.5, 147.5),
    FoldedCase("hypar", "zigzag", 0.05, 362, 151.5),
    FoldedCase("arch", "zigzag", 0.08, 228.2, 105.5),
    FoldedCase("paraboloid", "zigzag", 0.12, 108, 134.1),
    FoldedCase("hypar", "all", 0.12, 8.85, 11.2),
]


def load_sheet(name: str) -> dict[str, np.ndarray]:
    """Return a sheet in the form of folded.npz: facets counter-clockwise seen from above."""
    with np.load(DATA / f"{name}_28_10_15x16_paper.npz") as data:
        arrays = {key: data[key] for key in data.files}
    facets = arrays["triangles"]
    corner = arrays["vertices"][facets]
    up = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, 2]
    arrays["facets"] = np.where((up < 0)[:, None], facets[:, ::-1], facets)
    return arrays


def analyse_case(case: FoldedCase, subdivisions: int, order: int | None = None) -> dict[str, float]:
    """Return displacement (mm), work (kNm), p99 utilization and the number of freedoms."""
    arrays = mesh_folded_sheet(load_sheet(case.sheet), case.support, subdivisions, order)
    mesh = mesh_from_arrays(arrays)
    model = build_model(mesh, arrays["supported_nodes"], CONCRETE.poissons_ratio)
    thickness = np.full(len(mesh.elements), case.thickness)
    result = analyse_shell(
        model,
        thickness,
        CONCRETE,
        make_load_cases(Loads(), CONCRETE.unit_weight),
        COMBINATION,
        Analysis(second_order=False),
    )
    used = compute_utilization(model, result.displacement, thickness, CONCRETE)
    resultants = stress_resultants(
        model.operators, result.displacement, thickness, CONCRETE.youngs_modulus
    )
    strips = find_strips(model.operators, 0.3)
    return {
        "utilization_strip_max": float(
            utilization_of_strips(strips, resultants, thickness, CONCRETE).max()
        ),
        "displacement_mm": 1e3 * largest_downward(model, result.displacement, ["S2"])[0],
        "work_knm": float((result.displacement * result.loads).sum() / 2),
        "utilization_p99": area_percentile(model, used.point),
        "dofs": model.pattern.size,
    }
