"""A flat sheet with a given volume of material under the loads of a folded one."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from foldshell.claims.measures import Layout, facet_areas, measure_state
from foldshell.records.measures import FlatEqualRecord
from foldshell.settings.stage import StageSettings
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import AnalysisCase, make_case
from foldshell.sizing.iteration import IterationTask


def analyse_flat(
    flat: str,
    sheet: Mapping[str, np.ndarray],
    layout: Layout,
    volume: float,
    span: float,
    subdivisions: int,
    settings: StageSettings,
) -> FlatEqualRecord:
    """Return what the flat sheet named `flat` of `volume` (m3) and one thickness is, and does.

    `displacement_first_order_m` is there even where the sheet buckles; the mesh error of the
    displacement is that against twice the subdivisions.

    `sheet` holds the arrays of folded.npz: vertices (V, 3) m, facets (F, 3), zigzag, strip (V,).
    """
    mesh = mesh_folded_sheet(dict(sheet), layout.support, subdivisions)
    area = float(facet_areas(sheet["vertices"], sheet["facets"]).sum())
    thickness = np.full(layout.panels, volume / area)
    case = make_case(mesh, settings)
    report, fields = case.run(IterationTask(0, span, thickness))
    first = _first_order(case, thickness, span)
    finer = mesh_folded_sheet(dict(sheet), layout.support, 2 * subdivisions)
    fine = _first_order(make_case(finer, settings), thickness, span)
    measures = measure_state(
        mesh, layout, report, fields, settings.combinations, settings.sizing.measure
    )
    return FlatEqualRecord(
        flat=flat,
        sides_m=tuple(np.ptp(sheet["vertices"], axis=0)[:2].tolist()),
        thickness_m=volume / area,
        volume_m3=volume,
        area_m2=area,
        state=report.state,
        displacement_first_order_m=first,
        errors={"displacement": (abs(first - fine) / fine, 0.0)},
        measures=measures,
    )


def _first_order(case: AnalysisCase, thickness: np.ndarray, span: float) -> float:
    """Return the largest downward displacement (m) of first order."""
    first_order = replace(case, options=case.options.changed(second_order=False))
    report, _ = first_order.run(IterationTask(0, span, thickness))
    return report.displacement_vertical_max_m
