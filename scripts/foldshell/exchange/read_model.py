"""The export model of a design, from the files that hold its final state."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.exchange.model import Crease, ExportModel, Panel, Support, Target
from foldshell.exchange.panels_of_mesh import Edges, classify, find_edges, find_loops, fit_plane
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, read_json
from foldshell.loads.cases import make_load_cases
from foldshell.settings.crosscheck import GOVERNING
from foldshell.settings.design import Row
from foldshell.settings.stage import StageSettings

GROUPS = ("strength", "deflection")
_SCALARS = ("volume_m3", "area_m2", "utilization_max", "utilization_panel_mean_max",
            "displacement_vertical_max_m", "buckling_factor", "verdict", "reason")  # fmt: skip


def read_export_model(
    paths: Mapping[str, str | Path],
    design: Row,
    settings: StageSettings,
) -> ExportModel:
    """Read mesh.npz, folded.npz, final.npz, final.json and, where given, classes.npz and the
    engineering checks; `design` is a row of the table, `settings` those of stage `crosscheck`.

    Raises `InputError` where a design is not sized.
    """
    mesh, folded = read_arrays(paths["mesh"]), read_arrays(paths["folded"])
    final, report = read_arrays(paths["final"]), read_json(paths["report"])
    if "utilization_panel_mean" not in final:
        raise InputError(
            f"{design['design']}: exports: {report.get('verdict', 'no verdict')} "
            f"({report.get('reason', 'no reason')}): only a design with results can be exported"
        )
    classes = read_arrays(paths["classes"]) if paths.get("classes") else {}
    checks = read_json(paths["checks"]) if paths.get("checks") else {}
    vertices, facets, facet_panel = (mesh[name] for name in ("vertices", "facets", "facet_panel"))
    edges = find_edges(vertices, facets)
    panels = _make_panels(mesh, final, classes, checks, edges)
    sheet = folded["facets"]
    return ExportModel(
        design=design["design"],
        vertices=vertices,
        facets=facets,
        facet_panel=facet_panel,
        panels=panels,
        creases=_make_creases(edges, facet_panel),
        supports=(Support(f"support {design['support']}", mesh["support_pairs"]),),
        material=settings.material,
        load_cases=make_load_cases(settings.loads, settings.material.unit_weight),
        combinations=settings.combinations.all,
        groups={name: tuple(getattr(settings.combinations, name)) for name in GROUPS},
        compared=_choose_compared(settings, report),
        flat=folded["flat"],
        flat_facets=sheet,
        flat_note=_flat_note(design["fold_mode"]),
        target=Target(design["surface"], design["span_m"], design["height_m"]),
        verdict=str(report.get("verdict", "")),
        facts={key: report[key] for key in _SCALARS if key in report},
    )


def _choose_compared(settings: StageSettings, report: Mapping[str, Any]) -> dict[str, str]:
    """Return one combination of each group: of those that are named the first, else those of the
    least buckling factor and of the largest displacement."""
    factors = {name: value for name, value in report.get("buckling_factor", {}).items() if value}
    own = [name for name in settings.combinations.strength if name in factors]
    governing = {
        "strength": min(own, key=factors.__getitem__, default=None),
        "deflection": report.get("displacement_combination"),
    }
    chosen = {}
    for group, found in governing.items():
        named = getattr(settings.crosscheck, group)
        known = list(getattr(settings.combinations, group))
        first = found if found in known else known[0]
        chosen[group] = first if list(named) == [GOVERNING] else named[0]
    return chosen


def _flat_note(fold_mode: str) -> str:
    if fold_mode in ("exact", "rigid"):
        return "unfolded from the folded shape"
    return f"the given pattern (mode {fold_mode})"


def _make_panels(mesh, final, classes, checks, edges: Edges) -> tuple[Panel, ...]:
    vertices, facet_panel = mesh["vertices"], mesh["facet_panel"]
    fixed = mesh.get("fixed_thickness", np.empty(0))
    thickness = np.concatenate([final["thickness"], fixed])
    sized, loops = len(final["thickness"]), find_loops(edges, facet_panel)
    own = np.split(np.argsort(facet_panel, kind="stable"), np.cumsum(np.bincount(facet_panel))[:-1])
    both = (edges.right >= 0) & (facet_panel[edges.left] == facet_panel[edges.right])
    inner: dict[int, list[int]] = {}
    for row in np.flatnonzero(both).tolist():
        inner.setdefault(int(facet_panel[edges.left[row]]), []).append(row)
    columns = _panel_values(final, checks, sized, len(thickness))
    panels = []
    for number, corners in sorted(loops.items()):
        rows = inner.get(number, [])
        graded = number < sized and "panel_class" in classes
        values = {name: float(column[number]) for name, column in columns.items()}
        panels.append(
            Panel(
                number=number,
                corners=corners,
                facets=own[number],
                inner=edges.ends[rows].reshape(-1, 2),
                bends=edges.angle[rows],
                flatness=fit_plane(vertices[corners])[2],
                thickness=float(thickness[number]),
                sized=number < sized,
                thickness_class=int(classes["panel_class"][number]) if graded else 0,
                class_thickness=float(classes["thickness"][number]) if graded else None,
                values={name: value for name, value in values.items() if np.isfinite(value)},
            )
        )
    return tuple(panels)


def _panel_values(final, checks, sized: int, count: int) -> dict[str, np.ndarray]:
    """Return results by name, (P + B,), nan where a panel has none."""
    columns = {}
    for name in ("utilization_panel_mean", "utilization_element_max"):
        values = np.full(count, np.nan)
        values[:sized] = final[name]
        if f"edge_beam_{name}" in final:
            values[sized:] = final[f"edge_beam_{name}"]
        columns[name] = values
    for name, values in (checks.get("panels") or {}).items():
        numbers = np.array([np.nan if v is None or isinstance(v, str) else v for v in values])
        if numbers.shape == (sized,):
            columns[f"check_{name}"] = np.append(numbers, np.full(count - sized, np.nan))
    return columns


def _make_creases(edges: Edges, facet_panel: np.ndarray) -> tuple[Crease, ...]:
    creases = []
    for row in range(len(edges.ends)):
        panels = [int(facet_panel[f]) for f in (edges.left[row], edges.right[row]) if f >= 0]
        if len(panels) == 2 and panels[0] == panels[1]:
            continue
        first, second = edges.ends[row].tolist()
        angle = float(edges.angle[row])
        creases.append(Crease((first, second), classify(angle), angle, tuple(panels)))
    return tuple(creases)
