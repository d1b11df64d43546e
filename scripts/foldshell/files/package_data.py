"""Where the workflow lies that belongs to this library: in a checkout or inside the wheel."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def is_installed() -> bool:
    """Tell whether the library comes from a wheel; else it is part of a checkout."""
    return (_PACKAGE / "workflow").is_dir()


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile, rules/, scripts/, envs/, profiles/ and config/."""
    return _PACKAGE / "workflow" if is_installed() else _PACKAGE.parents[1]


def library_folder() -> Path:
    """Return the folder that holds the package."""
    return _PACKAGE.parent
