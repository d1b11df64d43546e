"""Colour scales: order in grey, the mark at the limit, round ticks."""

import numpy as np
import pytest

from foldshell.results.colour_scales import (
    ABOVE,
    KNOTS,
    MISSING,
    ColourScale,
    colour_table,
    find_ticks,
    format_tick,
    make_limit_scale,
    make_scale,
    round_step,
)


def lightness(colour):
    """Rec. 709 luminance of linearised sRGB, then CIE L* (0 to 100)."""
    share = np.asarray(colour) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    y = linear @ [0.2126, 0.7152, 0.0722]
    return 116 * np.cbrt(y) - 16


@pytest.mark.parametrize("name", sorted(KNOTS))
def test_maps_rise_or_fall_in_grey(name):
    """A map read in grey keeps the order of values: its lightness is monotone (8 bit rounding)."""
    steps = np.diff(lightness(colour_table(name)))
    assert (steps > -0.6).all() or (steps < 0.6).all()
    assert abs(lightness(colour_table(name))[[0, -1]] @ [1, -1]) > 50


@pytest.mark.parametrize(
    ("name", "ends"), [("viridis", (0.12, 1)), ("cividis", (0.1, 1)), ("YlGnBu", (0.04, 0.9))]
)
def test_maps_are_those_of_matplotlib(name, ends):
    """Linear between 33 of matplotlib's colours: within 5 of 255 of all of them."""
    colormaps = pytest.importorskip("matplotlib").colormaps
    exact = 255 * colormaps[name](np.linspace(*ends, 256))[:, :3]
    assert np.abs(colour_table(name) - exact).max() < 5.5


def test_limit_shows_in_grey_and_colour():
    """Just below the limit the map is at its light end, just above it dark red: 40 L* apart."""
    scale = make_limit_scale(np.array([0.2, 1.7]), 1.0)
    below, above = scale.colour(np.array([1.0, 1.0 + 1e-9]))
    assert tuple(above) == ABOVE
    assert lightness(below) - lightness(above) > 40


def test_low_utilization_gets_its_own_range():
    """Where nothing reaches half the limit the scale ends at a round number above the largest."""
    scale = make_limit_scale(np.array([0.01, 0.063]), 1.0)
    assert scale.limit is None
    assert scale.low == 0
    assert scale.high == pytest.approx(0.07, rel=1e-12)


def test_missing_values_are_grey():
    """nan is no colour of the map."""
    colours = ColourScale(0, 1).colour(np.array([np.nan, 0.5]))
    assert tuple(colours[0]) == MISSING
    assert tuple(colours[1]) == tuple(colour_table("viridis")[127])


def test_scale_of_equal_values_is_not_empty():
    """40 mm everywhere: the scale spans 20 to 60 mm around it."""
    scale = make_scale(np.full(5, 40.0))
    assert (scale.low, scale.high) == (20, 60)


def test_rounding_errors_do_not_look_like_a_field():
    """Planar panels measure 1e-16: the scale keeps its least range, and its ticks their values."""
    scale = make_scale(np.array([0.0, 3e-16]), zero=True, least=0.01)
    assert (scale.low, scale.high) == pytest.approx((0, 0.01))
    assert find_ticks(0, 3e-16)[1] == pytest.approx(5e-17)


@pytest.mark.parametrize(
    ("size", "step"), [(1.0, 1), (1.01, 2), (2.2, 2.5), (0.03, 0.05), (70, 100)]
)
def test_steps_are_round(size, step):
    """1, 2, 2.5, 5 times a power of ten, not below the size."""
    assert round_step(size) == pytest.approx(step, rel=1e-12)


def test_ticks_are_written_with_the_decimals_they_need():
    """2.5 has one decimal, 0.025 three; no tick is written as another value."""
    assert [format_tick(v, 2.5) for v in find_ticks(0, 14)] == [
        "0.0", "2.5", "5.0", "7.5", "10.0", "12.5",
    ]  # fmt: skip
    assert format_tick(0.025, 0.025) == "0.025"
    assert format_tick(-0.0, 1) == "0"
