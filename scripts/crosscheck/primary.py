"""The other code's values, read from `primary.json`."""

from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

import numpy as np

from crosscheck.extrapolation import PRIMARY_ORDER
from crosscheck.panel_steel import Laid
from crosscheck.reading import Place, read_json
from crosscheck.steel import Bars
from crosscheck.values import KINDS, SECOND_ORDER, SUPPORTS, Code

VECTORS = ("reaction_sum_kn", "load_sum_kn")


def read_reason(path: str | Path) -> str | None:
    """Why the primary code has no values (a mechanism), None where it has some."""
    root = Place(Path(path).name, "", read_json(path))
    return root.key("reason").text() if "reason" in root.names() else None


def read_primary(path: str | Path, combinations: Iterable[str]) -> Code:
    """Read and check the primary code's values of the given combinations, a value a mesh.

    Raises CrosscheckError naming file, place and value. Keys that are not compared are ignored.
    """
    root = Place(Path(path).name, "", read_json(path))
    subdivisions = [place.number(least=1.0) for place in root.key("subdivisions").entries()]
    if any(fine <= coarse for coarse, fine in pairwise(subdivisions)):
        root.key("subdivisions").refuse(subdivisions, "numbers that increase")
    orders = root.key("orders", {})
    values = {}
    for name in combinations:
        entry = root.key("combinations").key(name)
        values[name] = _read_values(entry, len(subdivisions))
        for vector in VECTORS:
            entry.key(vector)
        if "second_order" in entry.names() and entry.value["second_order"] is not None:
            second = _read_values(entry.key("second_order"), len(subdivisions))
            values[f"{name} {SECOND_ORDER}"] = second
    return Code(
        [int(n) if n == int(n) else n for n in subdivisions],
        values,
        {name: orders.key(name).number(above=0.0) for name in orders.names()},
        root.key("order", PRIMARY_ORDER).number(above=0.0),
    )


def read_reinforcement(path: str | Path) -> tuple[Laid, dict[str, list[float]]] | None:
    """What the sheet is reinforced with, and the primary code's values of it, a value a mesh.

    None where nothing is reinforced. Raises CrosscheckError as `read_primary`.
    """
    root = Place(Path(path).name, "", read_json(path))
    if "reinforcement" not in root.names():
        return None
    place = root.key("reinforcement")
    laid, given = place.key("laid"), place.key("quantities")
    meshes = len(root.key("subdivisions").entries())
    two = laid.key("two_layers_from_m")
    bars = Bars(
        level=laid.key("level_m").number(above=0.0),
        two_from=np.inf if two.value is None else two.number(above=0.0),
        mesh_lever=laid.key("central_lever_ratio").number(above=0.0),
        yield_=laid.key("yield_kpa").number(above=0.0),
        crush=laid.key("crush_kpa").number(above=0.0),
        density=laid.key("density_kg_m3").number(above=0.0),
    )
    found = Laid(
        bars,
        laid.key("strip_m").number(above=0.0),
        laid.key("shear_strip_m").number(above=0.0),
        bool(laid.key("diagonals").value),
        tuple(one.text() for one in place.key("combinations").entries()),
    )
    return found, {name: _read_meshes(given.key(name), meshes) for name in given.names()}


def _read_values(place: Place, meshes: int) -> dict[str, list]:
    """The known quantities of one combination: a number, or a vector, a mesh."""
    values: dict[str, list] = {}
    for name in place.names():
        if name in VECTORS:
            values[name] = _read_meshes(place.key(name), meshes, 3)
        elif name in KINDS:
            values[name] = _read_meshes(place.key(name), meshes)
        elif name == SUPPORTS:
            given = place.key(name)
            found = {one: _read_meshes(given.key(one), meshes, 3) for one in given.names()}
            values[name] = [{one: found[one][mesh] for one in found} for mesh in range(meshes)]
    return values


def _read_meshes(place: Place, meshes: int, width: int | None = None) -> list:
    """A number, or a row of numbers, of each mesh."""
    entries = place.entries()
    if len(entries) != meshes:
        place.refuse(f"{len(entries)} values", f"{meshes}, one a mesh")
    return [entry.number() if width is None else entry.row(width) for entry in entries]
