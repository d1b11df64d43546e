"""DXF and SVG of a crease pattern, read back by other libraries."""

import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import ezdxf
import ezdxf.bbox
import numpy as np
import pytest

from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.miura import Miura, flat_vertices

SCRIPTS = Path(__file__).resolve().parents[3] / "scripts"
PATTERN = Miura(1.3, 0.7, math.radians(60), 5, 6)


RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
DXF_COLOURS = {"fold": (RED, BLUE), "paper": (GREEN, RED), "laser": (BLUE, GREEN)}
"""Mountain and valley; AutoCAD's index knows one green."""


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
    assert outline.closed and outline.dxf.layer == "BORDER"
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
    width = 5 * 700 * math.sin(math.radians(60))
    assert float(root.attrib["viewBox"].split()[2]) == pytest.approx(width)
    assert float(root.attrib["width"][:-2]) == pytest.approx(width / 10)  # 5.55 m high: 1:10
    groups = {g.attrib["id"]: g for g in root if "id" in g.attrib}
    assert set(groups) == {"BORDER", "MOUNTAIN", "VALLEY"}
    path = groups["MOUNTAIN"][0].attrib["d"]
    assert path.count("M") == (PATTERN.grid.assignments == "M").sum()


def test_small_drawing_opens_at_its_own_size(tmp_path):
    flat = flat_vertices(PATTERN)
    write_svg(tmp_path / "a.svg", draw_pattern(flat, PATTERN.grid, 0.1))
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert float(root.attrib["width"][:-2]) == float(root.attrib["viewBox"].split()[2])
    assert "1:10" in root.find("{*}desc").text


@pytest.mark.parametrize(
    ("preset", "mountain", "valley", "border"),
    [
        ("fold", "#ff0000", "#0000ff", "#000000"),
        ("paper", "#008000", "#ff0000", "#000000"),
        ("laser", "#0000ff", "#00ff00", "#ff0000"),
    ],
)
def test_each_preset_has_its_colours(tmp_path, drawing, preset, mountain, valley, border):
    """Tools of the field know a fold by exactly these strokes: red mountain, blue valley, black."""
    write_svg(tmp_path / "a.svg", drawing, preset)
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    strokes = {e.attrib["stroke"]: e for e in root.iter() if "stroke" in e.attrib}
    assert set(strokes) == {mountain, valley, border}
    kinds = PATTERN.grid.assignments
    for colour, kind in ((mountain, "M"), (valley, "V")):
        assert strokes[colour].attrib["d"].count("L") == (kinds == kind).sum()
    assert len(strokes[border].attrib["points"].split()) == (kinds == "B").sum()
    write_dxf(tmp_path / "a.dxf", drawing, preset)
    layers = {layer.dxf.name: layer.rgb or ezdxf.colors.aci2rgb(layer.color)
              for layer in ezdxf.readfile(tmp_path / "a.dxf").layers}  # fmt: skip
    assert ("CUT" in layers) == (preset == "laser") == ("BORDER" not in layers)
    assert (layers["MOUNTAIN"], layers["VALLEY"]) == tuple(DXF_COLOURS[preset])


@pytest.mark.parametrize("scale", [1.0, 0.02])
def test_header_has_the_true_extents(tmp_path, scale):
    """The header, the model space and the bounding box of all its entities agree."""
    drawing = draw_pattern(flat_vertices(PATTERN), PATTERN.grid, scale, "roof")
    write_dxf(tmp_path / "a.dxf", drawing)
    document = ezdxf.readfile(tmp_path / "a.dxf")
    box = ezdxf.bbox.extents(document.modelspace())
    width, height = 3031.08891324553, 4 * 1300 + 700 * math.cos(math.radians(60))
    assert box.extmax.isclose((scale * width, scale * height, 0), abs_tol=1e-6)
    assert box.extmin.isclose((0, 0, 0), abs_tol=1e-6)
    for name in ("EXTMIN", "EXTMAX"):
        true = getattr(box, name.lower())
        assert true.isclose(document.header[f"${name}"], abs_tol=1e-9)
        assert true.isclose(document.modelspace().dxf.get(name.lower()), abs_tol=1e-9)


def test_layout_has_the_title_block(tmp_path, drawing):
    titled = draw_pattern(flat_vertices(PATTERN), PATTERN.grid, 0.05, "roof of a hall")
    write_dxf(tmp_path / "a.dxf", titled)
    layout = ezdxf.readfile(tmp_path / "a.dxf").layout("Layout1")
    text = " ".join(entity.dxf.text for entity in layout.query("TEXT"))
    assert "roof of a hall" in text and "3.031 x 5.550 m" in text and "1:20" in text
    assert layout.query("VIEWPORT")


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
        "write_dxf(sys.argv[1], Drawing(np.eye(3)[:, :2], {'valley': np.ones((1, 2, 2))}))"
    )
    files = []
    for seed in "0123":
        files.append(tmp_path / f"{seed}.dxf")
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(SCRIPTS)}
        subprocess.run([sys.executable, "-c", code, str(files[-1])], env=environment, check=True)
    assert len({file.read_bytes() for file in files}) == 1
