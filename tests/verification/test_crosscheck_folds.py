"""The six folded cases: thin folded sheets, where the mesh decides everything."""

import pytest

from crosscheck.analysis import analyse_model, list_values
from crosscheck.extrapolation import ORDER, extrapolate
from crosscheck.model import read_model
from crosscheck_models import SIX_CASES, describe_folded_case, write_model

pytestmark = [pytest.mark.verification, pytest.mark.slow]


@pytest.mark.parametrize(("surface", "support", "thickness", "limit_mm", "energy"), SIX_CASES)
def test_folded_case(tmp_path, surface, support, thickness, limit_mm, energy):
    """Largest downward displacement and work under S2 against the limits of two other families.

    Measured: 0.7 % at most from the limits when extrapolated, 2.1 % on the finer mesh alone.
    The limits themselves are bracketed to about 1 %, so 1.5 % and 4 % are asked for.
    """
    data = describe_folded_case(surface, support, thickness)
    model = read_model(write_model(tmp_path / "model.json", data))
    runs = [list_values(analyse_model(model, m))["S2"] for m in (2, 3)]
    for name, limit in (("displacement_down_max_m", limit_mm / 1e3), ("work_knm", 2 * energy)):
        values = [run[name] for run in runs]
        assert extrapolate([2, 3], values, ORDER) == pytest.approx(limit, rel=0.015)
        assert values[1] == pytest.approx(limit, rel=0.04)
    for run in runs:
        for reaction, load in zip(run["reaction_sum_kn"], run["load_sum_kn"], strict=True):
            assert reaction + load == pytest.approx(0, abs=1e-6 * abs(run["load_sum_kn"][2]))
