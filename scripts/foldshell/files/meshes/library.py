"""Formats that libraries read: in a process of its own, whose crash is a refusal."""

import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.libraries import need_library
from foldshell.files.meshes import child, rhino_child
from foldshell.files.meshes.model import Mesh, MeshError, make_mesh
from foldshell.files.meshes.nurbs import make_patch, mesh_patch
from foldshell.files.units import find_factor

BESIDE = rhino_child.__name__
"""Read by the child too: named here, so that rules know that reading depends on it."""
SECONDS = 120
"""Time that reading may take."""


def read_by_library(path: str | Path, unit: str = "metres", chord: float | None = None) -> Mesh:
    """Read a .vtk, .vtu, .vtp, .msh or .3dm file; a model of Rhino must be in `unit`, if any.

    A NURBS surface becomes a mesh within `chord` [m] of it.
    Raises `MeshError`, also where the reader crashes, and what to type where the library for
    Rhino's files is missing.
    """
    if Path(path).suffix.lower() == ".3dm":
        try:
            need_library("rhino3dm", "exports")
        except InputError as error:
            raise MeshError(f"cannot be read: {error}") from None
    with tempfile.TemporaryDirectory(prefix="foldshell-") as folder:
        out = Path(folder) / "mesh.npz"
        places = [str(Path(path).resolve()), str(out)]
        code, said = _run([sys.executable, child.__file__, *places, unit])
        if code == child.REFUSED:
            raise MeshError(said)
        if code < 0:
            name = signal.Signals(-code).name
            raise MeshError(f"the library that reads it was ended by {name}: damaged or too large")
        if code:
            raise MeshError("the library that reads it failed: damaged, or another format")
        with np.load(out, allow_pickle=False) as stored:
            arrays = dict(stored)
    return replace(_make_mesh(arrays, chord), unit=str(arrays.get("unit", "")))


def _make_mesh(arrays: dict[str, np.ndarray], chord: float | None) -> Mesh:
    """The polygons that the child wrote, or those of its surface."""
    if "knots_u" in arrays:
        patch = make_patch(arrays["points"], arrays["knots_u"], arrays["knots_v"])
        metres = find_factor(str(arrays["unit"]), None)
        return mesh_patch(patch, None if chord is None else chord / metres)
    vertices, sizes, corners = (arrays[k] for k in ("vertices", "sizes", "corners"))
    return make_mesh(vertices, sizes, corners, vertices.dtype == np.float32)


def _run(command: list[str]) -> tuple[int, str]:
    """Exit code of a command, and the line that it printed last."""
    quiet = {**os.environ, "VTK_SILENCE_GET_VOID_POINTER_WARNINGS": "1"}
    try:
        ended = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, env=quiet
        )
    except subprocess.TimeoutExpired:
        raise MeshError(
            f"takes longer than {SECONDS} s to be read: damaged, or too large"
        ) from None
    lines = ended.stdout.decode("utf-8", "replace").strip().splitlines()
    return ended.returncode, lines[-1] if lines else "damaged"
