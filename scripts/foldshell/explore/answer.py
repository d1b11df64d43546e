"""What a fold buys and what it costs: explorations beside Table 1 and the smooth shell."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from foldshell.files.errors import InputError


@dataclass(frozen=True)
class Point:
    """A design of an exploration: volume (m3), least buckling factor, panels, where it comes from
    (table, smooth, found), whether it keeps all limits."""

    name: str
    volume: float
    factor: float
    panels: int
    kind: str
    feasible: bool


@dataclass(frozen=True)
class Searched:
    """An exploration: its name, its points, the confirmed volumes (m3) by candidate."""

    name: str
    points: tuple[Point, ...]
    confirmed: dict[str, float]

    def of(self, kind: str) -> list[Point]:
        """Return the points of a kind, the lightest first; found ones keep all limits."""
        kept = [p for p in self.points if p.kind == kind and (p.feasible or kind != "found")]
        return sorted(kept, key=lambda point: (point.volume, point.name))

    def lightest(self, factor: float) -> Point | None:
        """Return the lightest found design with at least a buckling factor."""
        kept = [point for point in self.of("found") if point.factor >= factor]
        return kept[0] if kept else None

    @property
    def front(self) -> list[Point]:
        """The found designs that none beats in both volume and buckling factor."""
        front: list[Point] = []
        for point in self.of("found"):
            if not front or point.factor > front[-1].factor:
                front.append(point)
        return front


def read_searched(table: str | Path) -> Searched:
    """Read explore.tsv of an exploration, and confirmed.csv beside it where there is one.

    Raises
    ------
    InputError
        for a table that is none.
    """
    path = Path(table)
    try:
        rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")), delimiter="\t"))
        points = tuple(_make_point(row) for row in rows if row["volume_m3"])
        confirmed = path.with_name("confirmed.csv")
        text = confirmed.read_text(encoding="utf-8") if confirmed.is_file() else ""
        told = {row["design"][-5:]: float(row["volume_m3"])
                for row in csv.DictReader(io.StringIO(text)) if row["volume_m3"]}  # fmt: skip
    except (OSError, KeyError, ValueError) as error:
        raise InputError(f"{path}: is not the table of an exploration: {error}") from None
    return Searched(path.parent.name, points, told)


def _make_point(row: dict[str, str]) -> Point:
    first = row["candidate"].startswith("00")
    kind = ("smooth" if row["pattern"] == "smooth" else "table") if first else "found"
    return Point(
        row["candidate"], float(row["volume_m3"]), float(row["buckling_factor_min"] or "inf"),
        int(row["panels"]), kind, row["feasible"] == "True",
    )  # fmt: skip


def write_answer(searched: Sequence[Searched], picture: str) -> str:
    """Return the answer as Markdown: a table of all explorations, and what it comes to."""
    header = (
        "| exploration | lightest of the table [m³] (factor) | smooth shell [m³] (factor) | "
        "lightest found [m³] (factor, panels) | confirmed [m³] | found against table | "
        "found at the smooth shell's factor [m³] |"
    )
    lines = [header, "|---" * 7 + "|"]
    lines += ["| " + " | ".join(_make_row(one)) + " |" for one in searched]
    words = [_conclude(one) for one in searched]
    chart = f"![concrete against buckling factor]({picture})"
    title = "# What the fold buys, and what it costs"
    return "\n".join([title, "", *lines, "", chart, "", *words, ""])


def _make_row(one: Searched) -> list[str]:
    table, smooth, found = (one.of(kind)[:1] for kind in ("table", "smooth", "found"))
    same = one.lightest(smooth[0].factor) if smooth else None
    confirmed = one.confirmed.get(found[0].name) if found else None
    gain = f"{100 * (found[0].volume / table[0].volume - 1):+.0f} %" if found and table else "-"
    return [
        one.name,
        _say(table[0]) if table else "-",
        _say(smooth[0]) if smooth else "-",
        f"{found[0].volume:.1f} ({found[0].factor:.1f}, {found[0].panels})" if found else "none",
        f"{confirmed:.1f}" if confirmed else "-",
        gain,
        f"{same.volume:.1f} ({same.factor:.1f})" if same else "-",
    ]


def _say(point: Point) -> str:
    return f"{point.volume:.1f} ({point.factor:.1f})"


def _conclude(one: Searched) -> str:
    """Say in a sentence what a search found beside the table and the smooth shell."""
    table, smooth, found = (one.of(kind)[:1] for kind in ("table", "smooth", "found"))
    if not (found and smooth and table):
        return f"- {one.name}: no design keeps all limits, or there is nothing to compare with."
    best, plain = found[0], smooth[0]
    less = "less" if best.volume < plain.volume else "more"
    change = abs(100 * (best.volume / plain.volume - 1))
    return (
        f"- {one.name}: {100 * (1 - best.volume / table[0].volume):.0f} % less concrete than the "
        f"lightest of the table; {change:.0f} % {less} than the smooth shell, at "
        f"{best.factor / plain.factor:.1f} times its buckling factor."
    )
