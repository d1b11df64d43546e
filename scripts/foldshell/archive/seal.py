"""The seal of an archive: the SHA-256 of its bytes, in the last of them."""

import hashlib
import os
from pathlib import Path
from typing import BinaryIO

SEAL = b"sha256:"
DIGITS = 64
_CHUNK = 1 << 20


def hash_before_seal(stream: BinaryIO) -> str:
    """Return the SHA-256 of all but the last `DIGITS` bytes of an open file."""
    left = stream.seek(0, os.SEEK_END) - DIGITS
    stream.seek(0)
    digest = hashlib.sha256()
    while left > 0:
        data = stream.read(min(_CHUNK, left))
        digest.update(data)
        left -= len(data)
    return digest.hexdigest()


def is_sealed(path: str | Path) -> bool:
    """Tell whether a file ends with the hash of what stands before."""
    with open(path, "rb") as stream:
        digest = hash_before_seal(stream)
        return stream.read(DIGITS) == digest.encode()
