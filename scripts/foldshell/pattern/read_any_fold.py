"""FOLD files of any program: frames, creases, faces; what is missing is found, or refused."""

import math
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.strict_json import read_json_object
from foldshell.files.units import agree_on_unit, find_fold_unit
from foldshell.files.whole import Json
from foldshell.pattern.panel_graph import (
    Ragged,
    find_sides,
    make_ragged,
    measure_area,
    walk_faces,
)
from foldshell.pattern.panel_mesh import ASSIGNMENTS, PanelMesh

LEVEL = 1e-6  # of the size: a state whose heights differ less is flat


def read_any_fold(path: str | Path, file_unit: str | None = None) -> PanelMesh:
    """Read a FOLD file 1.0 to 1.2 of any program.

    The flat state is the first frame that is flat; the folded one the last that is not; a frame
    titled `rest` is the rest state. Faces that are missing are found by walking around the flat
    pattern. `file_unit` is that of the coordinates where the file declares none. Raises
    `InputError`.
    """
    data = read_json_object(path, "a FOLD file")
    frames = _list_frames(path, data)
    unit = agree_on_unit(path, find_fold_unit(path, data), file_unit)
    states = [_read_state(path, frame, k) for k, frame in enumerate(frames)]
    known = [(k, state) for k, state in enumerate(states) if state is not None]
    if not known:
        raise InputError(f"{path}: vertices_coords: missing: rows of 2 or 3 coordinates are needed")
    top = frames[known[0][0]]
    points = known[0][1]
    flat = next((state for _, state in known if _is_flat(state)), None)
    notes: list[str] = []
    if flat is not None:
        flat = _lay_level(flat, notes)
    panels = _read_faces(path, top, len(points), flat)
    edges, letters, angles = _read_edges(path, top, len(points), panels)
    panels = _face_up(panels, flat, notes)
    folded = [(k, s) for k, s in known if not _is_flat(s) and len(s) == len(points)]
    rest = next((s for k, s in folded if frames[k].get("frame_title") == "rest"), None)
    if any(len(state) != len(points) for _, state in known):
        raise InputError(f"{path}: vertices_coords: frames of different numbers of vertices")
    return PanelMesh(
        panels, edges, letters, angles,
        *(None if s is None else unit * s for s in (flat, rest, folded[-1][1] if folded else None)),
        sets=_read_sets(path, data, len(points)), notes=tuple(notes),
    )  # fmt: skip


def _list_frames(path: str | Path, data: Json) -> list[Json]:
    """The top frame and those after it, each with what it inherits."""
    given = data.get("file_frames", [])
    if not isinstance(given, list) or not all(isinstance(frame, dict) for frame in given):
        raise InputError(f"{path}: file_frames: a list of objects is needed")
    frames = [data, *given]
    whole: list[Json] = []
    for k, frame in enumerate(frames):
        parent = frame.get("frame_parent") if k and frame.get("frame_inherit") else None
        if parent is None:
            whole.append({key: v for key, v in frame.items() if key != "file_frames"})
            continue
        if type(parent) is not int or not 0 <= parent < k:
            raise InputError(
                f"{path}: frame {k}: frame_parent {parent!r}: a frame before it, 0 to {k - 1}, is "
                "allowed"
            )
        whole.append({**whole[parent], **frame})
    return whole


def _read_state(path: str | Path, frame: Json, k: int) -> np.ndarray | None:
    rows = frame.get("vertices_coords")
    if rows is None:
        return None
    place = f"{path}: {f'frame {k}: ' if k else ''}vertices_coords"
    if not isinstance(rows, list) or not rows:
        raise InputError(f"{place}: rows of 2 or 3 coordinates are needed")
    width = len(rows[0]) if isinstance(rows[0], list) else 0
    for number, row in enumerate(rows):
        fits = isinstance(row, list) and len(row) == width and width in (2, 3)
        if not fits or not all(type(x) in (int, float) and abs(x) < 1e12 for x in row):
            raise InputError(
                f"{place}: row {number}: {repr(row)[:60]}: as many numbers as in the others, 2 or "
                "3, are allowed"
            )
    values = np.array(rows, dtype=float)
    return np.column_stack([values, np.zeros((len(values), 3 - width))])


def _is_flat(points: np.ndarray) -> bool:
    centred = points - points.mean(axis=0)
    size = np.ptp(points, axis=0).max()
    return bool(np.linalg.svd(centred, full_matrices=False)[1][-1] <= LEVEL * size)


def _lay_level(flat: np.ndarray, notes: list[str]) -> np.ndarray:
    """A flat state in the plane z = 0, as it stands there or turned into it."""
    size = np.ptp(flat, axis=0).max()
    if np.ptp(flat[:, 2]) <= LEVEL * size:
        return flat * [1, 1, 0]
    axes = np.linalg.svd(flat - flat.mean(axis=0), full_matrices=False)[2]
    normal = axes[2] * np.sign(axes[2][np.abs(axes[2]).argmax()])
    across = np.cross(normal, [0, 0, 1.0])
    cosine, sine = normal[2], np.linalg.norm(across)
    across /= sine
    turn = (
        cosine * np.eye(3)
        + sine * np.cross(np.eye(3), across).T
        + (1 - cosine) * np.outer(across, across)
    )
    notes.append("the flat sheet was turned into the plane z = 0")
    return (flat @ turn.T) * [1, 1, 0]


def _read_faces(path: str | Path, frame: Json, count: int, flat: np.ndarray | None) -> Ragged:
    rows = frame.get("foldshell:panels", frame.get("faces_vertices"))
    if rows is not None:
        faces = _read_rows(path, "faces_vertices", rows, count, 3)
        for number, face in enumerate(faces):
            if len(set(face)) < len(face):
                raise InputError(f"{path}: faces_vertices: face {number}: a vertex stands twice")
        return make_ragged(faces)
    if flat is None:
        raise InputError(
            f"{path}: faces_vertices: missing, and there is no flat frame to find them"
        )
    edges = np.array(_read_rows(path, "edges_vertices", frame.get("edges_vertices"), count, 2))
    faces = walk_faces(flat[:, :2], edges)
    if not faces:
        raise InputError(f"{path}: edges_vertices: the edges enclose no face")
    return make_ragged(faces)


def _read_rows(path: str | Path, key: str, rows: object, count: int, least: int) -> list[list[int]]:
    if not isinstance(rows, list) or not rows:
        raise InputError(f"{path}: {key}: a list of lists of vertices is needed")
    for number, row in enumerate(rows):
        fits = isinstance(row, list) and len(row) >= least and (least > 2 or len(row) == 2)
        if not fits or not all(type(x) is int and 0 <= x < count for x in row):
            size = "2" if least == 2 else "3 or more"
            raise InputError(
                f"{path}: {key}: row {number}: {repr(row)[:60]}: {size} vertices of 0 to "
                f"{count - 1} are allowed"
            )
    return rows


def _read_edges(
    path: str | Path, frame: Json, count: int, panels: Ragged
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges (E, 2), letters (E,), fold angles (E,) [rad]; sides of panels without one are added."""
    given = frame.get("edges_vertices")
    edges = [] if given is None else _read_rows(path, "edges_vertices", given, count, 2)
    letters = _read_letters(path, frame.get("edges_assignment"), len(edges))
    angles = _read_angles(path, frame.get("edges_foldAngle"), len(edges))
    known: dict[tuple[int, int], int] = {}
    for number, (a, b) in enumerate(edges):
        key = (min(a, b), max(a, b))
        if key in known or a == b:
            raise InputError(f"{path}: edges_vertices: row {number}: [{a}, {b}]: stands twice")
        known[key] = number
    sides, _, number_of_panels = find_sides(panels)
    inside = set(map(tuple, sides.tolist()))
    loose = [key for key in known if key not in inside]
    if loose and "foldshell:panels" not in frame:
        raise InputError(
            f"{path}: edges_vertices: row {known[loose[0]]}: {list(loose[0])}: an edge of no face"
        )
    for (a, b), number in zip(sides.tolist(), number_of_panels, strict=True):
        place = known.get((a, b))
        if place is None:
            edges, letters = [*edges, [a, b]], [*letters, "B" if number == 1 else "U"]
            angles = [*angles, math.nan]
        elif number == 1 and letters[place] != "B":
            letters[place] = "B"
    return np.array(edges), np.array(letters), np.array(angles)


def _read_sets(path: str | Path, data: Json, count: int) -> dict[str, np.ndarray]:
    """Sets of vertices by name, of the key foldshell:sets of the top frame."""
    given = data.get("foldshell:sets", {})
    if not isinstance(given, dict):
        raise InputError(f"{path}: foldshell:sets: lists of vertices by name are needed")
    for name, rows in given.items():
        known = isinstance(rows, list) and all(type(v) is int and 0 <= v < count for v in rows)
        if not known or not rows:
            raise InputError(
                f"{path}: foldshell:sets: {name}: a list of vertices of 0 to {count - 1} is needed"
            )
    return {name: np.array(rows, dtype=np.int64) for name, rows in given.items()}


def _read_letters(path: str | Path, given: object, count: int) -> list[str]:
    if given is None:
        return ["U"] * count
    if not isinstance(given, list) or len(given) != count:
        raise InputError(
            f"{path}: edges_assignment: one letter for each of {count} edges is needed"
        )
    letters = [letter.upper() if isinstance(letter, str) else letter for letter in given]
    letters = ["F" if letter == "J" else letter for letter in letters]
    for number, letter in enumerate(letters):
        if not isinstance(letter, str) or letter not in ASSIGNMENTS:
            raise InputError(
                f"{path}: edges_assignment: edge {number}: {given[number]!r}: one of "
                f"{', '.join(ASSIGNMENTS)} is allowed"
            )
    return letters


def _read_angles(path: str | Path, given: object, count: int) -> list[float]:
    if given is None:
        return [math.nan] * count
    if not isinstance(given, list) or len(given) != count:
        raise InputError(f"{path}: edges_foldAngle: one angle for each of {count} edges is needed")
    for number, angle in enumerate(given):
        if angle is not None and (type(angle) not in (int, float) or not abs(angle) <= 360):
            raise InputError(
                f"{path}: edges_foldAngle: edge {number}: {repr(angle)[:40]}: degrees from -360 to "
                "360, or null, are allowed"
            )
    return [math.nan if angle is None else math.radians(angle) for angle in given]


def _face_up(panels: Ragged, flat: np.ndarray | None, notes: list[str]) -> Ragged:
    """Let all faces of a flat sheet run counter-clockwise."""
    if flat is None:
        return panels
    over = [measure_area(flat[row][:, :2]) < 0 for row in panels]
    if any(over):
        notes.append(f"{sum(over)} faces that ran clockwise turned over")
    return make_ragged([row[::-1] if k else row for row, k in zip(panels, over, strict=True)])
