"""The calculation sheet of a design: what an engineer checks and signs, on A4, as plain data."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from foldshell.files.whole import Json
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.comparison import ComparisonRecord
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.report.checks import Check, describe_share, find_governing
from foldshell.report.engineering import describe_measures, list_engineering
from foldshell.report.loads_section import describe_loads
from foldshell.report.markup import Table, format_number, make_table
from foldshell.report.places import find_panel
from foldshell.report.reading import say_measure, say_theory
from foldshell.report.sketch import Mark
from foldshell.results.design_view import DesignView
from foldshell.results.fields import choose_buckling
from foldshell.results.reactions import Reactions
from foldshell.settings.design import Design
from foldshell.settings.stage import StageSettings
from foldshell.settings.support_row import SUPPORTS
from foldshell.workbook.styles import GOOD_VERDICTS

BAR_END = 1.25
"""Share of a limit at which the bar of a check ends."""


@dataclass(frozen=True)
class SheetFiles:
    """What a calculation sheet is made of."""

    design: Design
    final: AnalysisRecord
    comparison: ComparisonRecord
    convergence: MeshConvergenceRecord
    checks: Sequence[Check]
    reactions: Reactions | None
    engineering: EngineeringRecord | None = None


def find_marks(view: DesignView, final: AnalysisRecord) -> list[Mark]:
    """Return the places that govern: largest panel mean, displacement and buckling mode."""
    state, marks = view.state, []
    most = find_panel(state.final.utilization(view.sizing.measure), state.folded)
    if state.utilization is not None and most is not None:
        under = f", {final.governing_combination}" if final.governing_combination else ""
        marks.append(Mark("U", f"utilization, panel {most.panel}{under}", most.middle))
    if final.displacement_place_m:
        marks.append(Mark("D", f"displacement, {final.displacement_combination}",
                          final.displacement_place_m))  # fmt: skip
    least = choose_buckling(state)
    if least is not None:
        moved = np.linalg.norm(state.buckling_mode(least[0]), axis=1)
        marks.append(Mark("B", f"buckling mode, {least[0]}",
                          state.cells.nodes[moved.argmax()].tolist()))  # fmt: skip
    return marks


def make_sheet(files: SheetFiles, view: DesignView, settings: StageSettings) -> Json:
    """Return the sheet as plain data: words and tables, each a header, rows of texts, and which
    columns hold numbers."""
    loads = describe_loads(settings)
    governing = find_governing(files.checks)
    tables = {
        "Geometry": _geometry(files.design, files.final, view),
        "Material": loads.material,
        "Load cases": _load_cases(loads.cases, files.reactions),
        "Combinations": loads.combinations,
        "Supports": _supports(files.design, files.reactions),
        "Reactions": _reactions(files.reactions),
        "Cross-check and mesh error": _quality(files),
    }
    return {
        "title": f"Calculation sheet: {files.design.name}",
        "verdict": files.final.verdict.replace("_", " "),
        "good": files.final.verdict in GOOD_VERDICTS,
        "reason": files.final.reason,
        "governing": governing.words if governing else "no check has a value",
        "reading": say_theory(files.final),
        "measure": say_measure(files.final),
        "checks": [_bar(check) for check in files.checks],
        "engineering": _describe_engineering(files.engineering),
        "tables": {name: list_texts(table) for name, table in tables.items() if table.rows},
        "warning": files.final.warning or "",
        "edited": files.final.edited,
        "settings_hash": files.final.settings_hash,
    }


def _describe_engineering(record: EngineeringRecord | None) -> Json | None:
    """Return the engineering verdict with its checks, None without one."""
    if record is None:
        return None
    governing = find_governing(list_engineering(record))
    return {
        "verdict": record.verdict.replace("_", " "),
        "good": record.verdict == "passes",
        "reason": record.reason,
        "checks": [_bar(check) for check in list_engineering(record)],
        "governing": governing.words if governing else "",
        "measures": describe_measures(record),
    }


def _bar(check: Check) -> Json:
    """Return a check in words, and how long its bar is (0 to 1) with 1 / BAR_END at the limit."""
    ratio = check.ratio
    return {
        **{key: value for key, value in asdict(check).items() if key in ("name", "where", "met")},
        "value": format_number(check.value),
        "limit": format_number(check.limit),
        "share": describe_share(ratio),
        "bar": min(ratio or 0.0, BAR_END) / BAR_END,
    }


def _geometry(design: Design, final: AnalysisRecord, view: DesignView) -> Table:
    thickness = 1e3 * view.state.final.thickness
    size = np.ptp(view.state.cells.nodes, axis=0)
    rows = [
        ("pattern, surface", f"{design.pattern}, {design.surface}"),
        ("span, height of the target [m]", f"{design.span:g}, {design.height:g}"),
        *_list_sides(design),
        ("extents x, y, z [m]", ", ".join(f"{value:.2f}" for value in size)),
        *[("zig-zags x strips", f"{design.zigzag} x {design.strip}")] * design.on_grid,
        ("panels", len(thickness)),
        ("supported edges", describe_supports(design)),
        ("thickness, least to largest [mm]", f"{thickness.min():.1f} to {thickness.max():.1f}"),
        ("volume [m³]", final.volume_m3),
        ("area of the sheet [m²]", final.area_m2),
        ("volume / area [mm]", 1e3 * final.volume_m3 / final.area_m2),
    ]
    return make_table(("quantity", "value"), rows)


def _list_sides(design: Design) -> list[tuple[str, str]]:
    x, y = design.sides
    words = "sides of the plan along x, y [m]; the span of limits is the shorter"
    return [] if x == y else [(words, f"{x:g}, {y:g}")]


def describe_supports(design: Design) -> str:
    """Return the supports of a design in words: pinned borders, or a set of the table."""
    pinned = design.support in SUPPORTS
    return f"{design.support}, pinned" if pinned else f"set {design.support} of the table"


def _load_cases(cases: Sequence[Any], reactions: Reactions | None) -> Table:
    """Return the load cases with their resultants, kN, and moments about the origin, kNm."""
    known = {}
    if reactions:
        sums = zip(reactions.cases, reactions.resultant.T, reactions.moment.T, strict=True)
        known = {name: _round_sums(force, moment) for name, force, moment in sums}
    rows = [(case.name, f"{case.words}: {case.size}", *known.get(case.name, ())) for case in cases]
    header = ["case", "load", *(f"sum {axis} [kN]" for axis in "xyz" if known)]
    return make_table([*header, *["moment x, y, z [kNm]"] * bool(known)], rows)


def _round_sums(force: np.ndarray, moment: np.ndarray) -> tuple[Any, ...]:
    words = ", ".join(f"{value + 0.0:.0f}" for value in np.round(moment).tolist())
    return *(round(value, 1) + 0.0 for value in force.tolist()), words


def _supports(design: Design, reactions: Reactions | None) -> Table:
    """Return what each row of a set of supports holds, and how; nothing of pinned borders."""
    header = ("support", "vertices", "length of its edges [m]", "held")
    if reactions is None or design.support in SUPPORTS:
        return make_table(header, [])
    rows = [(edge.name, edge.vertices, edge.length, edge.words) for edge in reactions.edges]
    return make_table(header, rows)


def _reactions(reactions: Reactions | None) -> Table:
    """Return the resultants of the reactions by support and combination, and their sums, kN."""
    header = ("combination", "support", "x [kN]", "y [kN]", "z [kN]")
    if reactions is None:
        return make_table(header, [])
    rows = []
    for k, name in enumerate(reactions.combinations):
        for edge in reactions.edges:
            rows.append((name, edge.name, *_round(edge.force[:, k])))
        rows.append((name, "sum", *_round(reactions.force[:, :, k].sum(axis=0))))
    return make_table(header, rows)


def _round(force: np.ndarray) -> list[float]:
    return [round(float(value), 1) + 0.0 for value in force]


def _quality(files: SheetFiles) -> Table:
    comparison, convergence = files.comparison, files.convergence
    worst = max(
        comparison.quantities.items(), default=None,
        key=lambda item: item[1].relative_difference / item[1].tolerance,
    )  # fmt: skip
    rows = [("second code", comparison.outcome)]
    if worst:
        name, item = worst
        words = f"{100 * item.relative_difference:.2f} % of {100 * item.tolerance:g} %"
        rows.append(("nearest to its tolerance", f"{name.replace('_', ' ')}: {words}"))
    if convergence.mesh_error is not None:
        rows.append(("mesh error", f"{100 * convergence.mesh_error:.2f} %"))
    if convergence.buckling_mesh_error is not None:
        rows.append(("mesh error of buckling", f"{100 * convergence.buckling_mesh_error:.2f} %"))
    if files.final.reaction_imbalance is not None:
        rows.append(("reactions against loads", f"{files.final.reaction_imbalance:.1e}"))
    return make_table(("what", "result"), rows)


def list_texts(table: Table) -> Json:
    """Return a table as plain data: header, which columns hold numbers, rows of texts."""
    return {
        "header": list(table.header),
        "numeric": list(table.numeric),
        "rows": [[format_number(cell.value) for cell in row] for row in table.rows],
    }
