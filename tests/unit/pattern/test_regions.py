"""Points in boxes and polygons of the plan, turned, skewed and not convex."""

import numpy as np
import pytest
from shapely import Point, Polygon

from foldshell.pattern.regions import mask_box, mask_polygon, mask_region
from foldshell.settings.regions import read_region

STAR = np.array([[0, 0], [4, 1], [8, 0], [7, 4], [8, 8], [4, 7], [0, 8], [3, 4.5]], dtype=float)
"""Not convex, with two horizontal levels shared by corners."""


def turned(points, angle, shift=(0.0, 0.0)):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]]) + shift


@pytest.mark.parametrize("angle", [0, 0.3, np.pi / 2, 2.0])
@pytest.mark.parametrize("sense", [1, -1])
def test_polygon_agrees_with_shapely(angle, sense):
    corners = turned(STAR, angle, (1e3, -2e3))[::sense]
    points = turned(np.random.default_rng(1).uniform(-1, 9, (2000, 2)), angle, (1e3, -2e3))
    known = Polygon(corners)
    assert list(mask_polygon(points, corners)) == [known.covers(Point(p)) for p in points]


@pytest.mark.parametrize("angle", np.linspace(0, 3, 13))
def test_border_counts_as_inside_however_it_is_turned(angle):
    corners = turned(STAR, angle)
    second = np.roll(corners, -1, axis=0)
    share = np.linspace(0, 1, 11)[:, None, None]
    assert mask_polygon((1 - share) * corners + share * second, corners).all()


def test_levels_of_corners_are_crossed_once():
    # points on the height of corners, left and right of them: a ray meets two sides there
    points = np.array([[-1, 0], [-1, 8], [9, 4], [4, 0.5], [5, 4.5], [1, 4.5], [2.9, 4.5]])
    assert list(mask_polygon(points, STAR)) == [False, False, False, False, True, False, False]


def test_box_is_the_polygon_of_its_corners_and_height_does_not_count():
    region = read_region("box -1 2 3.5 4")
    points = np.random.default_rng(2).uniform(-5, 5, (500, 3))
    inside = (np.abs(points[:, 0] - 1.25) <= 2.25) & (np.abs(points[:, 1] - 3) <= 1)
    assert list(mask_region(points, region)) == list(inside)
    assert list(mask_box(points, [-1, 2], [3.5, 4])) == list(inside)
    assert mask_box(points.reshape(5, 100, 3), [-1, 2], [3.5, 4]).shape == (5, 100)


def test_texts():
    assert read_region("polygon 0 0, 2.5 0,1e0 1").corners == ((0, 0), (2.5, 0), (1, 1))
    assert read_region("box 0, 0, 1, 2").corners[2] == (1, 2)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "neither"),
        ("circle 0 0 1", "'circle' is neither"),
        ("box 0 0 1", "3 numbers"),
        ("box 1 0 0 1", "empty"),
        ("box 0 0 nan 1", "'nan' is no plain number"),
        ("box 0 0 1e999 1", "not finite"),
        ("box 0 0 1m 1", "'1m'"),
        ("polygon 0 0, 1 1", "2 corners"),
        ("polygon 0 0, 1 1, 2 2", "no area"),
        ("polygon 0 0, 2 2, 2 0, 0 1", "meet"),
        ("polygon 0 0, 4 0, 4 4, 2 0, 0 4", "meet"),
        ("polygon 0 0, 1 0, 1", "1 numbers"),
        ("polygon 0 0, 1 0, 1 1, 0 0", "twice"),
    ],
)
def test_texts_that_are_no_region(text, words):
    with pytest.raises(ValueError, match=words):
        read_region(text)
