"""Arrays inside a web page: whole numbers, deflated, as base64 text."""

import base64
import zlib
from collections.abc import Mapping, Sequence

import numpy as np

from foldshell.files.whole import Json

STEPS, COARSE_STEPS = 65534, 254
"""Steps between the least and the largest of real values; the number after them stands for nan."""
LEVEL = 9


def pack_arrays(arrays: Mapping[str, np.ndarray]) -> tuple[list[Json], str]:
    """Return a header an array, and the deflated bytes of all of them as base64.

    Whole numbers keep their value in the least of uint8, uint16, uint32 that holds them. Real
    ones are rounded to value = low + step * number, number in 0 ... 65534, and nan is 65535; of
    single precision, which says that they are only to be looked at, 0 ... 254 and 255. Each array
    starts at a multiple of 4 bytes. Little-endian.

    Arrays of any shape, such as (P,) or (V, 3), and unit.
    """
    headers, parts, offset = [], [], 0
    for name, values in arrays.items():
        values = np.asarray(values)
        steps = COARSE_STEPS if values.dtype == np.float32 else STEPS
        scale = {} if values.dtype.kind in "biu" else _find_range(values, steps)
        numbers = _to_numbers(values, steps, **scale) if scale else _shorten(values)
        header = {"name": name, "type": numbers.dtype.name, "shape": list(values.shape)}
        headers.append(header | {"offset": offset} | scale)
        data = numbers.astype(numbers.dtype.newbyteorder("<")).tobytes()
        parts.append(data + bytes(-len(data) % 4))
        offset += len(parts[-1])
    return headers, base64.b64encode(zlib.compress(b"".join(parts), LEVEL)).decode("ascii")


def unpack_arrays(headers: Sequence[Json], text: str) -> dict[str, np.ndarray]:
    """Return the arrays by name: what the page does, for tests and other readers.

    Shapes, such as (P,) or (V, 3), stand in the headers.

    Shapes, such as (P,) or (V, 3), stand in the headers; units are those that were packed.
    """
    data = zlib.decompress(base64.b64decode(text))
    arrays = {}
    for header in headers:
        kind = np.dtype(header["type"]).newbyteorder("<")
        shape = tuple(header["shape"])
        numbers = np.frombuffer(data, kind, int(np.prod(shape)), header["offset"]).reshape(shape)
        if "step" in header:
            real = header["low"] + header["step"] * numbers
            missing = numbers == np.iinfo(numbers.dtype).max
            arrays[header["name"]] = np.where(missing, np.nan, real)
        else:
            arrays[header["name"]] = numbers
    return arrays


def _find_range(values: np.ndarray, steps: int) -> dict[str, float]:
    """Return the least finite value and the step from one number to the next."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    return {"low": low, "step": (high - low) / steps or 1.0}


def _to_numbers(values: np.ndarray, steps: int, low: float, step: float) -> np.ndarray:
    finite = np.isfinite(values)
    numbers = np.round((np.where(finite, values, low) - low) / step)
    kind = np.min_scalar_type(steps + 1)
    return np.where(finite, np.clip(numbers, 0, steps), steps + 1).astype(kind)


def _shorten(values: np.ndarray) -> np.ndarray:
    largest = int(values.max()) if values.size else 0
    return values.astype(np.min_scalar_type(largest))
