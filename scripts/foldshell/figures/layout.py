"""Put a rendered view, a title, a colour bar and a legend together as one PNG."""

import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from foldshell.files.whole import atomic_path
from foldshell.results.colour_scales import ABOVE, ColourScale, find_ticks, format_tick

INK = (20, 20, 20)
SOFT = (90, 90, 90)
TITLE_SIZE = 46
"""Height of titles, pixels of a picture 1200 high."""
UP = 2
"""Filter of a row of a PNG: what differs from the row above."""
KEYS_MAX = 4
"""Entries of a legend below which it need not be narrowed."""
LINES_MAX = 3
"""Lines of words that fit between the title and the view."""


@dataclass(frozen=True)
class Key:
    """One entry of the legend: a sample (solid, dashed, support, area) and its words."""

    sample: str
    words: str
    colour: tuple[int, int, int] = INK


@dataclass(frozen=True)
class Caption:
    """All words of a picture; `quantity`, with its unit, stands over the colour bar, or alone
    where `scale` is None. `name` is that of the design; `ends` are the least and the largest value,
    which the bar marks with their words; `swatches` stand in place of a bar for colours that are
    no scale."""

    title: str
    lines: Sequence[str]
    quantity: str = ""
    scale: ColourScale | None = None
    above: str = ""
    keys: Sequence[Key] = ()
    name: str = ""
    ends: Sequence[tuple[float, str]] = ()
    swatches: Sequence[Key] = ()


@dataclass(frozen=True)
class Note:
    """Words at a place of the view, right and down in pixels; a ring marks the place itself."""

    place: tuple[float, float]
    words: str
    ring: bool = True


def view_size(size: tuple[int, int]) -> tuple[int, int]:
    """Return width and height of the view inside a picture of the given size."""
    return size[0], round(size[1] * 0.69)


def compose(
    view: np.ndarray,
    caption: Caption,
    axes: np.ndarray,
    size: tuple[int, int],
    notes: Sequence[Note] = (),
    inset: np.ndarray | None = None,
) -> Image.Image:
    """Return the picture: words above the view, colour bar and legend below it.

    `view` (h, w, 3) and `inset`, a close-up for its upper right corner, are images; `axes` (3, 2)
    is how unit vectors x, y, z look: right and up.
    """
    unit = size[1] / 1200
    picture = Image.new("RGB", size, "white")
    top, left = round(0.165 * size[1]), round(40 * unit)
    picture.paste(Image.fromarray(view), (0, top))
    pen = ImageDraw.Draw(picture)
    if inset is not None:
        _paste_inset(picture, inset, top, unit)
    _write_head(pen, caption, size[0], unit)
    base = top + view.shape[0]
    _draw_axes(pen, (left + 75 * unit, base - 75 * unit), axes, unit)
    for note in notes:
        _write_note(pen, note, top, size[0], unit)
    if caption.scale is not None:
        box = (left, base + round(62 * unit), round(0.60 * size[0]), base + round(102 * unit))
        draw_bar(picture, box, caption, unit)
    else:
        font = load_font(round(28 * unit))
        for k, line in enumerate(wrap(caption.quantity, font, 0.58 * size[0])):
            pen.text((left, base + round((12 + 37 * k) * unit)), line, INK, font)
    for k in range(0, len(caption.swatches), KEYS_MAX):
        corner = left + round(460 * unit) * (k // KEYS_MAX), base + round(8 * unit)
        _draw_keys(pen, corner, caption.swatches[k : k + KEYS_MAX], unit)
    _draw_keys(pen, (round(0.66 * size[0]), base + round(8 * unit)), caption.keys, unit)
    return picture


def _write_head(pen: ImageDraw.ImageDraw, caption: Caption, width: int, unit: float) -> None:
    """Write the title, always of the same size, the name at the right of it, and the words."""
    left, large = round(40 * unit), load_font(round(TITLE_SIZE * unit), True)
    pen.text((left, round(22 * unit)), caption.title, INK, large)
    room = width - 3 * left - large.getlength(caption.title)
    name = fit_font(caption.name, 34 * unit, room)
    pen.text((width - left, round(64 * unit)), caption.name, SOFT, name, anchor="rs")
    font = load_font(round(28 * unit))
    words = [part for line in caption.lines for part in wrap(line, font, width - 2 * left)]
    for k, line in enumerate(words[:LINES_MAX]):
        pen.text((left, round((84 + 37 * k) * unit)), line, INK, font)


def _paste_inset(picture: Image.Image, inset: np.ndarray, top: int, unit: float) -> None:
    height, width = inset.shape[:2]
    x = picture.width - width - round(16 * unit)
    picture.paste(Image.fromarray(inset), (x, top))
    pen = ImageDraw.Draw(picture)
    pen.rectangle((x, top, x + width, top + height), outline=SOFT, width=max(1, round(3 * unit)))
    font = load_font(round(26 * unit))
    pen.text((x + 12 * unit, top + 8 * unit), "close-up", INK, font,
             stroke_width=round(4 * unit), stroke_fill="white")  # fmt: skip


def _write_note(pen: ImageDraw.ImageDraw, note: Note, top: int, width: int, unit: float) -> None:
    """Write words beside a place, on the side that has room."""
    x, y = note.place[0], note.place[1] + top
    font, radius = load_font(round(28 * unit)), 13 * unit
    if note.ring:
        box = (x - radius, y - radius, x + radius, y + radius)
        pen.ellipse(box, outline="white", width=round(9 * unit))
        pen.ellipse(box, outline=ABOVE, width=round(5 * unit))
    right = x + 24 * unit + font.getlength(note.words) < width
    place = (x + 22 * unit, y) if right else (x - 22 * unit, y)
    pen.text(place, note.words, INK, font, anchor="lm" if right else "rm",
             stroke_width=round(4 * unit), stroke_fill="white")  # fmt: skip


def save_png(path: str | Path, picture: Image.Image) -> None:
    """Write a PNG whose bytes depend on the picture alone.

    In all its colours: a palette that is quick to find puts beige into a bar of pale yellows. Rows
    are kept as differences to the one above (filter 2), which takes a third of the time that Pillow
    needs to choose a filter for each row.
    """
    pixels = np.asarray(picture.convert("RGB")).reshape(picture.height, -1)
    rows = np.empty((picture.height, pixels.shape[1] + 1), dtype=np.uint8)
    rows[:, 0], rows[0, 1:] = UP, pixels[0]
    np.subtract(pixels[1:], pixels[:-1], out=rows[1:, 1:])
    size = struct.pack(">2I5B", picture.width, picture.height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", size), (b"IDAT", zlib.compress(rows, 2)), (b"IEND", b""))
    with atomic_path(path) as temporary, temporary.open("wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n")
        for name, data in chunks:
            ends = struct.pack(">I", len(data)), struct.pack(">I", zlib.crc32(name + data))
            stream.write(ends[0] + name + data + ends[1])


@lru_cache
def load_font(size: int, bold: bool = False) -> ImageFont.FreeTypeFont:
    """Return DejaVu Sans, which matplotlib brings along, at a size in pixels.

    Matplotlib is found without importing it, which would take as long as drawing one picture.
    """
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    package = Path(find_spec("matplotlib").origin).parent
    return ImageFont.truetype(str(package / "mpl-data" / "fonts" / "ttf" / name), size)


def fit_font(text: str, size: float, width: float, bold: bool = False) -> ImageFont.FreeTypeFont:
    """Return the font at the size, or smaller where the text would not fit the width."""
    font = load_font(round(size), bold)
    needed = font.getlength(text)
    return font if needed <= width else load_font(max(int(size * width / needed), 8), bold)


def wrap(text: str, font: ImageFont.FreeTypeFont, width: float) -> list[str]:
    """Break a text into lines that fit the width in pixels; a longer word stays whole."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if font.getlength(longer) <= width or not lines[-1]:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def draw_bar(picture: Image.Image, box: tuple[int, ...], caption: Caption, unit: float) -> None:
    """Draw the map, its ticks and, beyond a limit, the patch of what is above it."""
    left, top, right, bottom = box
    scale, pen = caption.scale, ImageDraw.Draw(picture)
    end = right - round(150 * unit) if scale.limit is not None else right
    ramp = scale.colour(np.linspace(scale.low, scale.high, end - left))
    band = np.broadcast_to(ramp, (bottom - top, *ramp.shape))
    picture.paste(Image.fromarray(np.ascontiguousarray(band)), (left, top))
    words = fit_font(caption.quantity, 32 * unit, right - left)
    rise = 44 if caption.ends else 12
    pen.text((left, top - round(rise * unit)), caption.quantity, INK, words, anchor="ls")
    for value, text in caption.ends:
        x = left + (value - scale.low) / (scale.high - scale.low) * (end - 1 - left)
        _mark_end(pen, (x, top), text, (left, end), unit)
    ticks = find_ticks(scale.low, scale.high)
    step = ticks[1] - ticks[0] if len(ticks) > 1 else scale.high - scale.low
    font = load_font(round(30 * unit))
    for tick in ticks:
        x = left + (tick - scale.low) / (scale.high - scale.low) * (end - 1 - left)
        limit = tick == scale.limit
        pen.line((x, top if limit else bottom, x, bottom + 10 * unit), INK, round(3 * unit))
        use = load_font(round(32 * unit), True) if limit else font
        edge = max(x, left + use.getlength(format_tick(tick, step)) / 2)
        pen.text((edge, bottom + 14 * unit), format_tick(tick, step), INK, use, anchor="ma")
    if scale.limit is not None:
        pen.rectangle((end, top, right, bottom - 1), ABOVE)
        pen.line((end, top - 8 * unit, end, bottom + 10 * unit), INK, round(4 * unit))
        pen.text(((end + right) / 2 + 30 * unit, bottom + 14 * unit), caption.above, INK, font,
                 anchor="ma")  # fmt: skip
    pen.rectangle((left, top, right, bottom), outline=INK, width=max(1, round(2 * unit)))


def _mark_end(
    pen: ImageDraw.ImageDraw,
    place: tuple[float, float],
    text: str,
    room: tuple[float, float],
    unit: float,
) -> None:
    """Point at a value of the bar from above, with its words, which stay over the bar."""
    (x, top), half = place, 9 * unit
    pen.polygon([(x, top), (x - half, top - 15 * unit), (x + half, top - 15 * unit)], INK)
    font = load_font(round(25 * unit))
    wide = font.getlength(text) / 2
    middle = min(max(x, room[0] + wide), room[1] - wide)
    pen.text((middle, top - 18 * unit), text, INK, font, anchor="ms")


def _draw_axes(pen: ImageDraw.ImageDraw, centre: tuple[float, float], axes, unit: float) -> None:
    """Draw the directions x, y, z as they appear in the view."""
    x, y = centre
    font = load_font(round(29 * unit))
    for name, (right, up) in zip("xyz", axes.tolist(), strict=True):
        pen.line((x, y, x + 62 * unit * right, y - 62 * unit * up), SOFT, round(4 * unit))
        pen.text((x + 84 * unit * right, y - 84 * unit * up), name, SOFT, font, anchor="mm")


def _draw_keys(
    pen: ImageDraw.ImageDraw, corner: tuple[int, int], keys: Sequence[Key], unit: float
) -> None:
    x, y = corner
    length, height = round(70 * unit), round(min(37, 37 * KEYS_MAX / max(len(keys), 1)) * unit)
    font = load_font(round(29 * unit))
    for key in keys:
        middle = y + height / 2
        _draw_sample(pen, key, x, middle, length, unit)
        pen.text((x + length + 18 * unit, middle), key.words, INK, font, anchor="lm")
        y += height


def _draw_sample(pen, key: Key, x: float, middle: float, length: float, unit: float) -> None:
    width = round(5 * unit)
    if key.sample == "solid":
        pen.line((x, middle, x + length, middle), key.colour, width)
    elif key.sample == "dashed":
        for k in range(4):
            start = x + k * length / 4 + length / 32
            pen.line((start, middle, start + length / 7, middle), key.colour, width)
    elif key.sample == "support":
        half = 15 * unit
        centre = x + length / 2
        pen.polygon(
            [(centre, middle - half), (centre - half, middle + half),
             (centre + half, middle + half)], (64, 64, 64),
        )  # fmt: skip
    else:
        half = 14 * unit
        pen.rectangle((x, middle - half, x + length, middle + half), key.colour, INK)
