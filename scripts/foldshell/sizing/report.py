"""What the design workbook shows of a sized design."""

from collections.abc import Mapping
from typing import Any

from foldshell.sizing.gather import Iterations
from foldshell.workbook.design import DesignReport
from foldshell.workbook.history import find_least_factor
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
    "displacement_vertical_max_m",
    "reaction_imbalance",
    "dofs",
    "mesh_subdivisions",
)


def make_design_report(
    iterations: Iterations,
    design: Mapping[str, Any],
    settings: Mapping[str, Any],
    settings_hash: str,
    versions: Mapping[str, str],
) -> DesignReport:
    """Put the last analysis, the panels, the history and the settings together."""
    last = iterations.analyses[-1]
    verdict = {
        **design,
        "verdict": last["verdict"],
        "reason": last["reason"],
        "iterations": len(iterations.analyses),
        **{name: last.get(name) for name in HEADLINES},
        "buckling_factor_min": find_least_factor(last),
        "settings_hash": settings_hash,
    }
    return DesignReport(
        title=f"Design {design['design']}",
        verdict=verdict,
        criteria=last["criteria"],
        grid=make_panel_grid(design["zigzag"], design["strip"]),
        thickness=iterations.thickness,
        utilization=iterations.utilization,
        history=iterations.history,
        loads={f"{name}_kn_m2" if name in ("superimposed_dead", "live", "wind") else name: value
               for name, value in settings["loads"].items()},
        combinations=settings["combinations"],
        settings=settings,
        versions=versions,
        sources=SOURCES,
        utilization_max=settings["sizing"]["utilization_max"],
    )  # fmt: skip
