"""explore.html: what a search of the pattern has tried, drawn to be compared and chosen from."""

from collections.abc import Sequence
from dataclasses import dataclass

from foldshell.explore.bounds import list_bounds
from foldshell.explore.fronts import find_front, rank_by
from foldshell.explore.measures import count_broken
from foldshell.explore.tables import name_selected
from foldshell.files.whole import Json
from foldshell.records.candidate import ENGINEERED, CandidateRecord
from foldshell.records.summary import SummaryRow
from foldshell.report.markup import Cell, Table, make_table, render
from foldshell.settings.design import COLUMNS, NAMING
from foldshell.settings.exploration import AIMS, Exploration
from foldshell.settings.sizing import REINFORCED
from foldshell.settings.stage import flatten, to_plain

WORDS = {
    "candidate": "design",
    "pattern": "pattern",
    "sector_angle_deg": "sector angle [°]",
    "rest_fold_angle_deg": "rest fold angle [°]",
    "strip_grading": "grading of strips",
    "zigzag": "zig-zag lines",
    "strip": "strip lines",
    "support": "supported edges",
    "height_m": "height [m]",
    "span_m": "span [m]",
    "volume_m3": "concrete [m³]",
    "panels": "panels",
    "crease_length_m": "length of folds [m]",
    "buckling_factor_min": "least buckling factor",
    "displacement_vertical_max_m": "vertical displacement [m]",
    "area_m2": "area of the sheet [m²]",
    "plan_coverage": "share of the plan covered",
    "edge_strain_max": "largest edge strain",
    "depth_m": "depth of folds [m]",
    "cheap_m3": "concrete by one analysis [m³]",
    "span_ratio": "sides of the plan, x over y",
    "engineering_volume_m3": "concrete and steel [m³]",
    "steel_kg": "steel [kg]",
    "co2_kg": "CO₂ equivalent [kg]",
    "cost": "cost",
    "engineering": "engineering verdict",
}
DRAWN = ("volume_m3", "buckling_factor_min", "panels", "crease_length_m", "area_m2",
         "displacement_vertical_max_m", "plan_coverage", "depth_m", "cheap_m3")  # fmt: skip
LISTED = ("volume_m3", "buckling_factor_min", "panels", "displacement_vertical_max_m",
          "plan_coverage", "depth_m")  # fmt: skip
JUDGED = (*ENGINEERED, "engineering")
"""What is shown as well where the engineering checks have seen the candidates."""
TEXTS = ("engineering",)
BIAS = 0.05
"""Share from which the volume of the search is said to be another one than the confirmed."""


@dataclass(frozen=True)
class Confirmed:
    """A chosen design by the search and by the ordinary rules, volumes in m3."""

    name: str
    candidate: str
    searched: float
    confirmed: float | None
    factor: float | None
    crosscheck: str | None
    engineering: str | None
    steel: float | None
    state: str
    page: str

    @property
    def bias(self) -> float | None:
        """The confirmed volume over the one of the search, less 1."""
        return self.confirmed / self.searched - 1 if self.confirmed else None


def make_explore_page(
    exploration: Exploration,
    records: Sequence[CandidateRecord],
    rows: Sequence[SummaryRow],
    slopes: Sequence[Json] = (),
) -> str:
    """Return the page; `rows` are those of the summary of the confirmed designs, `slopes` the
    contents of slopes.json."""
    kept = rank_by([record for record in records if record.feasible], exploration.aims[0])
    confirmed = list_confirmed(exploration, records, rows)
    names = [*exploration.columns, *DRAWN, *list_judged(records)]
    return render(
        "explore.html",
        title=f"Exploration {exploration.name}",
        count=len(records),
        kept=len(kept),
        best=kept[0] if kept else None,
        aim=WORDS[exploration.aims[0]],
        aim_value=getattr(kept[0], exploration.aims[0]) if kept else None,
        bounds=find_bounds(exploration, kept[:1]),
        confirmed=_tabulate_confirmed(confirmed),
        bias=say_bias(confirmed),
        reinforced=exploration.search.measure == REINFORCED,
        excluded=[(name, count) for name, count in count_broken(records).items()],
        variables=[(WORDS.get(v.name, v.name), ", ".join(v.choices) or f"{v.low:g} to {v.high:g}")
                   for v in exploration.variables],
        limits=flatten(to_plain(exploration.limits)),
        search=flatten(to_plain(exploration.search)),
        slopes=[_draw_slopes(one) for one in slopes],
        table=_tabulate(exploration, records),
        data=_pack(exploration, records, names, {one.candidate: one.page for one in confirmed}),
    )  # fmt: skip


def list_confirmed(
    exploration: Exploration, records: Sequence[CandidateRecord], rows: Sequence[SummaryRow]
) -> list[Confirmed]:
    """Return the chosen designs with both their numbers, in the order of the summary."""
    known = {name_selected(exploration, record): record for record in records}
    return [
        Confirmed(
            row.design, known[row.design].candidate, known[row.design].volume_m3, row.volume_m3,
            row.buckling_factor_min, row.crosscheck, row.engineering, row.steel_kg_m2, row.state,
            f"confirmed/{row.design}/page.html",
        )
        for row in rows if row.design in known
    ]  # fmt: skip


def list_judged(records: Sequence[CandidateRecord]) -> list[str]:
    """Return what the engineering checks said of any candidate."""
    return [name for name in JUDGED if any(getattr(one, name) is not None for one in records)]


def say_bias(confirmed: Sequence[Confirmed]) -> str:
    """Say how far the volumes of the search are from the confirmed ones; empty without any."""
    found = [one.bias for one in confirmed if one.bias is not None]
    if not found:
        return ""
    mean, largest = sum(found) / len(found), max(found, key=abs)
    words = (
        f"the finer mesh takes {100 * mean:+.1f} % of concrete in the mean, {100 * largest:+.1f} % "
        f"at most"
    )
    far = sum(abs(one) > BIAS for one in found)
    if not far:
        return f"The search is within {100 * BIAS:g} % of what was confirmed: {words}."
    return (
        f"The search is off by more than {100 * BIAS:g} % for {far} of {len(found)} designs: "
        f"{words}. Its volumes rank designs; those that count are the confirmed ones."
    )


def find_bounds(exploration: Exploration, records: Sequence[CandidateRecord]) -> list[str]:
    """Return the variables whose range ends where the given designs stand: it decides there."""
    ends = list_bounds(exploration, records)
    return [f"{WORDS.get(name, name)} at {end:g}" for name, end in ends]


def _draw_slopes(entry: Json) -> dict:
    """Return bars of a design's slopes: words, value over the variable's range, place and width in
    a drawing 400 wide whose middle is 0."""
    largest = max((abs(one["per_range"]) for one in entry["slopes"]), default=1.0) or 1.0
    bars = []
    for one in sorted(entry["slopes"], key=lambda one: -abs(one["per_range"])):
        width = 190 * abs(one["per_range"]) / largest
        start = 200 if one["per_range"] > 0 else 200 - width
        name = WORDS.get(one["variable"], one["variable"])
        bars.append({"words": name, "value": one["per_range"], "width": width, "start": start})
    return {"name": entry["candidate"], "reason": entry["reason"], "residual": entry["residual"],
            "bars": bars}  # fmt: skip


def _tabulate_confirmed(confirmed: Sequence[Confirmed]) -> Table | None:
    if not confirmed:
        return None
    header = ("design", "concrete in the search [m³]", "confirmed [m³]", "difference [%]",
              "least buckling factor", "second code", "engineering verdict",
              "steel [kg/m²]", "state")  # fmt: skip
    rows = [
        (one.name, one.searched, one.confirmed, None if one.bias is None else 100 * one.bias,
         one.factor, one.crosscheck, one.engineering, one.steel, one.state)
        for one in confirmed
    ]  # fmt: skip
    return make_table(header, rows)


def _tabulate(exploration: Exploration, records: Sequence[CandidateRecord]) -> Table:
    names, listed = exploration.columns, [*LISTED, *list_judged(records)]
    header = [WORDS["candidate"], *(WORDS.get(n, n) for n in (*names, *listed)), "state"]
    rows = [
        [
            record.candidate, *(record.value_of(name) for name in names),
            *(getattr(record, name) for name in listed),
            Cell("keeps all limits", "good") if record.feasible
            else Cell(", ".join(record.broken) or record.state, "bad"),
        ]
        for record in rank_by(records, exploration.aims[0])
    ]  # fmt: skip
    return make_table(header, rows)


def _pack(
    exploration: Exploration, records: Sequence[CandidateRecord], names: Sequence[str], pages: dict
) -> dict:
    front = find_front([r for r in records if r.feasible], _pair(exploration))
    marked = {record.candidate for record in front}
    return {
        "columns": [{"key": name, "words": WORDS.get(name, name),
                     "text": _is_text(records, name),
                     "better": AIMS.get(name, 0)} for name in names],
        "aims": list(_pair(exploration)),
        "table": [column for column in COLUMNS if column not in NAMING],
        "designs": [
            {
                "name": record.candidate, "round": int(record.candidate.split("-")[0]),
                "row": record.columns, "state": record.state, "feasible": record.feasible,
                "broken": list(record.broken), "front": record.candidate in marked,
                "page": pages.get(record.candidate, ""), "shape": record.geometry or "",
                "values": [_value(record, name) for name in names],
            }
            for record in records
        ],
    }  # fmt: skip


def _pair(exploration: Exploration) -> tuple[str, str]:
    first = exploration.aims[0]
    if len(exploration.aims) == 2:
        return first, exploration.aims[1]
    return first, "buckling_factor_min" if first != "buckling_factor_min" else "volume_m3"


def _is_text(records: Sequence[CandidateRecord], name: str) -> bool:
    return name in TEXTS or any(isinstance(one.columns.get(name), str) for one in records)


def _value(record: CandidateRecord, name: str) -> object:
    value = getattr(record, name) if name in (*DRAWN, *JUDGED) else record.value_of(name)
    return float(f"{value:.6g}") if isinstance(value, float) else value
