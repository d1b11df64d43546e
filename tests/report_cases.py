"""Files of a small design as rule page reads them."""

import json
import re

import numpy as np
from PIL import Image

from figure_cases import COMBINATIONS, PANELS, write_case
from foldshell.files.whole import write_arrays
from foldshell.records.files import write_record
from foldshell.records.history import HistoryRow
from foldshell.records.table import write_rows
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from record_cases import (
    make_classes,
    make_comparison,
    make_convergence,
    make_engineering,
    make_quality,
    make_quantity,
)

DESIGN = {"design": "case", "pattern": "miura", "surface": "paraboloid", "span_m": 5.0,
          "height_m": 2.0, "zigzag": 5, "strip": 6, "support": "strip", "fold_mode": "elastic",
          "edge_beam_depth_m": 0.0, "edge_beam_thickness_m": 0.0,
          "tags": "one,two"}  # fmt: skip
SETTINGS = stage_parameters(make_settings({}), "size") | {"combinations": COMBINATIONS}


def write_files(folder, classes=True, comparison=None, history=True, edited=None, **options):
    """Write all inputs of rule page; return them by name, and the pictures by name."""
    folder.mkdir(exist_ok=True)
    mesh, folded, arrays, final, _ = write_case(folder, **options)
    numbers = {"panel_class": np.arange(PANELS) % 2 + 1, "thickness": np.full(PANELS, 0.1)}
    write_iterations(folder / "iterations.npz")
    write_arrays(folder / "classes.npz", numbers if classes else {})
    groups = [(0.1, 10, 9.0)] * 2 if classes else []
    write_record(folder / "classes.json", make_classes(groups))
    write_record(folder / "quality.json", make_quality(planarity_max=0.02))
    write_record(folder / "study.json", make_convergence({"S2": {"work_knm": 0.03}}))
    quantities = {"S2 work_knm": make_quantity()}
    write_record(folder / "comparison.json", comparison or make_comparison(False, quantities))
    write_record(folder / "engineering.json", make_engineering(verdict="fails", reason="tension"))
    shared = {"verdict": "continue", "reason": "", "second_order_iterations": 3}
    rows = [HistoryRow(iteration=0, volume_m3=2.0, **shared)]
    if history:
        limit = {"displacement_limit_m": 0.02} | shared
        rows = [
            HistoryRow(iteration=0, volume_m3=2.0, utilization_panel_mean_max=0.4,
                       displacement_vertical_max_m=0.01, **limit),
            HistoryRow(iteration=1, volume_m3=1.8, displacement_vertical_max_m=0.011,
                       edited_panels=edited, **limit),
        ]  # fmt: skip
    write_rows(folder / "history.csv", HistoryRow, rows)
    pictures = {name: folder / f"{name}.png" for name in ("principal_stress_lines", "utilization")}
    for path in pictures.values():
        Image.new("RGB", (400, 300), "teal").save(path)
    paths = {"mesh": mesh, "folded": folded, "arrays": arrays, "final": final}
    names = {"class_arrays": "classes.npz", "classes": "classes.json", "quality": "quality.json",
             "mesh_convergence": "study.json", "comparison": "comparison.json",
             "history": "history.csv", "iterations": "iterations.npz",
             "engineering": "engineering.json"}  # fmt: skip
    return paths | {key: folder / name for key, name in names.items()}, pictures


def write_iterations(path):
    """Write two iterations, the second 10 mm thinner in all panels."""
    thickness = np.linspace(0.05, 0.15, PANELS)
    both = {"thickness": np.stack([thickness, thickness - 0.01])}
    write_arrays(path, both | {"utilization_panel_mean": np.full((2, PANELS), 0.4)})


def read_data(page):
    """Return what stands in the page's data scripts: facts, and the packed arrays as text."""
    facts = re.search(r'<script type="application/json" id="facts">(.*?)</script>', page, re.S)
    packed = re.search(r'<script type="text/plain" id="arrays">(.*?)</script>', page, re.S)
    return json.loads(facts[1]), packed[1].strip()
