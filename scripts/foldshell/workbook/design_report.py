"""What the design workbook shows of a sized design."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from foldshell.loads.cases import list_cases, make_load_cases
from foldshell.loads.words import describe_load, unit_of
from foldshell.records.analysis import NO_LIMIT, AnalysisRecord
from foldshell.records.analysis_arrays import ClassesArrays
from foldshell.records.classes import ClassesRecord
from foldshell.records.design_row import DesignRow, make_design_row
from foldshell.records.engineering import EngineeringArrays, EngineeringRecord
from foldshell.records.entry import entries
from foldshell.results.gather import Iterations
from foldshell.results.history import collect_edited_panels
from foldshell.settings.design import Design
from foldshell.settings.stage import StageSettings
from foldshell.workbook.design import DesignReport
from foldshell.workbook.panels import Paths, choose_panels
from foldshell.workbook.styles import Line, make_lines

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
    "utilization_panel_mean_max",
    "utilization_p99",
    "utilization_max",
    "utilization_mean",
    "panels_above_one",
    "panels_at_bound",
    "displacement_vertical_max_m",
    "reaction_imbalance",
    "dofs",
    "mesh_subdivisions",
    "edge_beam_volume_m3",
    "edge_beam_utilization_max",
    "edge_beam_utilization_panel_mean_max",
)
GROUPED = ("volume_m3", "utilization_panel_mean_max", "displacement_vertical_max_m")


def make_design_report(
    iterations: Iterations,
    design: Design,
    settings: StageSettings,
    versions: Mapping[str, str],
    grouped: ClassesRecord | None = None,
    grouped_arrays: ClassesArrays | None = None,
    folded: Paths = (),
    engineering: EngineeringRecord | None = None,
    engineering_arrays: EngineeringArrays | None = None,
) -> DesignReport:
    """Put the delivered analysis, the panels, the history and the settings together.

    `folded` names folded.npz, where the panels are no grid. The history of a loop, which is there
    before its classes, does without these.
    """
    last, sizing = iterations.final, settings.sizing
    return DesignReport(
        title=f"Design {design.name}",
        verdict=_list_verdict(iterations, design, grouped, engineering),
        criteria=last.criteria,
        grid=choose_panels(design.zigzag, design.strip, folded),
        thickness=iterations.thickness,
        utilization=iterations.utilization,
        thickness_class=grouped_arrays and grouped_arrays.panel_class,
        history=iterations.history,
        loads=_list_loads(settings),
        cases=list_cases(make_load_cases(settings.loads, settings.material.unit_weight)),
        combinations=settings.combinations,
        settings=settings,
        versions=versions,
        sources=SOURCES,
        utilization_max=sizing.utilization_max,
        measure=sizing.measure,
        engineering=engineering,
        engineering_arrays=engineering_arrays,
    )


def _list_verdict(
    iterations: Iterations,
    design: Design,
    grouped: ClassesRecord | None,
    engineering: EngineeringRecord | None,
) -> list[Line]:
    last = iterations.final
    return [
        *_describe_design(design),
        *(
            replace(line, words=f"{line.words} by the paper's criteria")
            for line in make_lines(last, ("verdict", "reason"))
        ),
        *([] if engineering is None else describe_engineering(engineering)),
        Line("model warnings", last.warning or "none"),
        Line("iterations", len(iterations.analyses)),
        *_describe_delivered(last),
        *describe_edits(iterations.analyses),
        *_list_headlines(last),
        Line("least buckling factor", last.least_factor),
        Line("its combination", last.least_factor_combination),
        *([] if grouped is None else _summarise_classes(grouped)),
        Line("settings hash", last.settings_hash),
    ]


def _list_headlines(last: AnalysisRecord) -> list[Line]:
    """Return the numbers of a state; beside utilization stands its limit, or that it has none."""
    lines = []
    for key in HEADLINES:
        for line in make_lines(last, (key,)):
            lines.append(replace(line, unit=line.unit or last.describe_limit(key)))
    return lines


def _describe_design(design: Design) -> list[Line]:
    """Return the columns of a design that say something."""
    row = make_design_row(design.to_row())
    return make_lines(row, [key for key in entries(DesignRow) if getattr(row, key)])


def _list_loads(settings: StageSettings) -> list[Line]:
    """Return the values of Table 2, or the loads of a design's own set, one a line."""
    loads = settings.loads
    if not loads.rows:
        return [_describe_load(name, value) for name, value in vars(loads).items() if value != ()]
    cases = make_load_cases(loads, settings.material.unit_weight)
    return [Line(describe_load(one), one.value, unit_of(one)) for one in cases]


def _describe_delivered(final: AnalysisRecord) -> list[Line]:
    """Say which state stands here where it is not the last one, and what that was."""
    if final.last is None:
        return []
    return [
        Line("delivered iteration", final.delivered_iteration),
        Line("last iteration", final.last.iteration),
        Line("its volume", final.last.volume_m3, "m3"),
    ]


def _describe_load(name: str, value: Any) -> Line:
    pressure = name in ("superimposed_dead", "live", "wind")
    return Line(name.replace("_", " "), value, "kN/m2" if pressure else "")


def describe_engineering(record: EngineeringRecord) -> list[Line]:
    """Return the engineering verdict, and tension beside what the loop sized for."""
    rankine = record.measures.get("rankine")
    own = record.measures.get(record.loop_criterion)
    lines = [
        Line("engineering verdict", record.verdict, judged=True),
        Line("engineering reason", record.reason),
    ]
    if own is None or rankine is None:
        return lines
    return [
        *lines,
        Line("utilization, largest strip mean", own.utilization_strip_max),
        Line("Rankine, largest panel mean", rankine.utilization_panel_mean_max, NO_LIMIT),
        Line("Rankine, largest strip mean", rankine.utilization_strip_max, NO_LIMIT),
        Line("Rankine, panels above one", rankine.panels_above_one),
    ]


def describe_edits(analyses: Sequence[AnalysisRecord]) -> list[Line]:
    """Say that a person changed panels, and in which iterations; nothing where nobody has."""
    panels = collect_edited_panels(analyses)
    numbers = ", ".join(f"{one.iteration:02d}" for one in analyses if one.edited_panels)
    if not panels:
        return []
    return [
        Line("panels changed by a person", len(panels)),
        Line("in the workbooks of iterations", numbers),
    ]


def _summarise_classes(grouped: ClassesRecord) -> list[Line]:
    """Return the lines on thickness classes: each with its thickness, and the grouped design."""
    classes = [Line(f"class {one.number}, thickness", one.thickness_m, "m")
               for one in grouped.classes]  # fmt: skip
    numbers = make_lines(grouped, GROUPED)
    return [
        *classes,
        Line("grouped: verdict", grouped.verdict),
        Line("grouped: reason", grouped.reason),
        *(replace(line, words=f"grouped: {line.words}") for line in numbers),
        Line("grouped: added volume, relative", grouped.added_volume_relative),
        Line("grouped: least buckling factor", grouped.least_factor),
    ]
