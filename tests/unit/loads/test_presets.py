"""Presets of wind, snow and live load: the values to hold, and sums over their zones."""

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.loads import presets
from foldshell.loads.__main__ import main
from foldshell.settings.load_rows import LoadRow
from foldshell.settings.load_table import read_load_sets
from foldshell.settings.zones import read_variation, read_zone


def test_coefficients_of_the_published_vault():
    """f 2.51, h 3.20, d 9.60 m: +0.25, -0.96, -0.40 (civil-engineering-design.com, 2 Feb 2021, read
    off Figure 7.11; +0.42 at h/d = 0 and +0.16 from h/d = 0.5)."""
    found = presets.vault_pressure_coefficients(2.51, 9.60, 3.20)
    assert np.round(found, 2).tolist() == [0.25, -0.96, -0.40]
    assert round(presets.vault_pressure_coefficients(2.51, 9.60, 0.0)[0], 2) == 0.42
    for wall in (4.8, 9.0):
        assert round(presets.vault_pressure_coefficients(2.51, 9.60, wall)[0], 2) == 0.16


@pytest.mark.parametrize("rise", [1.0, 6.0])
def test_a_vault_outside_of_the_fit_is_refused(rise):
    with pytest.raises(ValueError, match=r"0\.2 to 0\.5 is allowed"):
        presets.vault_pressure_coefficients(rise, 10.0, 0.0)


def test_quarters_of_the_developed_length():
    """Equal lengths of parabola between them, by its closed form; a flat one is cut in quarters."""
    rise, span = 10.0, 28.0
    cuts = presets.quarter_points(rise, span)
    a = 8 * rise / span**2

    def length(x):
        return (x * np.hypot(1, a * x) + np.arcsinh(a * x) / a) / 2

    assert np.diff(length(cuts)) == pytest.approx(np.full(4, length(14.0) / 2), rel=1e-6)
    assert presets.quarter_points(1e-9, 8.0) == pytest.approx([-4, -2, 0, 2, 4])


def test_wind_on_a_vault_turns_round():
    rows = presets.make_vault_wind("W", 2.51, 9.60, 3.20, 0.8)
    assert [row.case for row in rows] == ["WP"] * 3 + ["WM"] * 3
    values = [row.value for row in rows]
    assert values[:3] == pytest.approx([0.8 * 0.2487, 0.8 * -0.9615, -0.32], abs=1e-4)
    assert values[3:] == values[2::-1]
    corners = [read_zone(row.zone).region.corners for row in rows[:3]]
    assert corners[0][1][0] == corners[1][0][0] and corners[1][1][0] == corners[2][0][0]
    across = presets.make_vault_wind("W", 2.51, 9.60, 3.20, 0.8, axis="y")
    assert read_zone(across[0].zone).region.corners[2][1] == corners[0][2][0]


def test_snow_on_a_vault():
    """mu_3 = 0.2 + 10 h/b, 2 at most; triangles with their peaks at the quarters of what is not
    steeper than 60 degrees."""
    even, right, left = presets.make_vault_snow("S", 1.0, 10.0, 0.5)
    assert (even.value, even.zone, even.area) == (0.4, "all", "plan_up")
    assert read_variation(right.variation).factors == pytest.approx((0, 0.6, 0, 1.2, 0))
    assert read_variation(left.variation).factors == pytest.approx((0, 1.2, 0, 0.6, 0))
    steep = presets.make_vault_snow("S", 10.0, 10.0, 0.5)
    places = read_variation(steep[1].variation).places
    # slope of the parabola there: 8 f x / d^2 = tan 60
    assert 8 * 10.0 * places[-1] / 100 == pytest.approx(np.tan(np.pi / 3))
    assert read_variation(steep[1].variation).factors == pytest.approx((0, 1.0, 0, 2.0, 0))
    assert steep[0].zone.startswith("box")


def test_wind_on_a_dome_is_linear_along_the_arc():
    rows = presets.make_dome_wind("W", 5.0, 10.0, 0.5, (0.8, -1.2, 0.0))
    found = read_variation(rows[0].variation)
    middle = len(found.places) // 2
    assert found.factors[0] == 0.8 and found.factors[-1] == 0.0
    assert (found.places[middle], found.factors[middle]) == (0, -1.2)
    # half a quarter circle up, at 45 degrees of a hemisphere: half way between A and B
    assert np.interp(-5 * np.sin(np.pi / 4), found.places, found.factors) == pytest.approx(-0.2)
    assert read_variation(rows[1].variation).factors == tuple(reversed(found.factors))


def test_half_span():
    rows = presets.make_half_span("LL", 0.75)
    assert [(row.case, row.zone) for row in rows] == [
        ("LL", "all"), ("LL_M", "side x-"), ("LL_P", "side x+"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    "words",
    [
        "vault_wind --rise 10 --span 28 --wall 3 --pressure 0.8",
        "vault_snow --rise 10 --span 28 --snow 0.8 --axis y",
        "half_span --live 0.75 --set other",
        "dome_wind --rise 5 --span 10 --pressure 0.5 --cpe 0.8 -1.2 0",
    ],
)
def test_printed_rows_are_a_table(tmp_path, capsys, words):
    main(words.split())
    (tmp_path / "loads.tsv").write_text(capsys.readouterr().out, encoding="utf-8")
    sets = read_load_sets(tmp_path / "loads.tsv")
    rows = next(iter(sets.values()))
    assert len(sets) == 1 and all(isinstance(row, LoadRow) for row in rows)


def test_a_vault_that_is_too_flat_is_refused_in_a_sentence():
    with pytest.raises(InputError, match=r"vault_wind: rise over span 0\.1"):
        main(["vault_wind", "--rise", "1", "--span", "10", "--wall", "0", "--pressure", "1"])
