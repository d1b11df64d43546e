"""VTU files of one kind of cell, by meshio; what is said of a whole file is added to them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import meshio
import numpy as np

from foldshell.files.whole import atomic_path

CELLS = {2: "line", 3: "triangle"}
"""meshio's names of cells, by their nodes."""
HEAD = b"<UnstructuredGrid>\n"
"""The line below which a VTU file has its FieldData."""


def write_vtu(
    path: str | Path,
    points: np.ndarray,
    cells: np.ndarray,
    point_data: Mapping[str, np.ndarray],
    cell_data: Mapping[str, np.ndarray],
    field_data: Mapping[str, np.ndarray | Sequence[str]] | None = None,
    packed: bool = True,
) -> None:
    """Write points (N, 3) m, lines (C, 2) or triangles (C, 3), and fields of points and cells.

    Fields are (N,) or (N, k), (C,) or (C, k); what is said of all of it, in `field_data`, is
    numbers (n,) or lines of text, which VTK reads, and meshio neither reads nor writes. The bytes
    depend on the values alone. Arrays are compressed where `packed`; without cells they never are:
    an empty one has no block that VTK could unpack.
    """
    of_points = {name: np.ascontiguousarray(values) for name, values in point_data.items()}
    of_cells = {name: [np.ascontiguousarray(values)] for name, values in cell_data.items()}
    blocks = [(CELLS[cells.shape[1]], np.ascontiguousarray(cells))]
    mesh = meshio.Mesh(np.asarray(points, dtype=float), blocks, of_points, of_cells)
    options = {} if packed and len(cells) else {"compression": None}
    with atomic_path(path) as temporary:
        mesh.write(temporary, file_format="vtu", **options)
        if field_data:
            before, head, after = temporary.read_bytes().partition(HEAD)
            words = _write_field_data(field_data).encode("ascii")
            temporary.write_bytes(b"".join((before, head, words, after)))


def _write_field_data(data: Mapping[str, np.ndarray | Sequence[str]]) -> str:
    """Return numbers with all their digits and text by the codes of its bytes, a zero after each
    line."""
    parts = []
    for name, values in data.items():
        if isinstance(values, np.ndarray):
            kind = "Float64" if values.dtype.kind == "f" else "Int64"
            words = " ".join(map(repr, values.tolist()))
        else:
            kind = "String"
            words = " ".join(str(code) for line in values for code in (*line.encode(), 0))
        parts.append(
            f'<DataArray type="{kind}" Name="{name}" NumberOfTuples="{len(values)}" '
            f'format="ascii">{words}</DataArray>\n'
        )
    return f"<FieldData>\n{''.join(parts)}</FieldData>\n"
