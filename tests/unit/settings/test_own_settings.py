"""Settings of a design's own: laid over those of the study, for that design alone."""

from pathlib import Path

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.config_file import read_config
from foldshell.settings.load_study import load_study
from foldshell.settings.own import lay_over, settings_of
from foldshell.settings.stages import hash_decisions, stage_parameters

PROJECT = Path(__file__).parents[3]
TABLE = (
    "design\tsurface\tspan_m\theight_m\tzigzag\tstrip\tsupport\tsettings\ttags\n"
    "plain\tparaboloid\t8\t2\t9\t8\tall\t\tt\n"
    "own\tparaboloid\t8\t2\t9\t8\tall\t{file}\tt\n"
)


@pytest.fixture
def load(tmp_path):
    """Load a study of two designs that are the same but for the file of one."""

    def read(text, **config):
        file, table = tmp_path / "own.yaml", tmp_path / "designs.tsv"
        file.write_text(text, encoding="utf-8")
        table.write_text(TABLE.format(file=file), encoding="utf-8")
        settings, designs = load_study({"designs": str(table), **config})
        return settings, {design.name: design for design in designs}

    return read


def test_a_file_changes_its_own_design_alone(load):
    settings, designs = load("sizing:\n  measure: reinforced\nreinforcement:\n  kind: textile\n")
    own, plain = (stage_parameters(settings, "size", designs[n]) for n in ("own", "plain"))
    assert own["sizing"] == plain["sizing"] | {"measure": "reinforced"}
    assert own["reinforcement"]["kind"] == "textile" and plain["reinforcement"] == {}
    assert settings_of(settings, designs["plain"]) is settings
    assert stage_parameters(settings, "size")["sizing"] == plain["sizing"]


def test_what_the_file_leaves_out_is_that_of_the_study(load):
    config = {"sizing": {"step": 0.2, "start_thickness_mm": 120}}
    settings, designs = load("sizing:\n  step: 0.05\n", **config)
    own = settings_of(settings, designs["own"]).sizing
    assert (own.step, own.start_thickness) == (0.05, 0.12)


def test_groups_in_groups_are_laid_over_key_by_key(load):
    text = "reinforcement:\n  textile:\n    cover_mm: 12\n"
    config = {"reinforcement": {"textile": {"strength_mpa": 800}, "kind": "textile"}}
    settings, designs = load(text, **config)
    own = settings_of(settings, designs["own"]).reinforcement
    assert (own.textile.cover, own.textile.strength, own.kind) == (0.012, 8e5, "textile")
    assert lay_over({"a": {"b": 1}, "c": 2}, {"a": {"d": 3}}) == {"a": {"b": 1, "d": 3}, "c": 2}


def test_combinations_are_those_of_its_own_rule(load):
    settings, designs = load("combinations:\n  rule: en1990\n")
    own, plain = (stage_parameters(settings, "size", designs[n]) for n in ("own", "plain"))
    assert list(plain["combinations"]["strength"]) == ["S1", "S2", "S3", "S4", "S5"]
    factors = [one.get("WX", 0.0) for one in own["combinations"]["strength"].values()]
    assert min(factors) < 0 < max(factors)


def test_the_content_decides_and_not_the_name_of_the_file(load):
    settings, designs = load("co2:\n  crease_kg_m: 1\n")
    assert hash_decisions(settings, designs["own"]) == hash_decisions(settings, designs["plain"])
    settings, designs = load("sizing:\n  step: 0.05\n")
    assert hash_decisions(settings, designs["own"]) != hash_decisions(settings, designs["plain"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("analysis:\n  subdivisions: 2\n", r"own.yaml: analysis: it is the study's"),
        ("sizing:\n  mesure: strip\n", r"own.yaml: sizing.mesure: unknown key"),
        ("sizing:\n  least_thickness_mm: 400\n", r"own.yaml: sizing.start_thickness_mm"),
        ("study: t\n", r"own.yaml: study: it is the study's"),
        ("combinations:\n  strength:\n    S1:\n      QQ: 1\n", r"own.yaml: combinations.strength"),
    ],
)
def test_what_is_no_designs_own_is_refused_by_name(load, text, words):
    with pytest.raises(InputError, match=words):
        load(text)


def test_a_file_that_is_missing_is_named_with_its_design(tmp_path):
    table = tmp_path / "designs.tsv"
    table.write_text(TABLE.format(file="nowhere.yaml"), encoding="utf-8")
    with pytest.raises(InputError, match=r"design 'own': settings: 'nowhere.yaml': no such file"):
        load_study({"designs": str(table)})


def test_the_tag_reinforced_has_the_nine_designs_twice(monkeypatch):
    """With bars and with textile, the same but for name, tags and settings as the tag supports."""
    monkeypatch.chdir(PROJECT)
    settings, designs = load_study(read_config("config/config.yaml"))
    other = ("design", "tags", "settings")

    def shapes(tag, kind=None):
        chosen = [d for d in designs if tag in d.tags]
        if kind:
            chosen = [d for d in chosen if settings_of(settings, d).reinforcement.kind == kind]
        return [{k: v for k, v in d.to_row().items() if k not in other} for d in chosen]

    assert len(shapes("supports")) == 9 and len(shapes("reinforced")) == 18
    assert shapes("reinforced", "bars") == shapes("reinforced", "textile") == shapes("supports")
    sizings = [settings_of(settings, d).sizing for d in designs if "reinforced" in d.tags]
    assert {one.measure for one in sizings} == {"reinforced"}
    assert min(one.buckling_factor_min for one in sizings) >= 6
