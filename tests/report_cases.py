"""Files of a small design as rule page reads them."""

import json
import re

import numpy as np
from PIL import Image

from figure_cases import COMBINATIONS, PANELS, write_case
from foldshell.files.whole import write_arrays, write_json
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters

DESIGN = {"design": "case", "pattern": "miura", "surface": "paraboloid", "span_m": 5.0,
          "height_m": 2.0, "zigzag": 5, "strip": 6, "support": "strip", "fold_mode": "elastic",
          "edge_beam_depth_m": 0.0, "edge_beam_thickness_m": 0.0,
          "tags": "one,two"}  # fmt: skip
SETTINGS = stage_parameters(make_settings({}), "size") | {"combinations": COMBINATIONS}
QUANTITY = {"primary": 0.1, "independent": 0.11, "relative_difference": 0.09, "tolerance": 0.05,
            "pass": False}  # fmt: skip


def write_files(folder, classes=True, comparison=None, history=True, **options):
    """Write all inputs of rule page; return them by name, and the pictures by name."""
    folder.mkdir(exist_ok=True)
    mesh, folded, arrays, final, _ = write_case(folder, **options)
    numbers = {"panel_class": np.arange(PANELS) % 2 + 1, "thickness": np.full(PANELS, 0.1)}
    write_arrays(folder / "classes.npz", numbers if classes else {})
    groups = [{"class": k, "thickness_m": 0.1, "panels": 10, "area_m2": 9.0} for k in (1, 2)]
    write_json(folder / "classes.json", {"verdict": "holds", "reason": "all criteria are met",
               "classes": groups if classes else [], "added_volume_relative": 0.12})  # fmt: skip
    write_json(folder / "quality.json", {"state": "ok", "reason": "", "planarity_max": 0.02})
    write_json(folder / "study.json", {"errors": {"S2": {"work_knm": 0.03}}})
    comparison = comparison or {"pass": False, "quantities": {"S2 work_knm": QUANTITY}}
    write_json(folder / "comparison.json", comparison)
    rows = ["volume_m3,utilization_panel_mean_max,displacement_vertical_max_m,displacement_limit_m"]
    rows += ["2.0,0.4,0.01,0.02", "1.8,,0.011,0.02"] if history else ["2.0,,,"]
    (folder / "history.csv").write_text("\n".join(rows) + "\n")
    pictures = {name: folder / f"{name}.png" for name in ("principal_stress_lines", "utilization")}
    for path in pictures.values():
        Image.new("RGB", (400, 300), "teal").save(path)
    paths = {"mesh": mesh, "folded": folded, "arrays": arrays, "final": final}
    names = {"class_arrays": "classes.npz", "classes": "classes.json", "quality": "quality.json",
             "mesh_convergence": "study.json", "comparison": "comparison.json",
             "history": "history.csv"}  # fmt: skip
    return paths | {key: folder / name for key, name in names.items()}, pictures


def read_data(page):
    """Return what stands in the page's data scripts: facts, and the packed arrays as text."""
    facts = re.search(r'<script type="application/json" id="facts">(.*?)</script>', page, re.S)
    packed = re.search(r'<script type="text/plain" id="arrays">(.*?)</script>', page, re.S)
    return json.loads(facts[1]), packed[1].strip()
