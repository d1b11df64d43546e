"""The page of one design: 3D view, verdict, tables, history and pictures in one file."""

import base64
import io
from collections.abc import Mapping
from pathlib import Path

from PIL import Image

from foldshell.report.arrays import pack_arrays
from foldshell.report.markup import render
from foldshell.report.sections import DesignFiles, describe_design, make_sections
from foldshell.report.viewer_data import ViewerData

SCRIPTS = ("data.js", "renderer.js", "camera.js", "viewer.js")
SIZE_MAX = 1_400_000
"""Bytes: a browser shows larger pages blank inside Snakemake's report (2 MB as a data URI)."""
PICTURE_WIDTH = 560
SHOWN = {"principal_stress_lines": "principal stress lines", "isolines": "utilization isolines",
         "buckling": "buckling mode", "strain": "strain of the folding"}  # fmt: skip
"""Pictures that the 3D view does not replace."""
FILES = {
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
    pictures: Mapping[str, str | Path],
    utilization_max: float,
) -> str:
    """Return the page as HTML of at most `SIZE_MAX` bytes; pictures go first where it is larger.

    `pictures` are PNG files by name.
    """
    shown = [show_picture(name, path) for name, path in pictures.items() if name in SHOWN]
    headers, packed = pack_arrays(viewer.arrays)
    values = {
        "title": files.design["design"],
        "description": describe_design(files.design),
        "sections": make_sections(files, utilization_max),
        "links": FILES | _link_pictures(pictures),
        "facts": viewer.facts | {"arrays": headers},
        "packed": packed,
        "scripts": SCRIPTS,
    }
    page = render("design.html", **values, pictures=shown)
    if len(page.encode()) > SIZE_MAX:
        page = render("design.html", **values, pictures=[])
    if len(page.encode()) > SIZE_MAX:
        raise ValueError(f"page of {len(page.encode())} bytes: {SIZE_MAX} at most")
    return page


def _link_pictures(pictures: Mapping[str, str | Path]) -> dict[str, str]:
    return {
        f"figures/{Path(path).name}": f"picture: {name.replace('_', ' ')}"
        for name, path in pictures.items()
    }


def show_picture(name: str, path: str | Path) -> dict[str, str]:
    """Return a picture for a page: its words, where it lies, and small as a data URI."""
    small = shrink_picture(path)
    return {"words": SHOWN[name], "path": f"figures/{Path(path).name}", "data": small}


def shrink_picture(path: str | Path) -> str:
    """Return a picture, reduced to `PICTURE_WIDTH` pixels, as a data URI."""
    with Image.open(path) as picture:
        height = round(picture.height * PICTURE_WIDTH / picture.width)
        whole = picture if picture.mode == "RGB" else picture.convert("RGB")
        size = (PICTURE_WIDTH, height)
        small = whole.resize(size, Image.Resampling.BOX, reducing_gap=2.0)
    stream = io.BytesIO()
    small.save(stream, format="WEBP", quality=62, method=2)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")
