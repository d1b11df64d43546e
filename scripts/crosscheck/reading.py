"""Plain JSON with a place for every value, so that a refusal says where it stands."""

import json
import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from crosscheck.errors import CrosscheckError

MISSING = object()


def read_json(path: str | Path) -> Any:
    """Parse a JSON file; raises CrosscheckError when it cannot be read."""
    path = Path(path)
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise CrosscheckError(f"{path.name}: cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise CrosscheckError(f"{path.name}: not JSON ({error})") from None


@contextmanager
def write_whole(path: str | Path) -> Iterator[Path]:
    """Yield a temporary name beside `path` and rename it when the block succeeds.

    Whatever a killed run left of the same file goes: one job alone writes a file.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    for left in path.parent.glob(f".writing-*{path.name}"):
        left.unlink(missing_ok=True)
    temporary = path.with_name(f".writing-{os.getpid()}-{path.name}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_json(path: str | Path, data: Any) -> None:
    """Write indented JSON; nan and infinity are refused."""
    text = json.dumps(data, indent=1, allow_nan=False)
    with write_whole(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


@dataclass(frozen=True)
class Place:
    """A value in a file, and where it stands."""

    file: str
    path: str
    value: Any

    def refuse(self, found: Any, allowed: str) -> NoReturn:
        """Raise the sentence: file, place, value, what is allowed."""
        where = f"{self.file}: {self.path}" if self.path else self.file
        raise CrosscheckError(f"{where}: {_shorten(found)} is not usable: allowed is {allowed}")

    def key(self, name: str, default: Any = MISSING) -> "Place":
        """The value under a key, or the default where the key is absent."""
        if not isinstance(self.value, dict):
            self.refuse(self.value, "an object with keys")
        value = self.value.get(name, default)
        place = Place(self.file, f"{self.path}.{name}" if self.path else name, value)
        if value is MISSING:
            place.refuse("a missing key", "a value")
        return place

    def names(self) -> list[str]:
        """The keys of an object, in the file's order."""
        if not isinstance(self.value, dict):
            self.refuse(self.value, "an object with keys")
        return list(self.value)

    def at(self, index: int) -> "Place":
        """An entry of a list."""
        return Place(self.file, f"{self.path}[{index}]", self.value[index])

    def text(self) -> str:
        """A string."""
        if not isinstance(self.value, str):
            self.refuse(self.value, "a text")
        return self.value

    def one_of(self, names: list[str]) -> str:
        """One of some names."""
        if self.value not in names:
            self.refuse(self.value, "one of " + ", ".join(names))
        return self.value

    def number(
        self,
        least: float = -math.inf,
        above: float = -math.inf,
        below: float = math.inf,
    ) -> float:
        """A finite number within bounds."""
        value = self.value
        usable = isinstance(value, int | float) and not isinstance(value, bool)
        if not usable or not math.isfinite(value) or value < least or value <= above:
            self.refuse(value, _describe_bounds(least, above, below))
        if value >= below:
            self.refuse(value, _describe_bounds(least, above, below))
        return float(value)

    def entries(self) -> list["Place"]:
        """The entries of a list that is not empty."""
        if not isinstance(self.value, list) or not self.value:
            self.refuse(self.value, "a list that is not empty")
        return [self.at(k) for k in range(len(self.value))]

    def numbers(self, width: int | None, above: float = -math.inf) -> np.ndarray:
        """A list (n,) of numbers, or of rows (n, width), in the unit that the file states."""
        rows = [
            place.number(above=above) if width is None else place.row(width)
            for place in self.entries()
        ]
        return np.array(rows, dtype=float)

    def row(self, width: int) -> list[float]:
        """A list of exactly `width` numbers."""
        if not isinstance(self.value, list) or len(self.value) != width:
            self.refuse(self.value, f"a list of {width} numbers")
        return [self.at(k).number() for k in range(width)]

    def indices(self, width: int | None, count: int) -> np.ndarray:
        """Whole numbers (n,) from 0 to count - 1, or rows (n, width) of them without a repeat."""
        values = self.numbers(width)
        bad = (values != np.floor(values)) | (values < 0) | (values >= count)
        bad = bad if width is None else bad.any(axis=1)
        if width is not None:
            ordered = np.sort(values, axis=1)
            bad |= (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
        if bad.any():
            first = self.at(int(np.flatnonzero(bad)[0]))
            first.refuse(first.value, f"different whole numbers from 0 to {count - 1}")
        return values.astype(np.int64)


def _describe_bounds(least: float, above: float, below: float) -> str:
    parts = ["a finite number"]
    if above > -math.inf:
        parts.append(f"above {above:g}")
    if least > -math.inf:
        parts.append(f"from {least:g}")
    if below < math.inf:
        parts.append(f"below {below:g}")
    return " ".join(parts)


def _shorten(value: Any) -> str:
    text = value if isinstance(value, str) else json.dumps(value, default=str)
    return text if len(text) <= 60 else text[:57] + "..."
