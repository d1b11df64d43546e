"""What explorations have come to: their tables, beside Table 1 and the smooth shell."""

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from foldshell.explore.fronts import sweep_front
from foldshell.files.errors import InputError
from foldshell.files.whole import read_json
from foldshell.records.candidate import SIZED, is_found
from foldshell.records.rivals import FOUND, KEPT, SMOOTH, TABLE, JudgedRow, ResizedRow, name_kind
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.settings.field import Plain

Record = TypeVar("Record")
MEASURES = ("paper", "reinforced")
KINDS = (FOUND, TABLE, SMOOTH)


@dataclass(frozen=True)
class Point:
    """A design of an exploration on the mesh of its search: volume (m3), least buckling factor,
    panels, what it is, zig-zag and strip lines, length and depth of folds (m), area (m2), largest
    strain of an edge, planarity, share of the plan that it covers."""

    name: str
    volume: float
    factor: float
    panels: int
    kind: str
    feasible: bool
    state: str = SIZED
    layout: tuple[int, int] | None = None
    edge_beam: bool = False
    creases: float = 0.0
    depth: float = 0.0
    area: float = 0.0
    strain: float | None = None
    planarity: float | None = None
    coverage: float | None = None


@dataclass(frozen=True)
class Searched:
    """An exploration: its points, the confirmed designs, the rivals, what was searched, and how
    many designs of round 0 nobody has sized (`unseen`)."""

    name: str
    points: tuple[Point, ...]
    confirmed: tuple[SummaryRow, ...] = ()
    resized: tuple[ResizedRow, ...] = ()
    judged: dict[str, tuple[JudgedRow, ...]] = field(default_factory=dict)
    about: Plain = field(default_factory=dict)
    tried: int = 0
    first: dict[str, str] = field(default_factory=dict)
    unseen: int = 0

    @property
    def title(self) -> str:
        """What roof it is, in words."""
        base = self.about.get("exploration", {}).get("base") or self.first
        if not base:
            return self.name
        edges = {"zigzag": "zig-zag edges", "strip": "strip edges", "all": "all edges"}
        return f"{base['surface']}, {edges.get(base['support'], base['support'])}"

    def of(self, kind: str) -> list[Point]:
        """Return the points of a kind, the lightest first; found ones keep all limits."""
        kept = [p for p in self.points if p.kind == kind and (p.feasible or kind != FOUND)]
        return sorted(kept, key=lambda point: (point.volume, point.name))

    def lightest(self, factor: float) -> Point | None:
        """Return the lightest found design with at least a buckling factor."""
        return next((point for point in self.of(FOUND) if point.factor >= factor), None)

    def point_of(self, design: str) -> Point | None:
        """Return the point of a design whose name ends in that of a candidate."""
        return next((point for point in self.points if design.endswith(point.name)), None)

    def judged_as(self, measure: str, kind: str) -> JudgedRow | None:
        """Return the row of a kind by a measure, none where it has no volume."""
        rows = self.judged.get(measure, ())
        return next((row for row in rows if row.kind == kind and row.volume_m3), None)

    def resized_as(self, kind: str) -> list[ResizedRow]:
        """Return the rows of a kind that were sized and keep their factor within 1 %."""
        return [
            row for row in self.resized
            if row.kind == kind and row.state == SIZED and row.volume_m3
            and (row.buckling_factor_min is None or row.buckling_factor_min > KEPT * row.factor_due)
        ]  # fmt: skip

    def was_sized(self, kind: str, factor: float) -> bool:
        """Tell whether a kind was sized for a factor, whatever came of it."""
        return any(row.kind == kind and row.factor_due == factor for row in self.resized)

    def resized_for(self, kind: str, factor: float) -> ResizedRow | None:
        """Return the row of a kind for one buckling factor."""
        return next((row for row in self.resized_as(kind) if row.factor_due == factor), None)


def find_front(points: Iterable[Point], gain: Callable[[Point], float]) -> list[Point]:
    """Return the points that none beats in both volume and what `gain` gives (more is better)."""
    ordered = sorted(points, key=lambda one: one.name)
    return sweep_front(ordered, lambda one: one.volume, lambda one: -gain(one))


def read_searched(table: str | Path) -> Searched:
    """Read explore.tsv of an exploration, and what stands beside it: confirmed.csv, rivals/.

    Raises
    ------
    InputError
        for a table that is none.
    """
    path = Path(table)
    try:
        rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")), delimiter="\t"))
        first = _read_first(path.parent / "rounds/00/candidates.tsv")
        points = tuple(_make_point(row, first) for row in rows if row["volume_m3"])
    except (OSError, KeyError, ValueError) as error:
        raise InputError(f"{path}: is not the table of an exploration: {error}") from None
    rivals = path.parent / "rivals"
    about = rivals / "about.json"
    return Searched(
        path.parent.name,
        points,
        _read_beside(path.with_name("confirmed.csv"), SummaryRow),
        _read_beside(rivals / "resized.csv", ResizedRow),
        {measure: _read_beside(rivals / f"{measure}.csv", JudgedRow) for measure in MEASURES},
        read_json(about) if about.is_file() else {},
        sum(is_found(row["candidate"]) for row in rows),
        next(iter(first.values()), {}),
        len(first.keys() - {row["candidate"] for row in rows}),
    )


def _read_beside(path: Path, kind: type[Record]) -> tuple[Record, ...]:
    """Return the rows of a table that may be missing or empty."""
    there = path.is_file() and path.stat().st_size
    return tuple(read_rows(path, kind)) if there else ()


def _read_first(path: Path) -> dict[str, dict[str, str]]:
    """Return the columns of the designs of round 0, which the table of an exploration leaves out
    where they are no variables."""
    if not path.is_file():
        return {}
    rows = csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")), delimiter="\t")
    return {row["design"]: row for row in rows}


def _make_point(row: dict[str, str], first: dict[str, dict[str, str]]) -> Point:
    given = row | first.get(row["candidate"], {})
    layout = (int(given["zigzag"]), int(given["strip"])) if "zigzag" in given else None
    return Point(
        row["candidate"], float(row["volume_m3"]), float(row["buckling_factor_min"] or "inf"),
        int(row["panels"]), name_kind(row["candidate"], row["pattern"]),
        row["feasible"] == "True", row["state"], layout,
        float(given.get("edge_beam_depth_m") or 0) != 0,  # below the shell where it is negative
        *(float(row[key] or 0) for key in ("crease_length_m", "depth_m", "area_m2")),
        *(float(row[key]) if row[key] else None for key in
          ("edge_strain_max", "planarity_max", "plan_coverage")),
    )  # fmt: skip


def choose_point(one: Searched, kind: str) -> Point | None:
    """Return the point of the shell of a kind that was sized again, else the lightest one."""
    judged, resized = one.judged_as("paper", kind), one.resized_as(kind)
    name = judged.design if judged else resized[0].candidate if resized else ""
    return one.point_of(name) if name else None


def list_found(searched: Sequence[Searched]) -> list[str]:
    """Return the names of the designs that were confirmed: sized, the limit of the factor kept
    within 1 %, and both codes of one mind."""
    return [
        row.design
        for one in searched
        for row in one.confirmed
        if row.state in ("converged", "at_minimum_thickness") and row.crosscheck == "pass"
        and (row.buckling_factor_min or float("inf")) > KEPT * _least_factor(one)
    ]  # fmt: skip


def _least_factor(one: Searched) -> float:
    return one.about.get("exploration", {}).get("limits", {}).get("buckling_factor_min", 0.0)
