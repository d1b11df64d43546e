"""Typed arrays of .npz files: names, axes, units; read whole and checked."""

import dataclasses
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, write_arrays
from foldshell.records.files import REMEDY

Arrays = TypeVar("Arrays")


@dataclass(frozen=True)
class ArrayEntry:
    """An array of a file: axes by letter ("P, 3"), unit, meaning, whether it may be missing."""

    axes: tuple[str, ...]
    unit: str
    meaning: str
    required: bool


def array(axes: str, unit: str, meaning: str, required: bool = False) -> Any:
    """Return a dataclass field for an array; one that may be missing is None then.

    A letter stands for one size in all arrays of the file, a number for itself.
    """
    named = tuple(filter(None, axes.replace(" ", "").split(",")))
    about = ArrayEntry(named, unit, meaning, required)
    default = dataclasses.MISSING if required else None
    return dataclasses.field(default=default, metadata={"array": about})


@cache
def array_entries(kind: type) -> Mapping[str, ArrayEntry]:
    """Return what a class says of its arrays, by name."""
    return MappingProxyType({f.name: f.metadata["array"] for f in dataclasses.fields(kind)})


def read_typed_arrays(path: str | Path, kind: type[Arrays]) -> Arrays:
    """Read an .npz file as arrays of a class.

    Raises
    ------
    InputError
        for a file that is missing or damaged, and an array that is missing or of other axes.
    """
    try:
        found = read_arrays(path)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file: start again, it is computed anew") from None
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        raise InputError(f"{path}: cannot be read as arrays: {REMEDY}") from None
    try:
        return make_typed_arrays(kind, found)
    except ValueError as error:
        raise InputError(f"{path}: {error}: {REMEDY}") from None


def read_checked_arrays(path: str | Path, kind: type) -> dict[str, np.ndarray]:
    """Read an .npz file that is to hold the arrays of a class; return them by name.

    Axes and units are those that the class states. Raises `InputError` as `read_typed_arrays`.
    """
    return list_arrays(read_typed_arrays(path, kind))


def make_typed_arrays(kind: type[Arrays], found: Mapping[str, np.ndarray]) -> Arrays:
    """Return named arrays as those of a class.

    Raises `ValueError` that names an array which is missing or of other axes.

    Axes and units are those that the class states, such as (P,) m.
    """
    sizes: dict[str, int] = {}
    for name, about in array_entries(kind).items():
        if name in found:
            _check_axes(name, about, found[name].shape, sizes)
        elif about.required:
            raise ValueError(f"{name}: is missing")
    return kind(**{name: found[name] for name in array_entries(kind) if name in found})


def _check_axes(
    name: str, about: ArrayEntry, shape: tuple[int, ...], sizes: dict[str, int]
) -> None:
    """Compare a shape with its axes; `sizes` holds what the letters stand for so far."""
    due = ", ".join(about.axes)
    fits = len(shape) == len(about.axes) and all(
        sizes.setdefault(axis, int(axis) if axis.isdigit() else size) == size
        for axis, size in zip(about.axes, shape, strict=True)
    )
    if not fits:
        known = ", ".join(f"{axis} = {size}" for axis, size in sizes.items() if axis in due)
        raise ValueError(f"{name}: {shape}: must be ({due})" + (f" with {known}" if known else ""))


def list_arrays(arrays: Any) -> dict[str, np.ndarray]:
    """Return the arrays that there are, by name.

    Axes and units are those that the class states, such as (P,) m.
    """
    named = {name: getattr(arrays, name) for name in array_entries(type(arrays))}
    return {name: values for name, values in named.items() if values is not None}


def write_typed_arrays(path: str | Path, arrays: Any) -> None:
    """Write the arrays of a class, whole or not at all."""
    write_arrays(path, list_arrays(arrays))
