"""Both codes on one sheet with directions, a clamp, springs on edges and at a vertex.

Extrapolated values within the tolerances of the cross-check (4 % in displacement and work, 8 % in
utilization and buckling factor), reactions by support to 1e-4 of the load, sums to 1e-6.
"""

import json

import numpy as np
import pytest

import compare
from export_cases import stage_settings
from foldshell.exchange.neutral_model import make_neutral_model
from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target, measure_turning
from foldshell.loads.cases import make_load_cases
from foldshell.pattern.design import design_sheet
from foldshell.records.arrays import list_arrays
from foldshell.records.files import write_record
from foldshell.results.mesh_convergence import study_mesh
from foldshell.settings.fold import Fold
from foldshell.settings.support_row import SupportRow
from foldshell.shell.mesh_files import mesh_folded_sheet

ROWS = (
    SupportRow("root", "zigzag=first", "xyz", True),
    SupportRow("soft", "zigzag=last", "y", False, (3e3, 0.0, 2e4)),
    SupportRow("rollers", "strip=first", "z"),
    SupportRow("post", "vertices 40", "", False, (0.0, 0.0, 500.0)),
)


@pytest.mark.verification
def test_both_codes_agree_on_a_set_of_supports(tmp_path):
    target = make_target("paraboloid", 28, 10)
    sheet = design_sheet("miura", target.section_lengths(), 9, 8, 65.0,
                         turning=measure_turning(target))  # fmt: skip
    folded = list_arrays(folded_arrays(sheet, fold_sheet(sheet, target, "elastic", Fold())))
    settings, thickness = stage_settings(), np.full(56, 0.12)
    chosen = {name: settings.combinations.all[name] for name in ("S2", "D2")}
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    study = study_mesh(folded, ROWS, thickness, 4, settings.material, cases, chosen)
    write_record(tmp_path / "primary.json", study)
    mesh = mesh_folded_sheet(folded, ROWS, 4)
    compared = {"strength": ["S2"], "deflection": ["D2"]}
    model = make_neutral_model("sheet", mesh, thickness, settings, compared, {})
    (tmp_path / "model.json").write_text(json.dumps(model))
    paths = [tmp_path / name for name in ("model.json", "primary.json", "out.json", "out.xlsx")]
    compare.main(*paths, subdivisions=(2, 4), solver="multifrontal")
    found = json.loads(paths[2].read_text())
    assert found["pass"] is True
    balance = [v for k, v in found["quantities"].items() if k.endswith("reaction_imbalance")]
    assert len(balance) == 4
    assert all(max(v["primary"], v["independent"]) < 1e-6 for v in balance)
