"""Load cases that a model states load by load: zones, plan areas, lines and points.

Format 4 of the neutral model lists them under `load_cases`, in place of the paper's five.
"""

from dataclasses import dataclass

import numpy as np

from crosscheck.reading import Place

KINDS = ("weight", "pressure", "force", "line")
AREAS = ("sheet", "plan_abs", "plan_net", "plan_up", "footprint")
SIDES = ("x-", "x+", "y-", "y+")
AGAINST_NORMAL = "against_normal"


@dataclass(frozen=True)
class Zone:
    """Where a load acts: one of these is given, or none for the whole sheet."""

    polygon: np.ndarray | None = None  # (K, 2) m in plan
    side: str = ""  # of the middle of the plan
    panels: np.ndarray | None = None  # (P,) numbers
    points: np.ndarray | None = None  # (K, 2) m in plan: a point, or the corners of a line


@dataclass(frozen=True)
class Variation:
    """A factor that is linear between places along an axis, and constant beyond them."""

    axis: int
    places: np.ndarray  # (K,) m
    factors: np.ndarray  # (K,)


@dataclass(frozen=True)
class OwnLoad:
    """One load of a case; `direction` (3,) is None for against the facets' normals."""

    case: str
    kind: str  # of KINDS
    value: float  # kN/m3, kN/m2, kN or kN/m
    direction: np.ndarray | None
    area: str  # of AREAS
    zone: Zone
    variation: Variation | None

    @property
    def is_even(self) -> bool:
        """Whether it is the same all over each facet that it acts on."""
        cut = self.zone.polygon is not None or self.zone.side or self.zone.points is not None
        return not cut and self.variation is None and self.area != "footprint"


def read_own_loads(place: Place, panels: int) -> tuple[OwnLoad, ...]:
    """The loads of a list of objects; raises CrosscheckError with the place in the file."""
    return tuple(_read_load(entry, panels) for entry in place.entries())


def _read_load(place: Place, panels: int) -> OwnLoad:
    direction = place.key("direction")
    vector = None
    if direction.value != AGAINST_NORMAL:
        vector = np.array(direction.row(3))
        if abs(np.linalg.norm(vector) - 1) > 1e-9:
            direction.refuse(direction.value, f"{AGAINST_NORMAL} or a vector of length 1")
    return OwnLoad(
        case=place.key("case").text(),
        kind=place.key("kind").one_of(list(KINDS)),
        value=place.key("value").number(),
        direction=vector,
        area=place.key("area", "sheet").one_of(list(AREAS)),
        zone=_read_zone(place.key("zone", {}), panels),
        variation=_read_variation(place),
    )


def _read_zone(place: Place, panels: int) -> Zone:
    names = place.names()
    if not names:
        return Zone()
    if len(names) > 1 or names[0] not in ("polygon_m", "side", "panels", "points_m"):
        place.refuse(", ".join(names), "one of polygon_m, side, panels, points_m")
    own = place.key(names[0])
    if names[0] == "side":
        return Zone(side=own.one_of(list(SIDES)))
    if names[0] == "panels":
        return Zone(panels=own.indices(None, panels))
    if names[0] == "polygon_m":
        return Zone(polygon=own.numbers(2))
    return Zone(points=own.numbers(2))


def _read_variation(place: Place) -> Variation | None:
    if "variation" not in place.names():
        return None
    own = place.key("variation")
    axis = ["x", "y", "z"].index(own.key("axis").one_of(["x", "y", "z"]))
    return Variation(axis, own.key("places_m").numbers(None), own.key("factors").numbers(None))


def list_own_cases(loads: tuple[OwnLoad, ...]) -> tuple[str, ...]:
    """The names of the cases, each once, in the order of the file."""
    return tuple(dict.fromkeys(load.case for load in loads))
