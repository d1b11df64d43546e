"""All iterations of one design, read back from their files."""

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.files.edits import keep_edited
from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER
from foldshell.files.whole import TEMPORARY_PREFIX, read_arrays, read_json
from foldshell.results.history import make_history
from foldshell.settings.design import Design
from foldshell.settings.sizing import Sizing

SUPERSEDED = "superseded"


@dataclass(frozen=True)
class Iterations:
    """Contents of every analysis.json, the rows of the history, and the last analysis.npz."""

    analyses: list[dict[str, Any]]
    history: list[dict[str, Any]]
    last_arrays: Path
    thickness: np.ndarray
    utilization: np.ndarray


def gather_iterations(
    json_paths: Sequence[str | Path], design: Design, sizing: Sizing
) -> Iterations:
    """Read the iterations in order.

    Raises
    ------
    InputError
        for a file that is missing, damaged or out of order.
    """
    analyses = [_read(Path(path), number) for number, path in enumerate(json_paths)]
    arrays_paths = [Path(path).with_suffix(".npz") for path in json_paths]
    arrays = [read_arrays(path) for path in arrays_paths]
    thicknesses = [item["thickness"] for item in arrays]
    limit = design.span / sizing.displacement_limit_span_over
    edited = [item["iteration"] for item in analyses if item.get("edited")]
    history = make_history(analyses, thicknesses, limit, edited)
    utilization = arrays[-1].get(f"utilization_{sizing.measure}")
    if utilization is None:
        utilization = np.full(len(thicknesses[-1]), np.nan)
    return Iterations(analyses, history, arrays_paths[-1], thicknesses[-1], utilization)


def _read(path: Path, number: int) -> dict[str, Any]:
    try:
        data = read_json(path)
    except (OSError, ValueError):
        data = None
    if not isinstance(data, dict) or data.get("iteration") != number or "verdict" not in data:
        raise InputError(
            f"{path}: not the analysis of iteration {number}: delete this file and start again, "
            "it is computed anew"
        )
    return data


def remove_superseded(sizing: Path, count: int) -> list[int]:
    """Remove the folders of iterations `count`, `count` + 1, ...; return their numbers.

    They stem from an earlier run, before an edit or another setting ended the loop sooner. Copies
    of edited workbooks in them move to `superseded/`. Half-written files that a kill left in the
    others go too.
    """
    for leftover in sizing.glob(f"[0-9][0-9]/{TEMPORARY_PREFIX}*"):
        leftover.unlink()
    removed = []
    for folder in sorted(sizing.glob("[0-9][0-9]")):
        if int(folder.name) < count:
            continue
        keep_edited(folder / "thickness.xlsx")
        for copy in sorted(folder.glob("edited-*.xlsx")):
            (sizing / SUPERSEDED).mkdir(exist_ok=True)
            copy.replace(sizing / SUPERSEDED / f"{folder.name}-{copy.name}")
        for record in (sizing.parent / FOLDER).glob(f"*-{folder.name}.json"):
            record.unlink()
        shutil.rmtree(folder)
        removed.append(int(folder.name))
    return removed
