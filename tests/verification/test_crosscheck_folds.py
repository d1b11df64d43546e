"""The six folded cases: thin folded sheets, where the mesh decides everything."""

import numpy as np
import pytest

from crosscheck.analysis import analyse_model, list_values
from crosscheck.extrapolation import ORDER, extrapolate
from crosscheck.model import read_model
from crosscheck_models import SIX_CASES, describe_folded_case, write_model

pytestmark = [pytest.mark.verification, pytest.mark.slow]


@pytest.mark.parametrize(("surface", "support", "thickness", "limit_mm", "energy"), SIX_CASES)
def test_folded_case(tmp_path, surface, support, thickness, limit_mm, energy):
    """Largest downward displacement and work under S2 against the limits of two other families.

    Measured, largest of the six: 1.6 % on m = 2 alone; extrapolated from m = 1 and 2 1.9 %, from
    2 and 3 1.0 %. The limits themselves are bracketed to about 1 %, which is added.
    """
    data = describe_folded_case(surface, support, thickness)
    model = read_model(write_model(tmp_path / "model.json", data))
    runs = [list_values(analyse_model(model, m))["S2"] for m in (1, 2, 3)]
    for name, limit in (("displacement_down_max_m", limit_mm / 1e3), ("work_knm", 2 * energy)):
        values = [run[name] for run in runs]
        assert values[1] == pytest.approx(limit, rel=0.025)
        assert extrapolate([1, 2], values[:2], ORDER) == pytest.approx(limit, rel=0.03)
        assert extrapolate([2, 3], values[1:], ORDER) == pytest.approx(limit, rel=0.02)
    for run in runs:
        unbalance = np.add(run["reaction_sum_kn"], run["load_sum_kn"])
        assert np.linalg.norm(unbalance) < 1e-6 * np.linalg.norm(run["load_sum_kn"])
