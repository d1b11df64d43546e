"""candidate.json: a design that a search of the crease pattern has tried."""

from dataclasses import asdict, dataclass
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.whole import read_json, write_json
from foldshell.records.entry import COUNT, entry, same
from foldshell.records.reinforcement import ReinforcementRecord
from foldshell.settings.exploration import SPAN_RATIO

ANGLES = ("sector_angle_deg", "rest_fold_angle_deg")
"""Of a sheet, also where its columns leave them to the settings."""
MEASURES = (
    "volume_m3", "area_m2", "panels", "crease_length_m", "buckling_factor_min",
    "displacement_vertical_max_m", "utilization_panel_mean_max", "iterations", "cheap_m3",
    "plan_coverage", "edge_strain_max", "planarity_max", "depth_m", "mesh_subdivisions",
)  # fmt: skip
"""What tables say of a candidate, besides its columns."""
ENGINEERED = ("engineering_volume_m3", "steel_kg", "co2_kg", "cost")
"""The same of one that the engineering checks have seen."""
SIZED = "sized"
"""State of a candidate that ended as Table 3 of the paper asks."""


def is_found(candidate: str) -> bool:
    """Tell whether a search has found a candidate; those of round 00 are what it is held against:
    rows of the table and the smooth shell."""
    return not candidate.startswith("00")


@dataclass(frozen=True, kw_only=True)
class CandidateRecord:
    """The contents of candidate.json: a design that a search has tried."""

    candidate: str = entry("round and number in it")
    columns: dict[str, float | int | str] = entry("columns of the table of designs")
    state: str = entry(
        "sized; crumpled or not_reached in folding; not_converged, unstable or mechanism"
    )
    reason: str = entry("why, in words")
    verdict: str | None = entry("verdict of the thickness loop", left_out=True)
    feasible: bool = entry("whether it keeps all limits of the exploration")
    broken: tuple[str, ...] = entry("limits that it breaks")
    plan_coverage: float | None = entry("share of the plan covered", "-", left_out=True)
    edge_strain_max: float | None = entry("largest edge strain", "-", left_out=True)
    planarity_max: float | None = entry("largest distance of diagonals over length", "-",
                                        left_out=True)  # fmt: skip
    sector_angle_deg: float | None = entry("of its Miura sheet", "deg", left_out=True)
    rest_fold_angle_deg: float | None = entry("of its Miura sheet", "deg", left_out=True)
    depth_m: float | None = entry("depth of the folds in the rest state", "m", left_out=True)
    panels: int | None = entry("number of panels", COUNT, left_out=True)
    crease_length_m: float | None = entry("length of all folds", "m", left_out=True)
    cheap_m3: float | None = entry(
        "volume by one analysis at the start thickness, n = 1, resized once", "m3", left_out=True
    )
    area_m2: float | None = entry("area of the sheet", "m2", left_out=True)
    volume_m3: float | None = entry("volume of concrete of the sized shell", "m3", left_out=True)
    buckling_factor_min: float | None = entry("least buckling factor", "-", left_out=True)
    displacement_vertical_max_m: float | None = entry("largest downward", "m", left_out=True)
    utilization_panel_mean_max: float | None = entry("largest panel mean", "-", left_out=True)
    iterations: int | None = entry("analyses of the loop", COUNT, left_out=True)
    engineering: str | None = entry(
        "engineering verdict, no error of the mesh taken off; where aims or limits ask for it",
        left_out=True,
    )
    engineering_reason: str | None = entry("why, in words", left_out=True)
    engineering_volume_m3: float | None = entry(
        "concrete and steel of a shell sized by measure reinforced", "m3", left_out=True
    )
    steel_kg: float | None = same(ReinforcementRecord, "steel_kg", left_out=True)
    co2_kg: float | None = same(ReinforcementRecord, "co2_kg", left_out=True)
    cost: float | None = same(ReinforcementRecord, "cost", left_out=True)
    mesh_subdivisions: int = entry("subdivisions of a facet edge", COUNT)
    geometry: str | None = entry(
        "vertices by 3 and panels by 4, for thumbnails: base64 of 16-bit numbers", left_out=True
    )

    def value_of(self, column: str) -> object:
        """Return what it has in a column, an angle also where the settings gave it, or the ratio of
        its sides."""
        if column == SPAN_RATIO:
            x, y = (float(self.columns.get(side) or 0) for side in ("span_x_m", "span_y_m"))
            return float(f"{x / y:.6g}") if x and y else 1.0
        return getattr(self, column) if column in ANGLES else self.columns[column]


def list_measures(judged: bool) -> tuple[str, ...]:
    """Return what tables say of a candidate: more where engineering checks have seen it."""
    return (*MEASURES, *ENGINEERED) if judged else MEASURES


@dataclass(frozen=True, kw_only=True)
class ScreenedRecord:
    """A design that was folded and analysed once, as a cheap answer before any is sized."""

    columns: dict[str, float | int | str] = entry("columns of the table of designs")
    cheap_m3: float | None = entry("volume by one analysis", "m3")
    broken: tuple[str, ...] = entry("limits of geometry that it breaks")
    reason: str = entry("why there is no answer", default="")


def write_candidate_record(path: str | Path, record: CandidateRecord) -> None:
    """Write candidate.json; what there is no value of is left out."""
    write_json(path, {key: value for key, value in asdict(record).items() if value is not None})


def read_candidate_record(path: str | Path) -> CandidateRecord:
    """Read candidate.json.

    Raises
    ------
    InputError
        for a file that is none, or one of another version.
    """
    try:
        data = read_json(path)
        return CandidateRecord(**{**data, "broken": tuple(data["broken"])})
    except (OSError, ValueError, TypeError, KeyError):
        raise InputError(
            f"{path}: is not a candidate of this version: delete it and start again"
        ) from None
