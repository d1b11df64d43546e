"""The page of one design: 3D view, verdict, tables, history and pictures in one file."""

import base64
import io
from collections.abc import Mapping
from pathlib import Path

from PIL import Image

from foldshell.report.arrays import pack_arrays
from foldshell.report.markup import dump_json, escape, make_page
from foldshell.report.sections import (
    DesignFiles,
    describe_design,
    write_classes,
    write_criteria,
    write_crosscheck,
    write_folding,
    write_headlines,
    write_history,
    write_mesh_error,
    write_verdict,
)
from foldshell.report.view import View

FOLDER = Path(__file__).parent
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
    view: View,
    pictures: Mapping[str, str | Path],
    utilization_max: float,
) -> str:
    """Return the page as HTML of at most `SIZE_MAX` bytes; pictures go first where it is larger.

    `pictures` are PNG files by name.
    """
    shown = {name: shrink_picture(path) for name, path in pictures.items() if name in SHOWN}
    page = _put_together(files, view, pictures, shown, utilization_max)
    if len(page.encode()) > SIZE_MAX:
        page = _put_together(files, view, pictures, {}, utilization_max)
    if len(page.encode()) > SIZE_MAX:
        raise ValueError(f"page of {len(page.encode())} bytes: {SIZE_MAX} at most")
    return page


def _put_together(files, view, pictures, shown, utilization_max) -> str:
    name = files.design["design"]
    headers, packed = pack_arrays(view.arrays)
    facts = dump_json(view.facts | {"arrays": headers})
    body = f"""<header>
<h1>{escape(name)}</h1>
<p class="soft">{describe_design(files.design)}</p>
</header>
<main>
<div class="columns">
<section>
{_read("stage.html")}
{_write_pictures(shown, pictures)}
</section>
<section>
{_write_tables(files, utilization_max)}
</section>
</div>
{_write_files(pictures)}
</main>
<footer>One file without libraries; it asks no host for anything. Displacements are positive
downward, tension is positive.</footer>
<script type="application/json" id="facts">{facts}</script>
<script type="text/plain" id="arrays">{packed}</script>
<script>
{"".join(map(_read, SCRIPTS))}
</script>"""
    return make_page(name, _read("page.css"), body)


def _read(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")


def _write_tables(files: DesignFiles, utilization_max: float) -> str:
    parts = [
        ("Verdict", write_verdict(files)),
        ("Criteria", write_criteria(files.final.get("criteria") or {})),
        ("History", write_history(files.history, utilization_max)),
        ("Final state", write_headlines(files)),
        ("Cross-check by the independent code", write_crosscheck(files.comparison)),
        ("Mesh error", write_mesh_error(files.mesh_convergence)),
        ("Thickness classes", write_classes(files.classes)),
        ("Folding", write_folding(files.quality)),
    ]
    return "\n".join(f"<h2>{title}</h2>\n{text}" for title, text in parts)


def _write_pictures(shown: Mapping[str, str], pictures: Mapping[str, str | Path]) -> str:
    figures = "\n".join(
        f'<figure><a href="figures/{escape(Path(pictures[name]).name)}">'
        f'<img src="{data}" alt="{SHOWN[name]}" loading="lazy"></a>'
        f"<figcaption>{SHOWN[name]}</figcaption></figure>"
        for name, data in shown.items()
    )
    return f'<h2>Pictures</h2>\n<div class="pictures">\n{figures}\n</div>' if shown else ""


def _write_files(pictures: Mapping[str, str | Path]) -> str:
    links = FILES | {
        f"figures/{Path(path).name}": f"picture: {name.replace('_', ' ')}"
        for name, path in pictures.items()
    }
    items = "\n".join(
        f'<li><a href="{escape(path)}">{escape(words)}</a></li>' for path, words in links.items()
    )
    return f'<div class="files-part"><h2>Files</h2>\n<ul class="files">\n{items}\n</ul></div>'


def shrink_picture(path: str | Path) -> str:
    """Return a picture, reduced to `PICTURE_WIDTH` pixels, as a data URI."""
    with Image.open(path) as picture:
        height = round(picture.height * PICTURE_WIDTH / picture.width)
        small = picture.convert("RGB").resize(
            (PICTURE_WIDTH, height), Image.Resampling.BOX, reducing_gap=2.0
        )
    stream = io.BytesIO()
    small.save(stream, format="WEBP", quality=62, method=2)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")
