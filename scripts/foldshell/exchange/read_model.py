"""The export model of a design, from the files that hold its final state."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from foldshell.exchange.facet_loads import spread_cases
from foldshell.exchange.model import Crease, ExportModel, Panel, Support, Target
from foldshell.exchange.panels_of_mesh import Edges, classify, find_edges, find_loops, fit_plane
from foldshell.files.errors import InputError
from foldshell.files.whole import Json, read_json
from foldshell.folding.cut_files import read_exact_cut
from foldshell.loads.cases import SurfaceLoad, make_load_cases
from foldshell.records.analysis import DECIDES, AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays, ClassesArrays
from foldshell.records.arrays import list_arrays, read_typed_arrays
from foldshell.records.iteration import read_iteration
from foldshell.records.plain import to_plain
from foldshell.records.sheet_arrays import FoldedArrays, MeshArrays
from foldshell.results.governing import choose_combinations, compare_without_strains
from foldshell.settings.crosscheck import GOVERNING
from foldshell.settings.design import Row
from foldshell.settings.stage import StageSettings
from foldshell.shell.held_supports import list_holds

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
    mesh = read_typed_arrays(paths["mesh"], MeshArrays)
    folded = read_typed_arrays(paths["folded"], FoldedArrays)
    report, final, classes, checks = _read_results(paths, design["design"])
    vertices, facets, facet_panel = mesh.vertices, mesh.facets, mesh.facet_panel
    edges, plain = find_edges(vertices, facets), to_plain(report)
    panels = _make_panels(mesh, final, classes, checks, edges)
    settings, cases = _choose_loads(settings, mesh, panels)
    return ExportModel(
        design=design["design"],
        vertices=vertices,
        facets=facets,
        facet_panel=facet_panel,
        panels=panels,
        creases=_make_creases(edges, facet_panel),
        supports=_make_supports(mesh),
        material=settings.material,
        load_cases=cases,
        combinations=settings.combinations.all,
        groups={name: tuple(getattr(settings.combinations, name)) for name in GROUPS},
        compared=_choose_compared(settings, report),
        flat=folded.flat,
        flat_facets=folded.facets,
        flat_note=_flat_note(design["fold_mode"]),
        target=_make_target(design),
        verdict=report.verdict,
        pieces=read_exact_cut(folded),
        facts={key: plain[key] for key in _SCALARS if key in plain},
    )


def _choose_loads(
    settings: StageSettings, mesh: MeshArrays, panels: tuple[Panel, ...]
) -> tuple[StageSettings, tuple[SurfaceLoad, ...]]:
    """Return one load a case, and the settings with the combinations that these suffice for."""
    every = make_load_cases(settings.loads, settings.material.unit_weight)
    sized = np.array([panel.sized for panel in panels])[mesh.facet_panel]
    thickness = np.array([panel.thickness for panel in panels])[mesh.facet_panel]
    corners = mesh.vertices[mesh.facets]
    cases = spread_cases(every, corners, mesh.facet_panel, thickness, sized)
    known = compare_without_strains(settings.combinations, settings.loads)
    return settings.changed(known), cases


def _read_results(
    paths: Mapping[str, str | Path], name: str
) -> tuple[AnalysisRecord, AnalysisArrays, ClassesArrays, Json]:
    """Return the final state, its classes and the checks; the last two may not be given."""
    report, final = read_iteration(paths["report"], paths["final"])
    if final.utilization_panel_mean is None:
        raise InputError(
            f"{name}: exports: {report.verdict} ({report.reason}): only a design with results can "
            "be exported"
        )
    given = paths.get("classes")
    classes = read_typed_arrays(given, ClassesArrays) if given else ClassesArrays()
    return report, final, classes, read_json(paths["checks"]) if paths.get("checks") else {}


def _choose_compared(settings: StageSettings, report: AnalysisRecord) -> dict[str, str]:
    """Return one combination of each group: of those that are named the first, else those of the
    least buckling factor and of the largest displacement."""
    chosen = choose_combinations(settings.crosscheck, settings.combinations, report)
    named = {group: list(getattr(settings.crosscheck, group)) for group in GROUPS}
    return {
        group: names[-1] if named[group] == [GOVERNING] else names[0]
        for group, names in chosen.items()
    }


def _make_supports(mesh: MeshArrays) -> tuple[Support, ...]:
    """Return a support for each border that is held, or for each row of a set."""
    return tuple(
        Support(
            name,
            hold.pairs,
            tuple(hold.fix.tolist()),
            tuple(hold.spring.tolist()),
            hold.vertices,
            hold.clamp,
        )
        for name, hold in list_holds(list_arrays(mesh)).items()
    )


def _make_target(design: Row) -> Target:
    sides = (design.get("span_x_m", 0), design.get("span_y_m", 0))
    return Target(
        design["surface"],
        design["span_m"],
        design["height_m"],
        design.get("file_unit", "m"),
        sides if all(sides) else (),
    )


def _flat_note(fold_mode: str) -> str:
    if fold_mode in ("exact", "rigid"):
        return "unfolded from the folded shape"
    return f"the given pattern (mode {fold_mode})"


def _make_panels(
    mesh: MeshArrays, final: AnalysisArrays, classes: ClassesArrays, checks: Json, edges: Edges
) -> tuple[Panel, ...]:
    vertices, facet_panel = mesh.vertices, mesh.facet_panel
    fixed = np.empty(0) if mesh.fixed_thickness is None else mesh.fixed_thickness
    thickness = np.concatenate([final.thickness, fixed])
    sized, loops = len(final.thickness), find_loops(edges, facet_panel)
    own = np.split(np.argsort(facet_panel, kind="stable"), np.cumsum(np.bincount(facet_panel))[:-1])
    both = (edges.right >= 0) & (facet_panel[edges.left] == facet_panel[edges.right])
    inner: dict[int, list[int]] = {}
    for row in np.flatnonzero(both).tolist():
        inner.setdefault(int(facet_panel[edges.left[row]]), []).append(row)
    columns = _panel_values(final, checks, sized, len(thickness))
    panels = []
    for number, corners in sorted(loops.items()):
        rows = inner.get(number, [])
        graded = number < sized and classes.panel_class is not None
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
                thickness_class=int(classes.panel_class[number]) if graded else 0,
                class_thickness=float(classes.thickness[number]) if graded else None,
                values={name: value for name, value in values.items() if np.isfinite(value)},
            )
        )
    return tuple(panels)


def _panel_values(
    final: AnalysisArrays, checks: Json, sized: int, count: int
) -> dict[str, np.ndarray]:
    """Return results by name, (P + B,), nan where a panel has none."""
    columns = {}
    measures = [name for name in DECIDES if final.utilization(name) is not None]
    for measure in dict.fromkeys(["panel_mean", "element_max", *measures]):
        values = np.full(count, np.nan)
        values[:sized] = final.utilization(measure)
        beam = final.edge_beam_utilization(measure)
        if beam is not None:
            values[sized:] = beam
        columns[f"utilization_{measure}"] = values
    for name, values in (checks.get("panels") or {}).items():
        numbers = np.array([np.nan if v is None or isinstance(v, str) else v for v in values])
        known = name in ("panel", "thickness_m", "area_m2") or name.startswith("centroid")
        if numbers.shape == (sized,) and not known and np.isfinite(numbers).any():
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
