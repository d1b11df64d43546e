"""Entry script of rule pattern."""

import pytest

import pattern
from entry_defaults import pattern_parameters
from foldshell.files.errors import InputError
from foldshell.pattern.fold_format import read_fold


def test_writes_a_sheet_sized_for_its_target(tmp_path):
    """Rest state spans the arch's arc length 35.727 m across and the plan 28 m along."""
    pattern.main(
        tmp_path / "a.fold", design="arch", **pattern_parameters(surface="arch", zigzag=7, strip=8)
    )
    sheet = read_fold(tmp_path / "a.fold")
    size = sheet.rest.max(axis=0) - sheet.rest.min(axis=0)
    assert size[:2] == pytest.approx([35.72698969499068, 28.0], rel=1e-12)
    assert len(sheet.path) == 9


def test_same_input_gives_the_same_bytes(tmp_path):
    for name in "ab":
        pattern.main(tmp_path / f"{name}.fold", design="x", **pattern_parameters(zigzag=5, strip=6))
    assert (tmp_path / "a.fold").read_bytes() == (tmp_path / "b.fold").read_bytes()


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ({"zigzag": 2}, "zigzag 2"),
        ({"strip": 1}, "strip 1"),
        ({"sector_angle_deg": 90.0}, "sector_angle_deg"),
        ({"sector_angle_deg": 0.0}, "sector_angle_deg"),
        ({"surface": "dome"}, "dome"),
        ({"pattern": "kirigami"}, "kirigami"),
        ({"span_m": -1.0}, "span"),
        ({"height_m": 0.0}, "height"),
    ],
)
def test_bad_designs_are_refused_and_nothing_is_written(tmp_path, values, named):
    with pytest.raises(InputError, match=named):
        pattern.main(tmp_path / "a.fold", design="bad", **pattern_parameters(**values))
    assert not list(tmp_path.iterdir())


def test_drawings_on_request(tmp_path):
    paths = {"dxf_path": tmp_path / "a.dxf", "svg_path": tmp_path / "a.svg"}
    pattern.main(tmp_path / "a.fold", design="x", **pattern_parameters(zigzag=5, strip=6, **paths))
    assert all(path.stat().st_size > 1000 for path in paths.values())
