"""Typst templates filled with data, as PDF; typst is a library that few need, so asked for late."""

import json
import tempfile
from collections.abc import Mapping
from pathlib import Path

from foldshell.files.libraries import need_library
from foldshell.files.whole import Json, atomic_path

FOLDER = Path(__file__).parent / "templates"


def write_pdf(path: str | Path, template: str, files: Mapping[str, bytes]) -> None:
    """Write a template (`<template>.typ`) with the files that it reads by name, as PDF.

    The bytes depend on the files alone: no date enters.

    Raises
    ------
    InputError
        where typst is not installed, with what to type.
    """
    typst = need_library("typst", "sheets")
    with tempfile.TemporaryDirectory() as folder:
        text = (FOLDER / f"{template}.typ").read_bytes()
        for name, content in {"main.typ": text, **files}.items():
            Path(folder, name).write_bytes(content)
        main = Path(folder, "main.typ")
        pdf = typst.compile(str(main), root=folder, ignore_system_fonts=True, timestamp=0)
    with atomic_path(path) as temporary:
        temporary.write_bytes(pdf)


def pack_data(data: Json) -> bytes:
    """Return plain data as the JSON that a template reads."""
    return json.dumps(data, allow_nan=False, ensure_ascii=False).encode()
