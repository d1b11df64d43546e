"""The comparison as a workbook: one sheet a view, a units row under each header."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path

from xlsxwriter import Workbook
from xlsxwriter.format import Format
from xlsxwriter.worksheet import Worksheet

from crosscheck.reading import write_whole
from crosscheck.records import Comparison, Limit, ShearShare
from crosscheck.values import SECOND_ORDER

CREATED = datetime(2020, 1, 1)  # the same values give the same bytes
COLUMNS = {
    "combination": "",
    "quantity": "",
    "unit": "",
    "primary": "in unit",
    "independent": "in unit",
    "difference": "%",
    "tolerance": "%",
    "result": "",
    "mesh error, primary": "%",
    "mesh error, independent": "%",
}
MESH_COLUMNS = {
    "combination": "",
    "quantity": "",
    "unit": "",
    "code": "",
    "mesh n": "parts",
    "value": "in unit",
    "limit": "in unit",
    "off the limit": "%",
    "order": "-",
}
REACTION_COLUMNS = {
    "combination": "",
    "support": "",
    "component": "",
    "primary": "kN",
    "independent": "kN",
    "difference": "% of largest",
    "tolerance": "%",
    "result": "",
}
SHEAR_COLUMNS = {
    "criterion": "",
    "combination": "",
    "verdict": "",
    "shear adds": "%",
    "on the coarse mesh": "%",
    "on the fine mesh": "%",
    "value": "m or -",
    "limit": "m or -",
    "with shear": "m or -",
    "and mesh error": "m or -",
}
LABELS = {
    "displacement_down_max_m": "largest downward displacement",
    "displacement_max_m": "largest displacement",
    "work_knm": "work of the loads",
    "utilization_p99": "utilization, 99th percentile of area",
    "utilization_panel_mean_max": "utilization, largest panel mean",
    "buckling_factor": "buckling factor",
    "steel_kg_m2": "steel by area, no least steel",
    "steel_max_kn_m": "largest steel of a layer and direction",
    "moment_max_knm_m": "largest mean moment",
    "shear_max_kn_m": "largest mean shear (open)",
    "reaction_x_kn": "sum of reactions along x",
    "reaction_y_kn": "sum of reactions along y",
    "reaction_z_kn": "sum of reactions along z",
    "reaction_imbalance": "reactions + loads, relative",
}
NUMERIC = {
    "number": "0.00000",
    "percent": "0.00",
    "small": "0.0E+00",
    "count": "0",
    "force": "0.0",
}


def write_comparison(path: str | Path, design: str, comparison: Comparison) -> None:
    """Write sheets `comparison`, `meshes`, `reactions`, `reinforcement` and `shear`; what fails or
    turns is red."""
    with write_whole(path) as temporary, Workbook(str(temporary)) as book:
        book.set_properties({"title": f"Cross-check of {design}", "created": CREATED})
        style = _build_styles(book)
        _write_comparison(book.add_worksheet("comparison"), design, comparison, style)
        _write_meshes(book.add_worksheet("meshes"), design, comparison, style)
        if comparison.reactions:
            _write_reactions(book.add_worksheet("reactions"), design, comparison, style)
        if comparison.reinforcement:
            _write_reinforcement(book.add_worksheet("reinforcement"), design, comparison, style)
        if comparison.shear:
            _write_shear(book.add_worksheet("shear"), design, comparison, style)


def _build_styles(book: Workbook) -> dict[str, Format]:
    red = {"font_color": "#9C0006", "bg_color": "#FFC7CE"}
    style = {
        "title": book.add_format({"bold": True, "font_size": 13}),
        "text": book.add_format({}),
        "text_failed": book.add_format(red),
        "result": book.add_format({"align": "center"}),
        "result_failed": book.add_format({**red, "align": "center"}),
    }
    header = {"bold": True, "bottom": 1, "bg_color": "#D9E1F2", "text_wrap": True, "valign": "top"}
    units = {"italic": True, "font_color": "#595959", "bottom": 1}
    for name, form in (("header", header), ("units", units)):
        style[name] = book.add_format(form)
        style[f"{name}_right"] = book.add_format({**form, "align": "right"})
    for name, form in NUMERIC.items():
        number = {"num_format": form, "align": "right"}
        style[name] = book.add_format(number)
        style[f"{name}_failed"] = book.add_format({**red, **number})
    return style


def _start_sheet(
    sheet: Worksheet, title: str, columns: Mapping[str, str], widths: Sequence[float], style: dict
) -> None:
    """Title, header and units row, frozen above the first row of data; one page wide."""
    sheet.write(0, 0, title, style["title"])
    sheet.set_row(1, 32)
    for k, (name, unit) in enumerate(columns.items()):
        side = "_right" if unit else ""
        sheet.write(1, k, name, style["header" + side])
        sheet.write(2, k, unit, style["units" + side])
    sheet.freeze_panes(3, 2)
    for k, width in enumerate(widths):
        sheet.set_column(k, k, width)
    sheet.set_landscape()
    sheet.set_paper(9)
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(1, 2)


def _name_quantity(key: str) -> tuple[str, str]:
    """Combination and words of a key such as `S2 Th.II work_knm`."""
    combination, name = key.rsplit(" ", 1)
    return combination, LABELS.get(name, name)


def _write_comparison(sheet: Worksheet, design: str, comparison: Comparison, style: dict) -> None:
    verdict = {True: "passed", False: "failed", None: "not possible"}[comparison.passed]
    widths = (12, 36, 6, 13, 13, 11, 11, 9, 12, 12)
    _start_sheet(sheet, f"{design}: cross-check {verdict}", COLUMNS, widths, style)
    row = 3
    if comparison.reason is not None:
        sheet.write(row, 0, comparison.reason, style["text"])
    for key, entry in comparison.quantities.items():
        end = "" if entry.passed else "_failed"
        value = style[("small" if key.endswith("imbalance") else "number") + end]
        tight = style[("small" if entry.tolerance < 1e-3 else "percent") + end]
        text = style["text" + end]
        sheet.write_row(row, 0, [*_name_quantity(key), entry.unit], text)
        sheet.write_row(row, 3, [entry.primary, entry.independent], value)
        sheet.write_row(row, 5, [100 * entry.relative_difference, 100 * entry.tolerance], tight)
        sheet.write(row, 7, "passed" if entry.passed else "failed", style["result" + end])
        for column, code in ((8, "primary"), (9, "independent")):
            error = getattr(entry, f"{code}_mesh_error", None)
            shown = "-" if error is None else 100 * error
            sheet.write(row, column, shown, style["percent" + end])
        row += 1
    for key in comparison.not_compared:
        row += 1
        sheet.write(row, 0, f"not compared, given by one code only: {key}", style["text"])
    for key in comparison.not_settled:
        row += 1
        text = f"not settled within the steps of the independent code: {key}"
        sheet.write(row, 0, text, style["text_failed"])
    if comparison.first is not None:
        sheet.write(row + 2, 0, _describe_first(comparison), style["text"])


def _describe_first(comparison: Comparison) -> str:
    """What a first comparison found, which the one on finer meshes replaces."""
    first = comparison.first
    before, now = (
        " and ".join(str(m) for m in one.independent_subdivisions) for one in (first, comparison)
    )
    failed = [
        f"{key} {100 * entry.relative_difference:.3g} %"
        for key, entry in first.quantities.items()
        if not entry.passed
    ]
    failed += [
        f"{key} {100 * entry.relative_difference:.3g} %"
        for key, entry in first.reactions.items()
        if not entry.passed
    ]
    failed += [f"{key} not settled" for key in first.not_settled]
    return (
        f"second comparison, on meshes {now} of the independent code; "
        f"the first, on {before}, failed: {', '.join(failed)}"
    )


def _write_meshes(sheet: Worksheet, design: str, comparison: Comparison, style: dict) -> None:
    widths = (12, 36, 6, 13, 9, 13, 13, 11, 9)
    _start_sheet(sheet, f"{design}: values of each mesh", MESH_COLUMNS, widths, style)
    row = 3
    limits = {k: e for k, e in comparison.quantities.items() if isinstance(e, Limit)}
    for key, entry in limits.items():
        for code in ("primary", "independent"):
            limit = getattr(entry, code)
            values = getattr(entry, f"{code}_meshes")
            for n, value in zip(getattr(comparison, f"{code}_subdivisions"), values, strict=True):
                error = abs(value - limit) / abs(limit) if limit else 0.0
                sheet.write_row(row, 0, [*_name_quantity(key), entry.unit, code], style["text"])
                sheet.write(row, 4, n, style["count"])
                sheet.write_row(row, 5, [value, limit], style["number"])
                order = getattr(entry, f"{code}_order")
                sheet.write_row(
                    row, 7, [100 * error, "-" if order is None else order], style["percent"]
                )
                row += 1


def _write_reactions(sheet: Worksheet, design: str, comparison: Comparison, style: dict) -> None:
    """Force along x, y, z and thrust of each support by both codes; one result a support."""
    title = f"{design}: reactions of each support, extrapolated"
    _start_sheet(sheet, title, REACTION_COLUMNS, (12, 18, 11, 13, 13, 12, 11, 9), style)
    row = 3
    for key, entry in comparison.reactions.items():
        combination, support = _split_support(key)
        end = "" if entry.passed else "_failed"
        first = [*entry.primary_kn, entry.primary_thrust_kn]
        second = [*entry.independent_kn, entry.independent_thrust_kn]
        rows = zip(("x", "y", "z", "thrust"), first, second, strict=True)
        for number, (component, one, other) in enumerate(rows):
            sheet.write_row(row, 0, [combination, support, component], style["text" + end])
            sheet.write_row(row, 3, [one, other], style["force" + end])
            if number == 0:
                percent = [100 * entry.relative_difference, 100 * entry.tolerance]
                sheet.write_row(row, 5, percent, style["percent" + end])
                word = "passed" if entry.passed else "failed"
                sheet.write(row, 7, word, style["result" + end])
            row += 1


def _write_reinforcement(sheet: Worksheet, design: str, comparison: Comparison, style) -> None:
    """Steel, moment and shear of both codes; the difference is a formula of both."""
    found = comparison.reinforcement
    title = f"{design}: steel for {', '.join(found.combinations)}, first order, finest meshes"
    columns = {name: unit for name, unit in COLUMNS.items() if name != "combination"}
    _start_sheet(sheet, title, columns, (40, 8, 13, 13, 11, 11, 9, 12, 12), style)
    for row, (name, entry) in enumerate(found.quantities.items(), 3):
        end = "" if entry.passed else "_failed"
        sheet.write_row(row, 0, [LABELS[name], entry.unit], style["text" + end])
        sheet.write_row(row, 2, [entry.primary, entry.independent], style["force" + end])
        cells = f"C{row + 1}", f"D{row + 1}"
        formula = f"=100*ABS({cells[0]}-{cells[1]})/MAX({cells[0]},{cells[1]})"
        percent = style["percent" + end]
        sheet.write_formula(row, 4, formula, percent, 100 * entry.relative_difference)
        sheet.write(row, 5, 100 * entry.tolerance, percent)
        sheet.write(row, 6, "passed" if entry.passed else "failed", style["result" + end])
        errors = [entry.primary_mesh_error, entry.independent_mesh_error]
        sheet.write_row(row, 7, [100 * error for error in errors], percent)
    if found.reason is not None:
        sheet.write(row + 2, 0, found.reason, style["text"])


def _split_support(key: str) -> tuple[str, str]:
    """Combination and support of a key such as `S2 Th.II zigzag first`."""
    combination, _, support = key.partition(" ")
    if support.startswith(f"{SECOND_ORDER} "):
        return f"{combination} {SECOND_ORDER}", support.removeprefix(f"{SECOND_ORDER} ")
    return combination, support


def _write_shear(sheet: Worksheet, design: str, comparison: Comparison, style: dict) -> None:
    """What shear deformation adds to each limited value, and whether the verdict turns."""
    title = f"{design}: what shear deformation adds, by the independent code"
    _start_sheet(sheet, title, SHEAR_COLUMNS, (34, 12, 40, 10, 11, 11, 11, 11, 11, 11), style)
    for row, (name, entry) in enumerate(comparison.shear.items(), 3):
        end = "_failed" if entry.turns or entry.turns_refined else ""
        words = [LABELS[name], entry.combination, _say_shear(entry)]
        sheet.write_row(row, 0, words, style["text" + end])
        shares = [entry.share, entry.share_meshes[0], entry.share_meshes[-1]]
        sheet.write_row(row, 3, [100 * share for share in shares], style["percent" + end])
        values = [entry.value, entry.limit, entry.with_shear, entry.refined_with_shear]
        sheet.write_row(row, 6, values, style["number" + end])


def _say_shear(entry: ShearShare) -> str:
    """Whether the verdict turns with shear deformation, alone or with mesh error."""
    if entry.turns:
        return "turns with shear deformation"
    if entry.turns_refined:
        return "turns with shear and mesh error together"
    return "stays"
