"""Files that are either whole or absent: write to a temporary name, then rename."""

import errno
import glob
import hashlib
import json
import os
import signal
import stat
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from foldshell.files.errors import InputError, find_full_disk

FAULT_POINT = os.environ.get("FOLDSHELL_FAULT_POINT", "")
"""For tests: the process group is killed once a file whose path ends so has been written."""
Json = dict[str, Any]
"""An object as a JSON file holds it, at the border alone: what is read becomes a record."""

DIGITS = 12
"""Hexadecimal digits of the hash of all that decides a design, as tables and workbooks show it."""

SECONDS = "seconds.json"
"""Beside a result: how long it took. No part of the results, and in no manifest."""
TEMPORARY_PREFIX = ".writing-"
"""Begins the name of a file that is not whole yet."""


@contextmanager
def atomic_path(path: str | Path) -> Iterator[Path]:
    """Yield a temporary name beside `path`; rename it to `path` when the block succeeds.

    The temporary name ends like `path`, since many writers choose the format by its suffix. A
    block that raises leaves neither file behind, and an older `path` untouched; what a killed
    process left of the same file is removed.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    _remove_leftovers(path)
    temporary = path.with_name(f"{TEMPORARY_PREFIX}{os.getpid()}-{path.name}")
    try:
        yield temporary
        if str(path.absolute()) in _HELD:
            _HELD[str(path.absolute())] = temporary
            return
        _put_into_place(temporary, path)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if full := find_full_disk(error):
            full.filename = str(path)
        raise


_HELD: dict[str, Path | None] = {}
"""Files that come into place last: absolute path, and where their content waits."""


@contextmanager
def held_back(path: str | Path) -> Iterator[Callable[[], Path]]:
    """Let a file that is written in the block come into place at its end, after all others.

    Yields a function that tells where its content is until then. A block that raises leaves what
    stood there before.
    """
    key = str(Path(path).absolute())
    _HELD[key] = None
    try:
        yield lambda: _HELD[key] or Path(path)
        if _HELD[key]:
            _put_into_place(_HELD[key], Path(path))
    finally:
        waiting = _HELD.pop(key)
        if waiting:
            waiting.unlink(missing_ok=True)


def _put_into_place(temporary: Path, path: Path) -> None:
    os.replace(temporary, path)
    if FAULT_POINT and str(path).endswith(FAULT_POINT):
        os.killpg(0, signal.SIGKILL)


def _remove_leftovers(path: Path) -> None:
    for left in path.parent.glob(f"{TEMPORARY_PREFIX}*-{glob.escape(path.name)}"):
        writer = left.name.removeprefix(TEMPORARY_PREFIX).partition("-")[0]
        if writer.isdigit() and not _is_alive(int(writer)):
            left.unlink(missing_ok=True)


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        pass
    return True


def write_text_if_changed(path: str | Path, text: str) -> None:
    """Write `text`, unless the file holds just that already."""
    path = Path(path)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        with atomic_path(path) as temporary:
            temporary.write_text(text, encoding="utf-8")


def write_json(path: str | Path, data: Any) -> None:
    """Write `data` as indented JSON; numpy values become plain ones, nan and inf are refused."""
    text = json.dumps(data, indent=1, allow_nan=False, default=_plain, ensure_ascii=False)
    with atomic_path(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not plain data")


def read_json(path: str | Path) -> Any:
    """Read a JSON file."""
    return json.loads(Path(path).read_text(encoding="utf-8"))


def write_arrays(path: str | Path, arrays: Mapping[str, np.ndarray]) -> None:
    """Write named arrays as an uncompressed .npz whose bytes depend on the values alone."""
    with atomic_path(path) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for name in arrays:
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            with archive.open(entry, "w", force_zip64=True) as stream:
                np.lib.format.write_array(stream, np.asanyarray(arrays[name]), allow_pickle=False)


def read_arrays(path: str | Path) -> dict[str, np.ndarray]:
    """Read every array of an .npz file."""
    with np.load(path, allow_pickle=False) as data:
        return {name: data[name] for name in data.files}


def open_regular(path: str | Path) -> BinaryIO:
    """Open a plain file for reading; raise OSError for a folder, and for a pipe or a device, which
    would be waited for without end."""
    number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
    if not stat.S_ISREG(os.fstat(number).st_mode):
        os.close(number)
        raise OSError(errno.EINVAL, "not a plain file", str(path))
    return os.fdopen(number, "rb")


def read_small_file(path: str | Path, largest: int, allowed: str) -> bytes:
    """Read a file of at most `largest` bytes that a person may have put there.

    Raises `InputError` that says what is wrong and, for a larger one, what is `allowed`.
    """
    try:
        with open_regular(path) as stream:
            data = stream.read(largest + 1)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if len(data) > largest:
        raise InputError(f"{path}: larger than {largest / 1e6:.0f} MB: {allowed} is allowed")
    return data


def hash_file(path: str | Path) -> str:
    """Return the SHA-256 of a file's bytes, in hexadecimal."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def hash_data(data: Any) -> str:
    """Return the SHA-256 of plain data, whatever the order of its keys."""
    text = json.dumps(data, sort_keys=True, allow_nan=False, default=_plain)
    return hashlib.sha256(text.encode()).hexdigest()
