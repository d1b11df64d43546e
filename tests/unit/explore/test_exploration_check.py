"""An exploration against its study: what makes no design is one sentence before any job starts."""

import numpy as np
import pytest
from test_proposals import candidate

from foldshell.explore.found import gather, to_point
from foldshell.explore.propose import snap
from foldshell.files.errors import InputError
from foldshell.settings.exploration_check import settle_exploration
from foldshell.settings.exploration_file import read_exploration
from foldshell.settings.make import make_settings

TEXT = """\
base: {surface: paraboloid, span_m: 12, height_m: 4, zigzag: 7, strip: 8, support: all}
variables:
  pattern: [miura, waterbomb, smooth]
  sector_angle_deg: [50, 70]
  take_up: [0.7, 0.95]
  span_ratio: [0.7, 1.4]
  height_m: [2, 4]
aims: [volume_m3]
search: {first: 4, rounds: 1, batch: 2}
"""


def settle(tmp_path, text=TEXT, **settings):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    given = make_settings(settings)
    return settle_exploration(read_exploration(path, given.defaults), given, str(path))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("height_m: [2, 4]", "heigth_m: [2, 4]", "variables.heigth_m: unknown column.*height_m"),
        ("span_ratio: [0.7, 1.4]", "span_ratio: [0.7, 9]", "span_ratio: 9: .*5"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: [0, 70]",
         r"\[0, 70\]: a range within 5 to 88 \(0 stands for none\)"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: [40, 70]", "above 45 is allowed"),
        ("height_m: [2, 4]", "height_m: [2, 900]", "height_m: 900"),
        ("height_m: [2, 4]", "loads: [paper, other]", "variables.loads: does not vary"),
        ("height_m: [2, 4]", "support: [all, no_set]", "variables.support: 'no_set'"),
        ("[miura, waterbomb, smooth]", "[miura, watterbomb]", "watterbomb"),
        ("height_m: [2, 4]", "zigzag: [5, 900]", "panels_max|panels of"),
        ("[volume_m3]", "[weight]", "aims: 'weight': no design has this value"),
        ("[volume_m3]", "[cost]", "aims: 'cost': no design has this value: no price is given"),
        ("[volume_m3]", "[engineering_volume_m3]", "search.measure: reinforced is due"),
        ("batch: 2", "batch: 2, measure: reinforced, rule: optimality", "has no gradients"),
        ("batch: 2", "batch: 2, measure: reinforced, gradient_step: true", "has no gradients"),
    ],
)  # fmt: skip
def test_what_makes_no_design_is_a_sentence(tmp_path, old, new, said):
    assert old in TEXT
    with pytest.raises(InputError, match=said) as caught:
        settle(tmp_path, TEXT.replace(old, new))
    assert str(caught.value).startswith(f"{tmp_path}/mine.yaml: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"reinforcement": {"kind": "none"}}, "reinforcement.kind is none"),
        ({"material": {"kind": "steel"}}, "material.kind is steel: concrete is due"),
    ],
)
def test_aims_of_steel_need_reinforced_concrete(tmp_path, settings, said):
    text = TEXT.replace("[volume_m3]", "[steel_kg, volume_m3]")
    assert settle(tmp_path, text).needs_engineering
    with pytest.raises(InputError, match=said):
        settle(tmp_path, text, **settings)


def test_sets_of_supports_come_along(tmp_path):
    table = tmp_path / "supports.tsv"
    table.write_text("set\tname\twhere\tfix\nlow\tedge\tborder\txyz\n")
    text = TEXT.replace("height_m: [2, 4]", "support: [all, low]")
    found = settle(tmp_path, text, supports=str(table))
    assert [row["name"] for row in found.supports["low"]] == ["edge"]
    assert "all" not in found.supports


def test_what_a_pattern_does_not_have_stands_in_the_middle(tmp_path):
    """A smooth shell has no sector angle and no take-up: all its points are one in both."""
    found = settle(tmp_path)
    row = found.make_row("01-00", {"pattern": "smooth", "sector_angle_deg": 55.0, "take_up": 0.8,
                                   "span_ratio": 1.2, "height_m": 3.0})  # fmt: skip
    assert row["sector_angle_deg"] == 0 and row["take_up"] == 0
    assert row["span_x_m"] / row["span_y_m"] == pytest.approx(1.2, rel=1e-5)
    assert row["span_x_m"] * row["span_y_m"] == pytest.approx(144, rel=1e-5)
    record = candidate("01-00", (0, 0))
    record.columns.clear()
    record.columns.update({key: value for key, value in row.items() if key != "design"})
    place = to_point(found, record)
    np.testing.assert_allclose(place, [5 / 6, 0.5, 0.5, 0.5 / 0.7, 0.5], atol=1e-4)
    assert len(gather(found, [record]).points) == 1
    snapped = snap(found, np.array([[0.9, 0.1, 0.2, 0.3, 0.4], [0.1, 0.1, 0.2, 0.3, 0.4]]))
    np.testing.assert_allclose(snapped[0], [5 / 6, 0.5, 0.5, 0.3, 0.4])
    np.testing.assert_allclose(snapped[1], [1 / 6, 0.1, 0.5, 0.3, 0.4])
