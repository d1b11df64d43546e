"""Compute one design of an archive anew and compare it digit by digit."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.archive.rerun import prepare_rerun
from foldshell.files.errors import InputError
from foldshell.files.job_record import read_records
from foldshell.files.whole import hash_file

TOLERANCE = 1e-9
"""Relative, of arrays by their largest value: what other processors may change."""
FILES = ("folded/folded.npz", "sizing/final.npz", "sizing/final.json")


@dataclass(frozen=True)
class Difference:
    """A file of a design: whether its bytes are the same, else the largest relative difference;
    that is None where the archive leaves the file out and knows its hash alone."""

    file: str
    same_bytes: bool
    largest: float | None

    @property
    def passed(self) -> bool:
        """Whether it is the same result."""
        return self.same_bytes or self.largest is None or self.largest <= TOLERANCE

    def describe(self) -> str:
        """Say whether it is the same, in words."""
        if self.same_bytes:
            return f"{self.file}: the same bytes"
        if self.largest is None:
            return f"{self.file}: other bytes; its numbers are not in the archive to compare with"
        return f"{self.file}: differs by {self.largest:.2g} of the largest"


def recompute(bag: Path, design: str, folder: Path, cores: int = 2) -> list[Difference]:
    """Run the workflow of an archive for one design in an empty folder; compare its results.

    Raises
    ------
    InputError
        for a design that the archive does not hold, or a run that fails.
    """
    data = bag / "data"
    if not (data / "results" / design / "manifest.json").is_file():
        raise InputError(f"{bag.name}: no design {design!r} in it")
    task = prepare_rerun(bag, folder)
    try:
        task.run_with_edits([design], [f"results/{design}/sizing/final.json"], cores)
    except InputError as error:
        raise InputError(f"{design}: {error}") from None
    return compare_design(data / "results" / design, folder / "code/results" / design)


def compare_design(archived: Path, anew: Path) -> list[Difference]:
    """Compare shape, final state and verdict of a design in two folders.

    Of what an archive leaves out the record of its job knows the hash.
    """
    written = {
        name: state.sha256
        for record in read_records(archived)
        for name, state in record.outputs.items()
    }
    return [_compare(archived / name, anew / name, name, written.get(name)) for name in FILES]


def _compare(one: Path, other: Path, name: str, written: str | None) -> Difference:
    if not one.is_file():
        return Difference(name, hash_file(other) == written, None)
    if hash_file(one) == hash_file(other):
        return Difference(name, True, 0.0)
    if name.endswith(".json"):
        texts = [json.loads(path.read_text(encoding="utf-8")) for path in (one, other)]
        return Difference(name, False, _largest_in_data(*texts))
    with np.load(one) as first, np.load(other) as second:
        names = sorted(set(first.files) | set(second.files))
        values = [_largest(first.get(key), second.get(key)) for key in names]
    return Difference(name, False, max(values))


def _largest(one: np.ndarray | None, other: np.ndarray | None) -> float:
    """Return the largest difference over the largest value, inf for another shape."""
    if one is None or other is None or one.shape != other.shape:
        return float("inf")
    if not np.issubdtype(one.dtype, np.floating):
        return 0.0 if (one == other).all() else float("inf")
    scale = np.abs(one).max(initial=0.0) or 1.0
    return float(np.abs(one.astype(float) - other).max(initial=0.0) / scale)


def _largest_in_data(one: object, other: object) -> float:
    """Return the largest relative difference of numbers in plain data, inf for anything else."""
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        return max((_largest_in_data(one[key], other[key]) for key in one), default=0.0)
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return max((_largest_in_data(a, b) for a, b in zip(one, other, strict=True)), default=0.0)
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) / (abs(one) or 1.0)
    return 0.0 if one == other else float("inf")
