"""Pictures inside a page."""

import base64
import io
from pathlib import Path

from PIL import Image

FIGURE_WIDTH = 800


def embed_picture(path: str | Path) -> str:
    """Return a chart as a data URI, reduced to `FIGURE_WIDTH` pixels or a little more."""
    with Image.open(path) as picture:
        whole = picture.convert("RGB")
        small = whole.reduce(max(1, whole.width // FIGURE_WIDTH))
    stream = io.BytesIO()
    small.save(stream, format="WEBP", quality=80, method=2)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")
