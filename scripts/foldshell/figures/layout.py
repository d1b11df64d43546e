"""Put a rendered view, a title, a colour bar and a legend together as one PNG."""

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
    where `scale` is None."""

    title: str
    lines: Sequence[str]
    quantity: str = ""
    scale: ColourScale | None = None
    above: str = ""
    keys: Sequence[Key] = ()


def view_size(size: tuple[int, int]) -> tuple[int, int]:
    """Return width and height of the view inside a picture of the given size."""
    return size[0], round(size[1] * 0.69)


def compose(
    view: np.ndarray, caption: Caption, axes: np.ndarray, size: tuple[int, int]
) -> Image.Image:
    """Return the picture: words above the view, colour bar and legend below it.

    `axes` (3, 2) is how unit vectors x, y, z look: right and up.
    """
    width, height = size
    unit = height / 1200
    picture = Image.new("RGB", size, "white")
    top = round(0.165 * height)
    picture.paste(Image.fromarray(view), (0, top))
    pen = ImageDraw.Draw(picture)
    left = round(40 * unit)
    pen.text((left, round(22 * unit)), caption.title, INK, fit_font(caption.title, 46 * unit,
             width - 2 * left, bold=True))  # fmt: skip
    font = load_font(round(28 * unit))
    words = [part for line in caption.lines for part in wrap(line, font, width - 2 * left)]
    for k, line in enumerate(words[:LINES_MAX]):
        pen.text((left, round((84 + 37 * k) * unit)), line, INK, font)
    base = top + view.shape[0]
    _draw_axes(pen, (left + 75 * unit, base - 75 * unit), axes, unit)
    if caption.scale is not None:
        box = (left, base + round(62 * unit), round(0.60 * width), base + round(102 * unit))
        draw_bar(picture, box, caption, unit)
    else:
        for k, line in enumerate(wrap(caption.quantity, font, 0.58 * width)):
            pen.text((left, base + round((12 + 37 * k) * unit)), line, INK, font)
    _draw_keys(pen, (round(0.66 * width), base + round(8 * unit)), caption.keys, unit)
    return picture


def save_png(path: str | Path, picture: Image.Image) -> None:
    """Write a PNG whose bytes depend on the picture alone."""
    with atomic_path(path) as temporary:
        picture.save(temporary, format="PNG", compress_level=2)


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
    pen.text((left, top - round(12 * unit)), caption.quantity, INK, words, anchor="ls")
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
    length, height = round(70 * unit), round(37 * unit)
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
