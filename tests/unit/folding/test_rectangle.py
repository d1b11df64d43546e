"""Plans of two sides: surfaces meet them, and sheets are sized, folded and measured for them."""

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.folding.fold import fold_sheet
from foldshell.folding.quality import measure_coverage
from foldshell.folding.targets import make_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.settings.design import SURFACES
from foldshell.settings.designs import read_designs
from foldshell.settings.fold import Fold
from foldshell.settings.study import Settings

SIDES = (28.0, 14.0)


@pytest.mark.parametrize("name", SURFACES)
def test_a_square_as_two_sides_is_the_square(name):
    one, two = make_target(name, 12, 3), make_target(name, 12, 3, "m", (12.0, 12.0))
    x, y = np.random.default_rng(1).uniform(-6, 6, (2, 20))
    assert two.evaluate_height(x, y) == pytest.approx(one.evaluate_height(x, y), rel=1e-14)
    assert two.section_lengths() == one.section_lengths()


@pytest.mark.parametrize(
    ("name", "corner", "middle_x", "middle_y"),
    [("paraboloid", 0, 2.5, 2.5), ("hypar", 2.5, 5, 0), ("arch", 0, 0, 5), ("arch_strip", 0, 5, 0)],
)
def test_surfaces_meet_the_sides_of_a_rectangle(name, corner, middle_x, middle_y):
    """Heights at a corner and at the middles of the sides x = 14 and y = 7, of 5 m rise."""
    target = make_target(name, 14, 5, "m", SIDES)
    found = target.evaluate_height(np.array([14.0, 14, 0]), np.array([7.0, 0, 7]))
    assert found == pytest.approx([corner, middle_x, middle_y], abs=1e-12)


def test_a_twisted_one_has_its_height_over_the_diagonals():
    target = make_target("hypar_twist", 14, 4, "m", SIDES)
    assert target.evaluate_height(np.array([14.0, 14]), np.array([7.0, -7])) == pytest.approx(
        [4, 0]
    )


def test_section_lengths_are_those_of_two_parabolas():
    """Arc of z = k x2 over 28 m and over 14 m, by 1e5 chords."""
    target = make_target("paraboloid", 14, 5, "m", SIDES)
    for axis, side in enumerate(SIDES):
        along = np.linspace(-side / 2, side / 2, 100_001)
        zero = np.zeros_like(along)
        z = target.evaluate_height(*((along, zero) if axis == 0 else (zero, along)))
        chords = np.hypot(np.diff(along), np.diff(z)).sum()
        assert target.section_lengths()[axis] == pytest.approx(chords, rel=1e-8)


def fold(name, sides, counts, height=5.0):
    target = make_target(name, min(sides), height, "m", sides)
    sheet = design_sheet("miura", target.section_lengths(), *counts, 65.0,
                         turning=measure_turning(target))  # fmt: skip
    return fold_sheet(sheet, target, "elastic", Fold())


@pytest.mark.parametrize("name", ["paraboloid", "hypar", "arch"])
def test_a_sheet_folds_onto_a_rectangle(name):
    """28 m x 14 m: rms distance at most 1e-4 of the span, its plan covered as that of a square."""
    result = fold(name, SIDES, (15, 16))
    assert result.state == "ok"
    assert result.quality.rms_over_span <= 1e-4
    size = np.ptp(result.shape.vertices, axis=0)[:2]
    assert size == pytest.approx(SIDES, rel=0.12)
    assert result.quality.plan_coverage > 0.85


def test_coverage_of_a_rectangle_counts_its_own_plan():
    vertices = np.array([[-2, -1, 0], [2, -1, 0], [2, 1, 0], [-2, 1, 0.0]])
    facets = np.array([[0, 1, 2], [0, 2, 3]])
    assert measure_coverage(vertices, facets, (4.0, 2.0)) == 1.0
    assert measure_coverage(vertices, facets, (8.0, 2.0)) == pytest.approx(0.5, abs=0.01)


def read(folder, cells):
    path = folder / "designs.tsv"
    path.write_text("design\t" + "\t".join(cells) + "\none\t" + "\t".join(cells.values()) + "\n")
    return read_designs(path, Settings())[0]


def test_columns_of_a_rectangle(tmp_path):
    """The shorter side is the span of limits; one side alone stands beside span_m."""
    one = read(tmp_path, {"span_m": "28", "span_y_m": "14"})
    assert one.sides == (28.0, 14.0) and one.span == 14.0
    two = read(tmp_path, {"span_x_m": "10", "span_y_m": "30"})
    assert two.sides == (10.0, 30.0) and two.span == 10.0
    square = read(tmp_path, {"span_m": "28", "span_x_m": "9", "span_y_m": "9"})
    assert square.decide() == read(tmp_path, {"span_m": "9"}).decide()
    plain = read(tmp_path, {"span_m": "28"})
    assert plain.sides == (28.0, 28.0) and "span_x_m" not in plain.decide()


@pytest.mark.parametrize("value", ["-3", "nan", "0.05", "501", "1e3", "ten"])
def test_a_bad_side_is_one_sentence(tmp_path, value):
    with pytest.raises(InputError, match="span_x_m"):
        read(tmp_path, {"span_x_m": value})
