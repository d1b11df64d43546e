"""What an export is told besides the model, and the libraries that it needs."""

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType

from foldshell.files.errors import InputError
from foldshell.settings.exports import Drawings, Exports

PACKAGES = {"rhino3dm": "rhino3dm", "ifcopenshell": "ifcopenshell", "trimesh": "trimesh",
            "shapely": "shapely", "spyrrow": "spyrrow", "ezdxf": "ezdxf",
            "xlsxwriter": "XlsxWriter"}  # fmt: skip
"""Libraries by the name under which they are imported, and that of their package."""


@dataclass(frozen=True)
class ExportOptions:
    """Colours and scale of drawings, the sheets (m) panels are cut from, seconds for nesting;
    `sources` are files of the design by role: design_vtu, pattern."""

    preset: str = "fold"
    scale: float = 1.0
    sheet_length: float = 12.0
    sheet_width: float = 3.0
    nesting_seconds: int = 20
    sources: Mapping[str, Path] = field(default_factory=dict)


def make_options(
    drawings: Drawings, exports: Exports, inputs: Mapping[str, str | Path]
) -> ExportOptions:
    """Return the options that settings name, with those files of a design that exports copy."""
    return ExportOptions(
        preset=drawings.preset,
        scale=drawings.scale,
        sheet_length=exports.sheet_length,
        sheet_width=exports.sheet_width,
        nesting_seconds=exports.nesting_seconds,
        sources={role: Path(inputs[role]) for role in ("pattern", "design_vtu")},
    )


def load_library(name: str) -> ModuleType:
    """Import an optional library; `InputError` says how to install it where it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise InputError(
            f"exports: the library {PACKAGES[name]} is not installed: "
            "`pip install -r envs/exports.lock` adds what exports need"
        ) from None
