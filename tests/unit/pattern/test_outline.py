"""Outlines and openings: read from texts and files, mended or refused in one sentence."""

import ezdxf
import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.pattern.outline import read_outline
from foldshell.pattern.panel_graph import measure_area

SQUARE = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
HOLE = [(-2, -2), (2, -2), (2, 2), (-2, 2)]


def write(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def rows(points):
    return "\n".join(f"{x} {y}" for x, y in points)


def write_dxf(folder, unit=6, factor=1.0):
    document = ezdxf.new()
    document.units = unit
    for ring in (SQUARE, HOLE):
        points = [(factor * x, factor * y) for x, y in ring]
        document.modelspace().add_lwpolyline(points, close=True)
    document.saveas(folder / "plan.dxf")
    return str(folder / "plan.dxf")


def test_none_is_no_outline():
    assert read_outline("none", "none") is None


def test_texts_of_the_table():
    found = read_outline("box -9 -9 9 9", "polygon -2 -2, 2 -2, 2 2, -2 2; box 4 4 5 5")
    assert found.outer.tolist() == [list(map(float, point)) for point in SQUARE]
    assert [measure_area(hole) for hole in found.openings] == [-16, -1]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("plan.csv", "x,y\n" + rows(SQUARE).replace(" ", ",") + "\n\n" + rows(HOLE)),
        ("plan.txt", "# made by hand\n" + rows(SQUARE) + "\n\n\n" + rows(HOLE) + "\n"),
        ("plan.json", str([list(map(list, SQUARE)), list(map(list, HOLE))])),
        (
            "plan.geojson",
            '{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": '
            f"{[[list(p) for p in (*ring, ring[0])] for ring in (SQUARE, HOLE)]}}}}}",
        ),
    ],
)
def test_files_of_points(tmp_path, name, text):
    """The largest polygon is the outline, one inside it an opening."""
    found = read_outline(write(tmp_path, name, text), "none")
    assert measure_area(found.outer) == 324
    assert [measure_area(hole) for hole in found.openings] == [-16]


@pytest.mark.parametrize(
    ("unit", "factor", "given"), [(6, 1, "m"), (4, 1000, "mm"), (4, 1000, "declared"), (0, 1, "m")]
)
def test_drawings_with_their_unit(tmp_path, unit, factor, given):
    found = read_outline(write_dxf(tmp_path, unit, factor), "none", given)
    assert measure_area(found.outer) == pytest.approx(324)
    assert len(found.openings) == 1


def test_another_unit_than_the_file_declares_is_refused(tmp_path):
    with pytest.raises(InputError, match="declares millimetres, file_unit says metres"):
        read_outline(write_dxf(tmp_path, 4, 1000), "none", "m")


def test_clockwise_doubled_and_closed_rings_are_mended(tmp_path):
    ring = [*SQUARE[::-1], SQUARE[-1]]
    plain = read_outline(write(tmp_path, "a.csv", rows(ring)), "none")
    assert measure_area(plain.outer) == 324 and not plain.notes
    assert plain.outer[0].tolist() == [-9, 9], "sides are counted from the first corner"
    closed = read_outline("polygon -9 -9, 9 -9, 9 9, -9 9, -9 -9", "none")
    assert closed.outer.tolist() == [list(map(float, point)) for point in SQUARE]
    doubled = read_outline(
        write(tmp_path, "b.csv", rows([*SQUARE[:2], SQUARE[1], *SQUARE[2:]])), "none"
    )
    assert len(doubled.outer) == 4
    assert "1 corners that stand twice" in doubled.notes[0]


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ("0 0\n10 10\n10 0\n0 9\n", "crosses itself at"),
        ("0 0\n5 0\n10 0\n", "enclose no area"),
        ("0 0\n1 1\n", "2 different corners"),
        ("0 0\nnan 1\n1 1\n", "no finite number"),
        ("0 0\n1 1 1\n1 1\n", "line 2: 3 numbers"),
        ("a b c\n", "line 1: 'a b c': x and y"),
        ("", "holds no polygon"),
        ("-9 -9\n9 -9\n9 9\n9 15\n9 9\n-9 9\n", "crosses itself"),
    ],
)
def test_what_is_no_polygon_is_one_sentence(tmp_path, points, words):
    path = write(tmp_path, "plan.csv", points)
    with pytest.raises(InputError) as caught:
        read_outline(path, "none")
    message = str(caught.value)
    assert words in message and message.startswith(path) and "\n" not in message


@pytest.mark.parametrize(
    ("openings", "words"),
    [
        ("box 20 20 22 22", "lies outside the outline"),
        ("box 7 7 11 11", "reaches beyond the outline"),
        ("box 0 0 9 2", "touches the outline"),
        ("box 0 0 2 2; box 2 0 4 2", "openings 1 and 2 .* touch or overlap"),
        ("box 0 0 2 2; box 1 1 4 2", "touch or overlap"),
    ],
)
def test_openings_that_are_not_inside_are_refused(openings, words):
    with pytest.raises(InputError, match=f"openings: .*{words}"):
        read_outline("box -9 -9 9 9", openings)


def test_lines_that_do_not_close_are_refused(tmp_path):
    document = ezdxf.new()
    document.modelspace().add_line((0, 0), (9, 0))
    document.modelspace().add_line((9, 0), (9, 9))
    document.saveas(tmp_path / "open.dxf")
    with pytest.raises(InputError, match="a line ends by itself"):
        read_outline(str(tmp_path / "open.dxf"), "none")


def test_random_polygons_are_read_as_they_are(tmp_path):
    rng = np.random.default_rng(1)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 9))
    ring = np.column_stack([np.cos(angle), np.sin(angle)]) * rng.uniform(3, 9, (9, 1))
    found = read_outline(write(tmp_path, "a.csv", rows(ring.tolist())), "none")
    assert np.array_equal(found.outer, ring)
