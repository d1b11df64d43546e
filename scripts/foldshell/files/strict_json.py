"""JSON that a person or another program may have written: what is easily misread is refused."""

import json
from pathlib import Path
from typing import Any, NoReturn

from foldshell.files.errors import InputError
from foldshell.files.whole import read_small_file

LARGEST_FILE = 200_000_000


def read_json_object(path: str | Path, allowed: str) -> dict[str, Any]:
    """Read a JSON file whose top level is an object.

    Raises `InputError` for what is no JSON of RFC 8259 (NaN and Infinity are none), for keys that
    stand twice, and for numbers and nesting beyond what can be read; `allowed` says what is due.
    """
    data = read_small_file(path, LARGEST_FILE, allowed)
    try:
        found = json.loads(
            data.decode("utf-8-sig"),
            object_pairs_hook=_make_object,
            parse_constant=_refuse_constant,
        )
    except RecursionError:
        raise InputError(f"{path}: nested too deeply: {allowed} is needed") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except ValueError as error:  # not UTF-8, not JSON, numbers of thousands of digits
        reason = " ".join(str(error).split())[:120]
        raise InputError(f"{path}: not JSON ({reason}): {allowed} is needed") from None
    if not isinstance(found, dict):
        raise InputError(f"{path}: top level: a {type(found).__name__}: must be an object")
    return found


def _make_object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise InputError(f"key {twice[:60]!r}: stands twice in one object, only once is allowed")
    return found


def _refuse_constant(word: str) -> NoReturn:
    raise InputError(f"{word}: finite numbers are allowed")
