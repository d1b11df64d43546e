"""DXF and SVG of a crease pattern, read back by other libraries."""

import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.miura import Miura, flat_vertices

SCRIPTS = Path(__file__).resolve().parents[3] / "scripts"
PATTERN = Miura(1.3, 0.7, math.radians(60), 5, 6)


@pytest.fixture
def drawing():
    return draw_pattern(flat_vertices(PATTERN), PATTERN.grid)


def test_dxf_reads_back_in_millimetres(tmp_path, drawing):
    write_dxf(tmp_path / "a.dxf", drawing)
    document = ezdxf.readfile(tmp_path / "a.dxf")
    assert document.units == ezdxf.units.MM and document.dxfversion == "AC1024"
    assert not document.audit().has_errors
    lines = document.modelspace().query("LINE")
    kinds = PATTERN.grid.assignments
    for layer, kind in (("MOUNTAIN", "M"), ("VALLEY", "V")):
        assert sum(line.dxf.layer == layer for line in lines) == (kinds == kind).sum()
    ends = {
        tuple(sorted((tuple(np.round(l.dxf.start, 6)), tuple(np.round(l.dxf.end, 6)))))
        for l in lines  # noqa: E741
    }
    assert len(ends) == len(lines)  # no line twice
    (outline,) = document.modelspace().query("LWPOLYLINE")
    assert outline.closed and outline.dxf.layer == "CUT"
    assert len(outline) == 2 * (5 + 6) - 4
    corners = np.array([point[:2] for point in outline])
    area = np.cross(np.c_[corners, 0 * corners[:, 0]], np.roll(np.c_[corners, 0 * corners[:, 0]],
                    -1, axis=0))[:, 2].sum() / 2  # fmt: skip
    exact = 4 * 5 * 1.3 * 0.7 * math.sin(math.radians(60)) * 1e6
    assert area == pytest.approx(exact, rel=1e-9)


def test_svg_has_the_layers_and_the_size(tmp_path, drawing):
    write_svg(tmp_path / "a.svg", drawing)
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert root.attrib["width"].endswith("mm")
    assert float(root.attrib["width"][:-2]) == pytest.approx(5 * 700 * math.sin(math.radians(60)))
    groups = {g.attrib["id"]: g for g in root}
    assert set(groups) == {"CUT", "MOUNTAIN", "VALLEY"}
    path = groups["MOUNTAIN"][0].attrib["d"]
    assert path.count("M") == (PATTERN.grid.assignments == "M").sum()


def test_same_lines_give_the_same_bytes(tmp_path, drawing):
    for name in "ab":
        write_dxf(tmp_path / f"{name}.dxf", drawing)
        write_svg(tmp_path / f"{name}.svg", drawing)
    for suffix in ("dxf", "svg"):
        one, two = ((tmp_path / f"{n}.{suffix}").read_bytes() for n in "ab")
        assert one == two


def test_another_process_gives_the_same_dxf(tmp_path):
    """Sets of names have another order in every process."""
    code = (
        "import sys; from foldshell.pattern.drawings import *; import numpy as np; "
        "write_dxf(sys.argv[1], Drawing(np.eye(3)[:, :2], {'VALLEY': np.ones((1, 2, 2))}))"
    )
    files = []
    for seed in "0123":
        files.append(tmp_path / f"{seed}.dxf")
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(SCRIPTS)}
        subprocess.run([sys.executable, "-c", code, str(files[-1])], env=environment, check=True)
    assert len({file.read_bytes() for file in files}) == 1
