"""What the design workbook shows of a sized design."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from foldshell.results.gather import Iterations
from foldshell.results.history import EDGE_BEAM_KEYS, find_least_factor
from foldshell.settings.design import Design
from foldshell.settings.stage import StageSettings
from foldshell.workbook.design import DesignReport
from foldshell.workbook.panels import make_panel_grid

SOURCES = (
    "Tsiamis, Oliva, Calvano (2018) Algorithmic Design and Analysis of Architectural Origami, "
    "Nexus Network Journal 20:59-73: loads, combinations (Table 2), stop rule (Table 3)",
    "Schenk & Guest (2013) PNAS 110:3276: geometry of the folded Miura sheet",
    "Comodi (1989) Math. Comp. 52:17 and Neunteufel & Schoberl (2019) Comput. Struct. "
    "225:106109: bending of the shell element",
)
HEADLINES = (
    "volume_m3",
    "area_m2",
    "utilization_max",
    "utilization_p99",
    "utilization_mean",
    "utilization_panel_mean_max",
    "panels_above_one",
    "panels_at_bound",
    "displacement_vertical_max_m",
    "reaction_imbalance",
    "dofs",
    "mesh_subdivisions",
)
EDGE_BEAM = ("edge_beam_volume_m3", *EDGE_BEAM_KEYS)


def make_design_report(
    iterations: Iterations,
    design: Design,
    settings: StageSettings,
    versions: Mapping[str, str],
    grouped: Mapping[str, Any],
    panel_class: np.ndarray,
) -> DesignReport:
    """Put the last analysis, the panels, the history and the settings together.

    `grouped` are the contents of classes.json, `panel_class` (P,) the class of each panel.

    Classes are numbers.
    """
    last, row = iterations.analyses[-1], design.to_row()
    verdict = {
        **{name: value for name, value in row.items() if value or "edge_beam" not in name},
        "verdict": last["verdict"],
        "reason": last["reason"],
        "iterations": len(iterations.analyses),
        **{name: last.get(name) for name in HEADLINES},
        **{name: last[name] for name in EDGE_BEAM if name in last},
        "buckling_factor_min": find_least_factor(last),
        **_summarise_classes(grouped),
        "settings_hash": last["settings_hash"],
    }
    return DesignReport(
        title=f"Design {design.name}",
        verdict=verdict,
        criteria=last["criteria"],
        grid=make_panel_grid(design.zigzag, design.strip),
        thickness=iterations.thickness,
        utilization=iterations.utilization,
        thickness_class=panel_class,
        history=iterations.history,
        loads={f"{name}_kn_m2" if name in ("superimposed_dead", "live", "wind") else name: value
               for name, value in vars(settings.loads).items()},
        combinations=settings.combinations,
        settings=settings.to_plain(),
        versions=versions,
        sources=SOURCES,
        utilization_max=settings.sizing.utilization_max,
    )  # fmt: skip


def _summarise_classes(grouped: Mapping[str, Any]) -> dict[str, Any]:
    """Return the lines on thickness classes: each with its thickness, and the grouped design."""
    classes = {
        f"class_{item['class']}_thickness_m": item["thickness_m"] for item in grouped["classes"]
    }
    return {
        **classes,
        "grouped_verdict": grouped["verdict"],
        "grouped_reason": grouped["reason"],
        "grouped_volume_m3": grouped["volume_m3"],
        "grouped_added_volume_relative": grouped["added_volume_relative"],
        "grouped_utilization_panel_mean_max": grouped.get("utilization_panel_mean_max"),
        "grouped_displacement_vertical_max_m": grouped.get("displacement_vertical_max_m"),
        "grouped_buckling_factor_min": find_least_factor(grouped),
    }
