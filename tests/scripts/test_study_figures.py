"""Rules study_figures: charts, and all_designs: pages, from result folders."""

import json

import numpy as np
from PIL import Image

import all_designs
import study_figures
from figure_cases import COMBINATIONS, write_case
from foldshell.figures.study_data import NUMBERS
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from record_cases import make_summary

SETTINGS = stage_parameters(make_settings({}), "size") | {"combinations": COMBINATIONS}
FILES = ("shell/mesh.npz", "folded/folded.npz", "sizing/final.npz", "sizing/final.json",
         "sizing/classes.npz")  # fmt: skip


def write_results(folder, **designs):
    """Write result folders by design name and the summary that lists them."""
    rows = []
    for name, options in designs.items():
        (folder / name).mkdir()
        for path, place in zip(write_case(folder / name, **options), FILES, strict=True):
            (folder / name / place).parent.mkdir(exist_ok=True)
            path.rename(folder / name / place)
        numbers = dict.fromkeys(NUMBERS, 1.0) | {"zigzag": 1, "strip": 1}
        row = make_summary(design=name, tags="supports", surface="arch", support=name, **numbers)
        rows.append(row)
    write_rows(folder / "summary.csv", SummaryRow, rows)


def test_all_figures_are_written(tmp_path):
    """Also with a design without utilization, and for comparisons that nobody is in."""
    write_results(tmp_path, all={}, strip={"utilization": None, "move": lambda x: np.nan * x})
    charts = {n: [tmp_path / f"{n}.png", tmp_path / f"{n}.svg"] for n in study_figures.CHARTS}
    sheets = {name: tmp_path / f"{name}.png" for name in ("all_thickness", "all_utilization")}
    study_figures.main(tmp_path / "summary.csv", tmp_path, charts, settings=SETTINGS)
    tiles = tmp_path / "tiles.json"
    all_designs.main(tmp_path / "summary.csv", tmp_path, sheets, tiles, settings=SETTINGS)
    found = json.loads(tiles.read_text())
    assert {name: list(sheet["pictures"]) for name, sheet in found.items()} == {
        "thickness": ["all", "strip"], "utilization": ["all", "strip"]
    }  # fmt: skip
    assert found["utilization"]["scale"]["limit"] == 1.0
    for paths in charts.values():
        assert all(path.stat().st_size > 1000 for path in paths)
    page = np.asarray(Image.open(sheets["all_thickness"]))
    assert page.shape[1] == 6 * 400
    tiles = page[90 + 58 : 90 + 58 + 270]
    for k in range(6):
        ink = (tiles[:, 400 * k : 400 * (k + 1)] < 250).any(axis=-1).mean()
        assert ink > 0.1 if k < 2 else ink == 0
