"""VTU files of one kind of cell: base64 of deflated arrays, as VTK and meshio read them.

Written here because to import meshio takes as long as to write a design's two files: 0.1 s.
"""

import base64
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path

VTK_CELLS = {2: 3, 3: 5}
"""VTK's numbers of line and triangle, by nodes of a cell."""
TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}
LEVEL = 4


def write_vtu(
    path: str | Path,
    points: np.ndarray,
    cells: np.ndarray,
    point_data: Mapping[str, np.ndarray],
    cell_data: Mapping[str, np.ndarray],
    field_data: Mapping[str, np.ndarray | Sequence[str]] | None = None,
) -> None:
    """Write points (N, 3), lines (C, 2) or triangles (C, 3), and fields of points and cells.

    Fields are (N,) or (N, k), (C,) or (C, k); what is said of all of it, in `field_data`, is
    numbers (n,) or lines of text, which VTK reads and meshio does not. The bytes depend on the
    values alone.
    """
    count, corners = cells.shape
    offsets = corners * np.arange(1, count + 1)
    kinds = np.full(count, VTK_CELLS[corners], dtype=np.uint8)
    topology = {"connectivity": cells.ravel(), "offsets": offsets, "types": kinds}
    text = f"""<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" \
header_type="UInt64" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
{_write_field_data(field_data or {})}<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">
<Points>
{_write_array("Points", np.asarray(points, dtype=float))}
</Points>
<Cells>
{_write_arrays(topology)}
</Cells>
<PointData>
{_write_arrays(point_data)}
</PointData>
<CellData>
{_write_arrays(cell_data)}
</CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
"""
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="ascii")


def _write_field_data(data: Mapping[str, np.ndarray | Sequence[str]]) -> str:
    """Return numbers as they are and text by the codes of its bytes, a zero after each line."""
    parts = []
    for name, values in data.items():
        if isinstance(values, np.ndarray):
            parts.append(_write_array(name, values, f' NumberOfTuples="{len(values)}"'))
            continue
        codes = " ".join(str(code) for line in values for code in (*line.encode(), 0))
        parts.append(
            f'<DataArray type="String" Name="{name}" NumberOfTuples="{len(values)}" '
            f'format="ascii">{codes}</DataArray>'
        )
    return "<FieldData>\n" + "\n".join(parts) + "\n</FieldData>\n" if parts else ""


def _write_arrays(arrays: Mapping[str, np.ndarray]) -> str:
    return "\n".join(_write_array(name, values) for name, values in arrays.items())


def _write_array(name: str, values: np.ndarray, more: str = "") -> str:
    """Return one array; its data is one block: numbers of blocks and sizes, then the deflated."""
    kind = f"{values.dtype.kind}{values.dtype.itemsize}"
    raw = np.ascontiguousarray(values).astype(f"<{kind}").tobytes()
    packed = zlib.compress(raw, LEVEL)
    head = np.array([1, len(raw), len(raw), len(packed)] if raw else [0, 0, 0], dtype="<u8")
    text = base64.b64encode(head.tobytes()) + base64.b64encode(packed if raw else b"")
    parts = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else more
    return (
        f'<DataArray type="{TYPES[kind]}" Name="{name}"{parts} '
        f'format="binary">{text.decode("ascii")}</DataArray>'
    )
