"""Steel of each layer and direction in plan, with the way the bars run."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from foldshell.figures.charts import STYLE, TITLE_POINTS, draw_words
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.sheet_arrays import MeshArrays

LAYERS = {
    "RBX": "bottom or middle, x",
    "RBY": "bottom or middle, y",
    "RTX": "top, x",
    "RTY": "top, y",
}
LINE = 0.28
"""Length of a bar's line over the root of its panel's area."""


def draw_reinforcement(record: EngineeringRecord, mesh: MeshArrays) -> Figure:
    """Return four plans, bottom x and y, top x and y, with least steel, on one scale.

    `mesh` are the arrays of mesh.npz. A sentence where no reinforcement could be designed.
    """
    with plt.rc_context(STYLE):
        if record.reinforcement is None:
            return draw_words("Reinforcement: none was designed")
        values = {key: np.array(record.panels[f"as_{key}_cm2_m"]) for key in LAYERS}
        largest = max(one.max() for one in values.values())
        figure, axes = plt.subplots(2, 2, figsize=(10, 9.6), layout="constrained")
        for axis, (key, words) in zip(axes.ravel(), LAYERS.items(), strict=True):
            shown = _draw_layer(axis, record, mesh, values[key], largest, key[-1])
            most = values[key].max()
            size = f"up to {most:.1f} cm²/m" if most else "none"
            axis.set_title(f"{key}: {words}, {size}", fontsize=12)
        figure.colorbar(shown, ax=axes, label="steel [cm²/m]", shrink=0.7)
        total = record.reinforcement
        figure.suptitle(
            f"Reinforcement ({total.kind.replace('_', ' ')}): {total.steel_kg_m2:.1f} kg/m², "
            f"{total.steel_kg_m3:.0f} kg/m³",
            fontsize=TITLE_POINTS, fontweight="bold",
        )  # fmt: skip
        return figure


def _draw_layer(axis, record, mesh: MeshArrays, values, largest: float, direction: str):
    own = mesh.facet_panel < len(values)
    corners = mesh.vertices[mesh.facets[own], :2]
    shown = PolyCollection(corners, array=values[mesh.facet_panel[own]], cmap="cividis_r",
                           clim=(0, largest))  # fmt: skip
    axis.add_collection(shown)
    middle, along = find_bar_lines(record, direction)
    steel = values > 0
    ends = np.stack([middle - along, middle + along], axis=1)[steel]
    axis.add_collection(LineCollection(ends, colors="#b2182b", linewidths=1.0))
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.set_axis_off()
    return shown


def find_bar_lines(record: EngineeringRecord, direction: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the middle and half the line of the bars of each panel in plan, both (P, 2) m."""
    panels = record.panels
    middle = np.column_stack([panels["centroid_x_m"], panels["centroid_y_m"]])
    bars = np.column_stack([panels[f"bar_{direction.lower()}_{axis}"] for axis in "xy"])
    return middle, LINE * np.sqrt(np.array(panels["area_m2"]))[:, None] * bars
