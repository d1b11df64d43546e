"""The file of an exploration: what is read, and a sentence for what is not allowed."""

import pytest

from foldshell.explore.names import list_references
from foldshell.files.errors import InputError
from foldshell.settings.design import Design
from foldshell.settings.exploration import Variable, restore_exploration
from foldshell.settings.exploration_file import read_exploration
from foldshell.settings.make import make_settings

GOOD = """\
base: {surface: hypar, span_m: 5, height_m: 2, zigzag: 9, strip: 8, support: strip}
variables:
  sector_angle_deg: [50, 70]
  zigzag: [5, 9]
  support: [strip, zigzag]
aims: [volume_m3, panels]
limits: {plan_coverage_min: 0.9}
search: {first: 4, rounds: 2, batch: 3, seed: 7}
"""
DEFAULTS = make_settings({}).defaults


def read(tmp_path, text, name="mine.yaml"):
    path = tmp_path / name
    path.write_text(text)
    return read_exploration(path, DEFAULTS)


def test_a_file_is_read_and_goes_through_plain_data(tmp_path):
    found = read(tmp_path, GOOD)
    assert found.name == "mine" and found.evaluations == 10 and found.count_batch(1) == 4
    assert found.base["surface"] == "hypar" and found.base["fold_mode"] == "elastic"
    assert [v.name for v in found.variables] == ["sector_angle_deg", "zigzag", "support"]
    assert restore_exploration(found.to_plain()) == found


@pytest.mark.parametrize("share", [0.0, 0.19, 0.21, 0.5, 0.999, 1.0])
def test_values_and_shares_go_both_ways(share):
    wide, whole = Variable("a", 30.0, 62.0), Variable("b", 5.0, 9.0, whole=True)
    choice = Variable("c", choices=("x", "y"))
    assert wide.to_share(wide.to_value(share)) == pytest.approx(share, abs=1e-5)
    for one in (whole, choice):
        value = one.to_value(share)
        assert one.to_value(one.to_share(value)) == value
    assert whole.to_value(share) in range(5, 10)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("variables:", "variabels:", "variabels: unknown key"),
        ("sector_angle_deg: [50, 70]", "sector_angel_deg: [50, 70]", "unknown column of designs"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: [70, 50]", "the least first"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: [50, 170]", "170"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: 60", r"a list of \[least, most\]"),
        ("sector_angle_deg: [50, 70]", "sector_angle_deg: [50, 60, 70]", "the least first"),
        ("zigzag: [5, 9]", "zigzag: [5.5, 9]", "5.5"),
        ("support: [strip, zigzag]", "support: [strip, strip]", "each once"),
        ("aims: [volume_m3, panels]", "aims: [weight]", "no design has this value"),
        ("aims: [volume_m3, panels]", "aims: [panels, panels]", "one or two of"),
        ("plan_coverage_min: 0.9", "plan_coverage_min: 9", "9"),
        ("plan_coverage_min: 0.9", "coverage: 0.9", "unknown key"),
        ("seed: 7", "seed: 0", "search.seed: 0"),
        ("span_m: 5", "span: 5", "base.span: unknown column"),
    ],
)
def test_what_is_not_allowed_is_said_in_a_sentence(tmp_path, old, new, said):
    assert old in GOOD
    with pytest.raises(InputError, match=said) as caught:
        read(tmp_path, GOOD.replace(old, new))
    assert str(caught.value).startswith(f"{tmp_path}/mine.yaml: ")


def test_without_variables_there_is_nothing_to_search(tmp_path):
    with pytest.raises(InputError, match="variables: None: 1 to 12 columns"):
        read(tmp_path, "base: {span_m: 5}\n")
    with pytest.raises(InputError, match="a name of lower-case letters"):
        read(tmp_path, GOOD, "My search.yaml")


def test_round_0_has_designs_like_the_base_and_the_smooth_shell(tmp_path):
    """Alike but in what varies: here counts, angle and support."""
    found = read(tmp_path, GOOD)
    row = {"design": "a", "tags": "x", **found.base}
    designs = [
        Design.from_row({**row, "zigzag": 15}),
        Design.from_row({**row, "design": "b", "support": "zigzag"}),
        Design.from_row({**row, "design": "same", "zigzag": 15}),
        Design.from_row({**row, "design": "c", "surface": "arch"}),
        Design.from_row({**row, "design": "d", "span_m": 6.0}),
        Design.from_row({**row, "design": "e", "settings": "config/reinforced.yaml"}),
    ]
    rows = list_references(found, designs)
    assert [one["design"] for one in rows] == ["00-00", "00-01", "00-02"]
    assert [one["pattern"] for one in rows] == ["miura", "miura", "smooth"]
    assert rows[0]["zigzag"] == 15 and rows[1]["support"] == "zigzag"
