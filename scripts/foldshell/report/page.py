"""The page of one design: 3D view, verdict, tables, history and pictures in one file."""

import base64
import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from PIL import Image

from foldshell.report.arrays import pack_arrays
from foldshell.report.combination_data import add_combinations, make_coarse
from foldshell.report.markup import render
from foldshell.report.sections import DesignFiles, describe_design, make_sections
from foldshell.report.viewer_data import ViewerData

SIZE_MAX = 1_400_000
"""Bytes: a browser shows larger pages blank inside Snakemake's report (2 MB as a data URI)."""
PICTURE_WIDTH, STILL_WIDTH = 530, 800
"""Pixels, about: of the pictures, and of the one in place of a 3D view that cannot be made."""
STILLS = ("utilization", "thickness")
"""What that picture shows: the first of them that there is."""
SHOWN = {
    "reinforcement": "reinforcement",
    "loads": "load cases",
    "principal_stress_lines": "principal stress lines",
    "isolines": "utilization isolines",
    "buckling": "buckling mode",
    "strain": "strain of the folding",
}
"""Pictures that the 3D view does not replace."""
NOTHING_MORE = {"combinations": [], "quantities": [], "iterations": []}
"""Facts of a view that shows no single combination and no iteration."""
FILES = {
    "sheet.html": "calculation sheet, to print",
    "design.xlsx": "workbook of the design",
    "sizing/history.xlsx": "history of the sizing loop",
    "crosscheck/comparison.xlsx": "cross-check, both codes",
    "design.vtu": "final fields for ParaView",
    "design_lines.vtu": "principal stress lines and isolines for ParaView",
    "pattern/crease_pattern.dxf": "crease pattern, DXF",
    "pattern/crease_pattern.fold": "crease pattern, FOLD",
    "folded/folded.vtu": "folded sheet",
}
"""Files beside the page that it links."""


def write_design_page(
    files: DesignFiles,
    viewer: ViewerData,
    more: ViewerData,
    pictures: Mapping[str, str | Path],
    utilization_max: float,
    exported: bool = False,
) -> str:
    """Return the page as HTML of at most `SIZE_MAX` bytes.

    `more` is what the 3D view shows of single combinations and iterations, `pictures` are PNG
    files by name, `exported` tells whether there is a list of files for other programs. Where the
    page is larger, `more` gets coarser, then pictures go, then `more`.
    """
    shown = [show_picture(name, path) for name, path in pictures.items() if name in SHOWN]
    still = next((name for name in STILLS if name in pictures), None)
    values = {
        "title": files.design.name,
        "description": describe_design(files.design),
        "sections": make_sections(files, utilization_max),
        "links": FILES | _link_pictures(pictures),
        "exported": exported,
    }
    small = still and show_picture(still, pictures[still], STILL_WIDTH)
    for data, images, picture in _choices(viewer, more, shown, small):
        headers, packed = pack_arrays(data.arrays)
        facts = NOTHING_MORE | data.facts | {"arrays": headers}
        page = render("design.html", **values, facts=facts, packed=packed, pictures=images,
                      still=picture)  # fmt: skip
        if len(page.encode()) <= SIZE_MAX:
            return page
    raise ValueError(f"page of {len(page.encode())} bytes: {SIZE_MAX} at most")


def _choices(
    viewer: ViewerData, more: ViewerData, shown: list, still: Any
) -> Iterator[tuple[ViewerData, list, Any]]:
    """Yield what a page may hold, all of it first: single combinations coarser, only the picture in
    place of the 3D view, no picture, no combinations, neither."""
    cells = len(viewer.arrays["panel"]) // viewer.facts["facets"]
    for one in (more, make_coarse(more, cells)):
        whole = add_combinations(viewer, one)
        yield whole, shown, still
    yield whole, [], still
    yield whole, [], None
    yield viewer, shown, still
    yield viewer, [], None


def _link_pictures(pictures: Mapping[str, str | Path]) -> dict[str, str]:
    return {
        f"figures/{Path(path).name}": f"picture: {name.replace('_', ' ')}"
        for name, path in pictures.items()
    }


def show_picture(name: str, path: str | Path, width: int = PICTURE_WIDTH) -> dict[str, str]:
    """Return a picture for a page: its words, where it lies, and small as a data URI."""
    words = SHOWN.get(name, name.replace("_", " "))
    return {
        "words": words,
        "path": f"figures/{Path(path).name}",
        "data": shrink_picture(path, width),
    }


def shrink_picture(path: str | Path, width: int) -> str:
    """Return a picture, reduced by a whole number to `width` pixels or more, as a data URI."""
    with Image.open(path) as picture:
        whole = picture if picture.mode == "RGB" else picture.convert("RGB")
        small = whole.reduce(max(1, picture.width // width))
    stream = io.BytesIO()
    small.save(stream, format="WEBP", quality=62, method=1)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")
