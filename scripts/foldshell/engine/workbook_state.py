"""A thickness workbook that is not as it was written: edited by a person, or damaged."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.whole import hash_file, read_arrays
from foldshell.workbook.peek import Peek, peek_thickness

if TYPE_CHECKING:
    from foldshell.engine.integrity import Fault, Home


def judge_workbook(home: "Home", name: str, fault: "Fault") -> "Fault":
    """Return the fault of a workbook, `edited by hand` where it opens and holds other thicknesses.

    A workbook of another design or iteration is damage, and so is one with the thicknesses that
    were written in other bytes.
    """
    path = home.folder / name
    if path.is_symlink() or not path.is_file():
        return fault
    try:
        peek = peek_thickness(path)
    except (InputError, OSError, ValueError):
        return fault
    number = int(path.parent.name)
    if peek.design not in (None, home.folder.name) or peek.iteration not in (None, number):
        return replace(fault, detail=f"it is that of {peek.design}, iteration {peek.iteration}")
    if not peek.thickness:
        return fault
    edited = replace(fault, kind="edited by hand", detail="the next run redoes what follows it")
    record = home.records.get(f"analyse-{path.parent.name}")
    if record and record.inputs.get(name) == hash_file(path):
        return replace(edited, detail="as the analysis after it has read it", used=True)
    if _holds(peek, path.with_name("analysis.npz")):
        return replace(fault, detail="saved again by another program, with the same thicknesses")
    return edited


def _holds(peek: Peek, analysis: Path) -> bool:
    """Tell whether a workbook has the thicknesses (P,) m that its analysis read, to 15 digits."""
    try:
        thickness = read_arrays(analysis)["thickness"]
        held = np.array([float(peek.thickness[panel]) for panel in range(len(thickness))])
    except (OSError, ValueError, KeyError, TypeError):
        return False
    return len(peek.thickness) == len(thickness) and bool(
        np.allclose(held, thickness, rtol=1e-14, atol=0)
    )
