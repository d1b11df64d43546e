"""Crease patterns drawn as SVG: straight lines, their colours, nested transformations."""

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.whole import read_small_file
from foldshell.pattern.line_graph import Lines
from foldshell.pattern.svg_paths import read_path, read_points

LARGEST_FILE = 50_000_000
COLOURS = {  # as the tools that read FOLD know them
    "#ff0000": "M", "#0000ff": "V", "#000000": "B", "#ffff00": "F", "#00ff00": "C", "#ff00ff": "U",
}  # fmt: skip
_NAMES = {
    "red": "#ff0000", "blue": "#0000ff", "black": "#000000", "yellow": "#ffff00",
    "lime": "#00ff00", "green": "#00ff00", "magenta": "#ff00ff", "fuchsia": "#ff00ff",
}  # fmt: skip
_LENGTH = re.compile(r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(mm|cm|in|pt|pc|px|m|%)?\s*")
_PASSED_OVER = ("title", "desc", "metadata", "defs", "style", "text", "namedview", "symbol",
                "clipPath", "marker", "pattern")  # fmt: skip
_OWN = re.compile(r"; drawn in mm, (?:full size|1:([0-9.e+]+)|([0-9.e+]+):1)")
_UNITS = {"mm": "mm", "cm": "cm", "in": "inch", "m": "m"}


def read_svg_lines(path: str | Path) -> Lines:
    """Read the straight lines of an SVG drawing, y up, in the unit of its width.

    Colours of strokes are those of COLOURS: mountain red, valley blue, border black. Raises
    `InputError` for other colours, curves, and what is no SVG.
    """
    root = _parse(path)
    unit, scale = _find_scale(path, root)
    upwards = np.array([[scale, 0, 0], [0, -scale, scale * _find_bottom(path, root)], [0, 0, 1]])
    styles = _read_styles(root)
    found = list(_walk(path, root, upwards, {}, styles))
    segments = [segment for segment, _ in found]
    letters = np.array([letter for segment, letter in found for _ in segment], dtype="<U1")
    whole = np.concatenate(segments) if segments else np.empty((0, 2, 2))
    return Lines(whole, letters, unit)


def _parse(path: str | Path) -> ElementTree.Element:
    data = read_small_file(path, LARGEST_FILE, "an SVG drawing")
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        data = re.sub(rb"<!DOCTYPE[^>\[]*>", b"", data, count=1)
        if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
            raise InputError(f"{path}: a document type of its own: none is allowed")
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{path}: damaged or no SVG ({error})") from None
    if _tag(root) != "svg":
        raise InputError(f"{path}: begins with <{_tag(root)[:40]}>: an SVG drawing is needed")
    return root


def _tag(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _find_scale(path: str | Path, root: ElementTree.Element) -> tuple[str | None, float]:
    """Unit of the drawing, None without one, and its length over the coordinates'.

    Drawings of this project say themselves at what scale they are drawn, since they open at a
    size that one sees.
    """
    own = _OWN.search("".join(k.text or "" for k in root if _tag(k) == "desc"))
    if own:
        return "mm", (float(own[1]) if own[1] else 1.0) / (float(own[2]) if own[2] else 1.0)
    match = _LENGTH.fullmatch(root.get("width") or "")
    if match is None or match[2] not in _UNITS:
        return None, 1.0
    box = _read_box(path, root)
    if box is None:
        return _UNITS[match[2]], {"mm": 25.4, "cm": 2.54, "in": 1.0, "m": 0.0254}[match[2]] / 96
    return _UNITS[match[2]], float(match[1]) / box[2]


def _read_box(path: str | Path, root: ElementTree.Element) -> list[float] | None:
    text = root.get("viewBox")
    if text is None:
        return None
    numbers = [
        float(k) for k in re.findall(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?", text)
    ]
    if len(numbers) != 4 or not (numbers[2] > 0 and numbers[3] > 0):
        raise InputError(f"{path}: viewBox: {text[:60]!r}: four numbers are allowed")
    return numbers


def _find_bottom(path: str | Path, root: ElementTree.Element) -> float:
    """The y of the lower edge, from which y runs up in what is read; 0 where none is stated."""
    box = _read_box(path, root)
    return box[1] + box[3] if box else 0.0


def _read_styles(root: ElementTree.Element) -> dict[str, dict[str, str]]:
    """Declarations of classes in <style>."""
    found: dict[str, dict[str, str]] = {}
    for element in root.iter():
        if _tag(element) == "style" and element.text:
            text = re.sub(r"/\*.*?\*/", "", element.text, flags=re.DOTALL)
            for names, body in re.findall(r"([^{}]+)\{([^{}]*)\}", text):
                for name in names.split(","):
                    found.setdefault(name.strip(), {}).update(_declarations(body))
    return found


def _declarations(text: str) -> dict[str, str]:
    pairs = (part.split(":", 1) for part in text.split(";") if ":" in part)
    return {key.strip(): value.strip() for key, value in pairs}


def _walk(
    path: str | Path, element: ElementTree.Element, matrix: np.ndarray, look: dict, styles: dict
) -> Iterator[tuple[np.ndarray, str]]:
    """Yield segments (n, 2, 2) and the letter of each drawn element."""
    tag = _tag(element)
    if tag in _PASSED_OVER:
        return
    look = _find_look(element, look, styles)
    if look.get("display") == "none" or look.get("visibility") == "hidden":
        return
    place = f"{path}: <{tag}{' id=' + element.get('id', '')[:40] if element.get('id') else ''}>"
    matrix = matrix @ read_transform(place, element.get("transform", ""))
    if tag in ("svg", "g", "a", "switch"):
        for child in element:
            yield from _walk(path, child, matrix, look, styles)
        return
    if tag in ("use", "image"):
        raise InputError(f"{place}: lines that stand in the drawing themselves are allowed")
    if look.get("stroke", "none") == "none":
        return
    segments = _draw(place, tag, element)
    if len(segments):
        yield segments @ matrix[:2, :2].T + matrix[:2, 2], _find_letter(place, look["stroke"])


def _find_look(element: ElementTree.Element, look: dict, styles: dict) -> dict[str, str]:
    keys = ("stroke", "display", "visibility")
    found = {**look, **{key: element.attrib[key] for key in keys if key in element.attrib}}
    found.update(styles.get(_tag(element), {}))
    for name in element.get("class", "").split():
        found.update(styles.get(f".{name}", {}))
    found.update(styles.get(f"#{element.get('id')}", {}))
    found.update(_declarations(element.get("style", "")))
    return found


def _find_letter(place: str, colour: str) -> str:
    text = colour.strip().casefold()
    text = _NAMES.get(text, text)
    if re.fullmatch(r"#[0-9a-f]{3}", text):
        text = "#" + "".join(2 * k for k in text[1:])
    parts = re.fullmatch(r"rgb\(\s*(\d{1,3})\s*,\s*(\d{1,3})\s*,\s*(\d{1,3})\s*\)", text)
    if parts:
        text = "#" + "".join(f"{min(int(k), 255):02x}" for k in parts.groups())
    if text not in COLOURS:
        known = ", ".join(f"{key} {letter}" for key, letter in COLOURS.items())
        raise InputError(f"{place}: stroke {colour[:40]!r}: one of {known} is allowed")
    return COLOURS[text]


def _draw(place: str, tag: str, element: ElementTree.Element) -> np.ndarray:
    """Segments (n, 2, 2) of an element in its own coordinates."""
    if tag == "line":
        ends = [_number(place, element, key) for key in ("x1", "y1", "x2", "y2")]
        return np.array(ends).reshape(1, 2, 2)
    if tag in ("polyline", "polygon"):
        points = read_points(place, element.get("points", ""))
        rows = [*points, points[0]] if tag == "polygon" and len(points) else points
        return _chain(rows)
    if tag == "rect":
        x, y, w, h = (_number(place, element, key) for key in ("x", "y", "width", "height"))
        return _chain([(x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y)])
    if tag == "path":
        parts = [_chain(points) for points in read_path(place, element.get("d", ""))]
        return np.concatenate(parts) if parts else np.empty((0, 2, 2))
    raise InputError(f"{place}: straight lines are allowed: line, polyline, polygon, rect, path")


def _chain(points) -> np.ndarray:
    array = np.array(points, dtype=float).reshape(-1, 2)
    return np.stack([array[:-1], array[1:]], axis=1) if len(array) > 1 else np.empty((0, 2, 2))


def _number(place: str, element: ElementTree.Element, key: str) -> float:
    match = _LENGTH.fullmatch(element.get(key, "0"))
    if match is None or match[2] not in (None, "px"):
        raise InputError(f"{place}: {key}: {element.get(key, '')[:40]!r}: a number is allowed")
    return float(match[1])


def read_transform(place: str, text: str) -> np.ndarray:
    """The matrix (3, 3) of a `transform` attribute. Lengths in units of the drawing."""
    matrix = np.eye(3)
    rest = re.sub(r"([a-zA-Z]+)\s*\(([^()]*)\)[\s,]*", "", text).strip()
    if rest:
        raise InputError(f"{place}: transform: {text[:60]!r}: cannot be read")
    for name, body in re.findall(r"([a-zA-Z]+)\s*\(([^()]*)\)", text):
        try:
            numbers = [float(k) for k in re.split(r"[\s,]+", body.strip()) if k]
            matrix = matrix @ _make_matrix(name, numbers)
        except (ValueError, IndexError):
            raise InputError(f"{place}: transform: {name}({body[:40]}): cannot be read") from None
    return matrix


def _make_matrix(name: str, n: list[float]) -> np.ndarray:
    if name == "matrix" and len(n) == 6:
        return np.array([[n[0], n[2], n[4]], [n[1], n[3], n[5]], [0, 0, 1]])
    if name == "translate":
        return np.array([[1, 0, n[0]], [0, 1, n[1] if len(n) > 1 else 0.0], [0, 0, 1]])
    if name == "scale":
        return np.diag([n[0], n[1] if len(n) > 1 else n[0], 1.0])
    if name == "rotate":
        c, s = np.cos(np.radians(n[0])), np.sin(np.radians(n[0]))
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        if len(n) == 3:
            there = np.array([[1, 0, n[1]], [0, 1, n[2]], [0, 0, 1.0]])
            back = np.array([[1, 0, -n[1]], [0, 1, -n[2]], [0, 0, 1.0]])
            return there @ turn @ back
        return turn
    if name in ("skewX", "skewY"):
        matrix = np.eye(3)
        matrix[(0, 1) if name == "skewX" else (1, 0)] = np.tan(np.radians(n[0]))
        return matrix
    raise ValueError(name)
