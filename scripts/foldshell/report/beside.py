"""Files beside a page that are made apart from it: links lead to those that there are by now."""

from pathlib import Path

INDEX = "index.html"


def list_exports(folder: str | Path) -> list[str]:
    """Return the names of a design's files for other programs, their list first; none before the
    target `export` has made that list."""
    exports = Path(folder, "exports")
    if not (exports / INDEX).is_file():
        return []
    names = sorted(path.name for path in exports.iterdir() if path.is_file())
    return [INDEX, *(name for name in names if name != INDEX and not name.startswith("."))]
