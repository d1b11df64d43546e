"""The report of a study: cover, contact sheet, comparison, claims, verification, settings."""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from foldshell.files.whole import Json, read_json
from foldshell.records.analysis import AnalysisRecord, read_analysis
from foldshell.records.claims import ClaimRecord
from foldshell.records.comparison import ComparisonRecord, read_comparison
from foldshell.records.files import read_record, read_records
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.reinforced_claims import ReinforcedClaim
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.report.beside import list_exports
from foldshell.report.checks import Check, describe_share, find_governing, read_checks
from foldshell.report.embedded import embed_picture
from foldshell.report.engineering import list_engineering, read_verdict
from foldshell.report.fold_answer import Part, read_chapter
from foldshell.report.loads_section import describe_loads
from foldshell.report.markdown import render_markdown
from foldshell.report.markup import Table, make_table, render
from foldshell.report.own_settings import compare_settings
from foldshell.report.provenance import Provenance
from foldshell.report.reading import say_both, say_compared
from foldshell.report.study_columns import Column, choose_columns, count_verdicts, make_row
from foldshell.report.study_pages import list_settings
from foldshell.report.verification import make_verification
from foldshell.results.summary import hash_study
from foldshell.settings.stage import StageSettings

COUNTED = re.compile(r"\b\d+ (?=cracked panels)")
"""A number of a design in the name of a check, which is the same check for all."""
SIZE_MAX = 20_000_000
"""Bytes of the whole report, which is to be sent by mail."""


@dataclass(frozen=True)
class DesignEntry:
    """One design of the report: its row of summary.csv, and what its own files say of it."""

    row: SummaryRow
    final: AnalysisRecord
    checks: Sequence[Check]
    comparison: ComparisonRecord
    convergence: MeshConvergenceRecord
    exports: Sequence[str] = ()
    engineering: Sequence[Check] = ()

    @property
    def name(self) -> str:
        """Name of the design."""
        return self.row.design


@dataclass(frozen=True)
class StudyFiles:
    """What a report is made of; `tiles` are small pictures of all designs by quantity,
    `standing` the claims on shells that stand, `beside` the summaries of other studies by tag."""

    study: str
    designs: Sequence[DesignEntry]
    tiles: Json
    figures: Mapping[str, str | Path]
    claims: Sequence[ClaimRecord]
    verification: str
    chapter: Sequence[Part] = ()
    standing: Sequence[ReinforcedClaim] = ()
    beside: Mapping[str, str | Path] = field(default_factory=dict)


def read_study(
    study: str,
    paths: Mapping[str, str | Path | Sequence[str]],
    results: str | Path,
    figures: Mapping[str, str | Path],
    beside: Mapping[str, str | Path] | None = None,
) -> StudyFiles:
    """Read what a report is made of: summary.csv, tiles.json, the files of designs in `results`;
    the chapter of verification, claims.json, claims_reinforced.json, the answer of explorations
    where `paths` has them. `beside` are the summaries of other studies by tag."""
    rows = read_rows(paths["summary"], SummaryRow)
    designs = [_read_design(row, Path(results, row.design)) for row in rows]
    judged, standing = (
        read_records(paths[name], kind) if name in paths else []
        for name, kind in (("claims", ClaimRecord), ("reinforced", ReinforcedClaim))
    )
    chapter = read_chapter(paths.get("fold", ()))
    chapters = [paths["verification"]] if "verification" in paths else []
    text = "".join(Path(path).read_text(encoding="utf-8") for path in chapters)
    known = study, designs, read_json(paths["tiles"]), figures, judged, text, chapter
    return StudyFiles(*known, standing, beside or {})


def _read_design(row: SummaryRow, folder: Path) -> DesignEntry:
    paths = {"final": folder / "sizing/final.json", "arrays": folder / "sizing/final.npz",
             "folded": folder / "folded/folded.npz"}  # fmt: skip
    final = read_analysis(paths["final"])
    return DesignEntry(
        row,
        final,
        read_checks(final, paths),
        read_comparison(folder / "crosscheck/comparison.json"),
        read_record(folder / "mesh_convergence.json", MeshConvergenceRecord),
        list_exports(folder),
        list_engineering(read_verdict(folder / "checks/engineering.json")),
    )


def write_study_report(
    files: StudyFiles,
    settings: StageSettings,
    provenance: Provenance,
    to_results: str,
    left_out: Mapping[str, str],
) -> str:
    """Return the report as one page; `to_results` is the way from its folder to the designs',
    `left_out` says why charts were not made.

    Raises `ValueError` where it is larger than `SIZE_MAX` bytes.
    """
    columns = choose_columns([entry.row for entry in files.designs])
    cards = [_make_card(entry, columns, to_results, files.tiles) for entry in files.designs]
    page = render(
        "study.html",
        title=f"Folded shells: study {files.study}",
        study=files.study,
        verdicts=count_verdicts([entry.row for entry in files.designs]),
        kinds=describe_kinds([entry.row for entry in files.designs]),
        worst=list_worst(files.designs),
        reading=say_both(entry.final for entry in files.designs),
        compared=next(filter(None, (say_compared(one.comparison) for one in files.designs)), ""),
        columns=columns,
        cards=cards,
        pictures=[{"name": name, "words": sheet["words"], "scale": sheet["scale"]}
                  for name, sheet in files.tiles.items()],
        figures=[_show_figure(name, path) for name, path in files.figures.items()],
        left_out=left_out,
        chapter=files.chapter,
        **_describe_claims(files),
        verification=make_verification(files.designs),
        benchmarks=render_markdown(files.verification),
        loads=describe_loads(settings),
        settings=list_settings(settings),
        study_hash=hash_study([entry.row for entry in files.designs]),
        provenance=provenance,
        data={"columns": [asdict(column) for column in columns],
              "designs": [_leave_out_first_picture(card) for card in cards]},
        to_results=to_results,
    )  # fmt: skip
    if len(page.encode()) > SIZE_MAX:
        raise ValueError(f"report of {len(page.encode())} bytes: {SIZE_MAX} at most")
    return page


def _describe_claims(files: StudyFiles) -> dict[str, Any]:
    """Return the claims, those on shells that stand, and the table of designs under several
    settings."""
    sized_for = compare_settings([entry.row for entry in files.designs], files.beside)
    return {"claims": files.claims, "standing": files.standing, "sized_for": sized_for}


def _make_card(entry: DesignEntry, columns: Sequence[Column], to_results: str, tiles: Json) -> Json:
    """Return what the report says of one design, as plain data for template and script."""
    governing = find_governing(entry.checks)
    engineering = find_governing(entry.engineering)
    row = make_row(entry.row, columns, governing)
    return {
        "name": entry.name,
        "page": f"{to_results}/{entry.name}/page.html",
        "sheet": f"{to_results}/{entry.name}/sheet.html",
        "exports": [f"{to_results}/{entry.name}/exports/{name}" for name in entry.exports],
        "values": {key: cell.value for key, cell in row.items()},
        "kinds": {key: cell.kind for key, cell in row.items() if cell.kind},
        "governing": governing.words if governing else "no check has a value",
        "engineering": engineering.words if engineering else "",
        "warning": entry.row.model_warnings or "",
        "tags": [tag for tag in entry.row.tags.split(",") if tag],
        "pictures": {name: sheet["pictures"].get(entry.name, "") for name, sheet in tiles.items()},
    }


def _leave_out_first_picture(card: Json) -> Json:
    """Return a card without the picture that its page shows already, which is large."""
    pictures = dict(list(card["pictures"].items())[1:])
    return {**card, "pictures": pictures}


def describe_kinds(rows: Sequence[SummaryRow]) -> str:
    """Return what was studied in one sentence: surfaces, sizes, supports, patterns."""
    parts = []
    for key, one, many in (("surface", "surface", "surfaces"), ("support", "kind of support",
                           "kinds of support"), ("pattern", "pattern", "patterns"),
                           ("fold_mode", "folding mode", "folding modes")):  # fmt: skip
        found = Counter(getattr(row, key) for row in rows)
        parts.append(f"{len(found)} {one if len(found) == 1 else many} ({', '.join(found)})")
    sizes = sorted({(row.span_m, row.height_m) for row in rows})
    words = ", ".join(f"{span:g}/{height:g}" for span, height in sizes)
    return f"{'; '.join(parts)}; span/height {words} m"


def list_worst(designs: Sequence[DesignEntry]) -> Table:
    """Return the worst check of each kind over all designs: which design, value, limit, share.

    Those by the paper's criteria come first, engineering ones say so.
    """
    found: dict[str, tuple[str, Check]] = {}
    for entry in designs:
        named = [replace(check, name=f"engineering: {check.name}") for check in entry.engineering]
        for check in (*entry.checks, *named):
            kind = COUNTED.sub("some ", check.name)
            known = found.get(kind)
            if check.ratio is not None and (known is None or check.ratio > known[1].ratio):
                found[kind] = (entry.name, check)
    rows = [
        (check.name, name, check.value, check.limit, describe_share(check.ratio),
         "yes" if check.met else "no", check.where)
        for name, check in found.values()
    ]  # fmt: skip
    header = ("check", "worst in", "value", "limit", "of its limit", "met", "where")
    return make_table(header, rows)


def _show_figure(name: str, path: str | Path) -> dict[str, str]:
    """Return a chart with its name, as a data URI."""
    return {"name": name.replace("_", " "), "data": embed_picture(path)}
