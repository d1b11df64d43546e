"""A small folded sheet and the settings of the sizing loop, for the tests of its entry scripts."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.settings.config_file import read_config
from foldshell.settings.make import make_settings
from foldshell.settings.stage import StageSettings, read_stage
from foldshell.settings.stages import STAGES, stage_parameters
from foldshell.shell.mesh_files import mesh_folded_sheet, write_mesh

CONFIG = Path(__file__).parents[1] / "config" / "config.yaml"
ZIGZAG, STRIP = 4, 5
PANELS = (ZIGZAG - 1) * (STRIP - 1)
SPAN = 6.0
DESIGN = {
    "design": "small", "tags": "", "pattern": "miura", "surface": "paraboloid", "span_m": SPAN,
    "height_m": 1.0, "zigzag": ZIGZAG, "strip": STRIP, "support": "all", "fold_mode": "elastic",
    "edge_beam_depth_m": 0.0, "edge_beam_thickness_m": 0.0,
}  # fmt: skip


def corrugated_sheet() -> dict[str, np.ndarray]:
    """Return the arrays of folded.npz: strips fold up and down by 0.5 m, zig-zags are skewed."""
    zigzag, strip = (index.ravel() for index in np.indices((ZIGZAG, STRIP)))
    x = SPAN * strip / (STRIP - 1)
    y = SPAN * zigzag / (ZIGZAG - 1) + 0.3 * (strip % 2)
    vertices = np.column_stack([x, y, 0.5 * (strip % 2) + 0.1 * zigzag * (3 - zigzag)])
    first = np.arange(ZIGZAG * STRIP).reshape(ZIGZAG, STRIP)[:-1, :-1].ravel()
    quads = np.column_stack([first, first + 1, first + STRIP + 1, first + STRIP])
    facets = np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    return {
        "vertices": vertices, "quads": quads, "facets": facets, "zigzag": zigzag, "strip": strip,
        "flat": vertices * [1, 1, 0], "planarity": np.zeros(PANELS), "strain": np.zeros(2 * PANELS),
    }  # fmt: skip


def write_small_mesh(path: Path, support: str = "all") -> Path:
    """Write mesh.npz of the corrugated sheet with two subdivisions."""
    write_mesh(path, mesh_folded_sheet(corrugated_sheet(), support, 2))
    return path


@cache
def _settings():
    return make_settings(read_config(CONFIG), str(CONFIG))


def stage(name: str, **sizing: Any) -> dict[str, Any]:
    """Return the plain settings of a stage at their defaults; `sizing` replaces some of them."""
    values = stage_parameters(_settings(), name)
    known = {key: value for key, value in sizing.items() if key in values.get("sizing", {})}
    return values | ({"sizing": values["sizing"] | known} if "sizing" in values else {})


def given(name: str, **sizing: Any) -> StageSettings:
    """Return the typed settings of a stage at their defaults; `sizing` replaces some of them."""
    return read_stage(stage(name, **sizing), *STAGES[name])
