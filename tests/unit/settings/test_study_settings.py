"""Settings: one schema for validation, defaults, documentation and types."""

import copy
import dataclasses
import math

import pytest
import yaml

from foldshell.files.errors import InputError
from foldshell.folding.settings import FoldSettings
from foldshell.folding.settings import read_settings as read_fold_settings
from foldshell.settings.documentation import generate_config, generate_readme
from foldshell.settings.load import load_study
from foldshell.settings.make import config_schema, make_settings, read_settings
from foldshell.settings.schema import CONFIG_FOLDER, iterate_leaves, validate
from foldshell.settings.stages import STAGES, settings_hash, stage_parameters
from foldshell.settings.units import convert_units
from foldshell.sizing.rounding import round_thickness


def test_config_file_holds_the_defaults_of_the_schema():
    text = (CONFIG_FOLDER / "config.yaml").read_text(encoding="utf-8")
    assert text == generate_config(), "run python -m foldshell.settings.documentation"
    assert read_settings(CONFIG_FOLDER / "config.yaml") == make_settings({})


def test_plain_yaml_reads_the_config_file_alike():
    """Snakemake reads it with an ordinary YAML 1.1 loader: both must see the same."""
    text = (CONFIG_FOLDER / "config.yaml").read_text(encoding="utf-8")
    assert make_settings(yaml.safe_load(text)) == make_settings({})


def test_readme_is_in_step_with_the_schemas():
    text = (CONFIG_FOLDER / "README.md").read_text(encoding="utf-8")
    assert text == generate_readme(), "run python -m foldshell.settings.documentation"
    for place, _ in iterate_leaves(config_schema()):
        assert place[-1] in text


def test_each_setting_has_a_description_and_an_allowed_default():
    for place, part in iterate_leaves(config_schema()):
        assert part["description"].endswith("."), place
        validate(part["default"], part, ".".join(place))


def test_classes_have_the_fields_of_the_schema():
    settings = make_settings({})
    for group, part in config_schema()["properties"].items():
        if part.get("type") != "object":
            continue
        fields = {field.name for field in dataclasses.fields(getattr(settings, group))}
        assert fields == set(convert_units(dict.fromkeys(part["properties"], 1.0))), group


def test_lengths_are_the_numbers_that_a_workbook_gives_back():
    """Bounds that a workbook rounds would refuse the least thickness that they allow."""
    for tenths in range(1, 2000):
        length = convert_units({"least_thickness_mm": tenths / 10})["least_thickness"]
        assert length == float(f"{tenths}e-4") == round_thickness(length)


def test_units_inside():
    """31 GPa = 31e6 kPa, 16.7 MPa = 16700 kPa, 150 mm = 0.15 m, 60 deg = pi / 3."""
    settings = make_settings({})
    assert settings.material.youngs_modulus == 31e6
    assert settings.material.strength == 16700.0
    assert settings.sizing.start_thickness == 0.15
    assert settings.sizing.least_thickness == 0.04
    assert settings.pattern.sector_angle == pytest.approx(math.pi / 3, rel=1e-15)
    assert settings.defaults.span == 28.0


def test_combinations_are_those_of_the_paper():
    """Table 2: five for strength, three for deflection; ASCE 7's uplift only when asked for."""
    combinations = make_settings({}).combinations
    assert list(combinations.strength) == ["S1", "S2", "S3", "S4", "S5"]
    assert combinations.strength["S3"] == {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WY": 0.5}
    assert list(combinations.deflection) == ["D1", "D2", "D3"]
    uplift = make_settings({"loads": {"uplift": True}}).combinations.strength
    assert uplift["S6"] == {"SW": 0.9, "SDL": 0.9, "WX": 1.0}
    assert uplift["S7"] == {"SW": 0.9, "SDL": 0.9, "WY": 1.0}
    assert list(uplift)[:5] == list(combinations.strength)


def test_folding_stage_has_the_same_defaults():
    """The folding library knows no config file; its own defaults must not drift from it."""
    assert read_fold_settings(stage_parameters(make_settings({}), "fold")["fold"]) == FoldSettings()


def changed(place: str, value):
    config: dict = {}
    node = config
    *groups, last = place.split(".")
    for group in groups:
        node = node.setdefault(group, {})
    node[last] = value
    return config


@pytest.mark.parametrize(
    ("place", "value", "named"),
    [
        ("materail", {}, "materail: unknown key, the nearest is material"),
        ("sizing.stpe", 0.1, "sizing.stpe: unknown key, the nearest is sizing.step"),
        ("step", 0.1, "the nearest is sizing.step"),
        ("loads.zzz", 1, "loads.zzz: unknown key, allowed are superimposed_dead_kn_m2"),
        ("material", None, "material: None: a group of keys"),
        ("material", [1], "a group of keys"),
        ("material.youngs_modulus_gpa", "27e9", "'27e9'.* in GPa .*write 2.7e[+]10"),
        ("material.strength_mpa", "16,7", "write 16.7 with a decimal point"),
        ("material.strength_mpa", "strong", "the value is text"),
        ("material.youngs_modulus_gpa", 0, "above 0"),
        ("material.youngs_modulus_gpa", -31, "above 0"),
        ("material.youngs_modulus_gpa", True, "True: a number"),
        ("material.youngs_modulus_gpa", 31e6, "of at most 1000"),
        ("material.youngs_modulus_gpa", math.nan, "finite"),
        ("loads.live_kn_m2", math.inf, "finite"),
        ("material.poissons_ratio", 0.5, "below 0.5"),
        ("material.poissons_ratio", -1, "above -1"),
        ("material.criterion", "von_mieses", "the nearest is von_mises"),
        ("material.criterion", False, "one of von_mises, rankine"),
        ("pattern.sector_angle_deg", 0, "above 0"),
        ("pattern.sector_angle_deg", 90, "below 90"),
        ("defaults.span_m", -28, "above 0"),
        ("defaults.zigzag", 2, "at least 3"),
        ("defaults.zigzag", 15.5, "whole number"),
        ("defaults.support", "al", "the nearest is all"),
        ("analysis.subdivisions", 0, "at least 1"),
        ("analysis.second_order", "yes", "true or false"),
        ("analysis.solver", "mumps", "cholmod, superlu"),
        ("sizing.start_thickness_mm", 0.15, "least_thickness_mm.*looks like m"),
        ("sizing.start_thickness_mm", 1001, "1000"),
        ("sizing.least_thickness_mm", 2000, "largest_thickness_mm"),
        ("sizing.least_thickness_mm", 0, "above 0"),
        ("sizing.utilization_min", 1.0, "less than utilization_max"),
        ("sizing.iterations_max", 100, "at most 99"),
        ("combinations.strength", {}, "at least 1"),
        ("combinations.strength", {"S1": {"DL": 1.4}}, "S1.DL: unknown key.*(SDL|SW)"),
        ("combinations.strength", {"S1": {"SW": math.nan}}, "finite"),
        ("combinations.strength", {"S1": {"SW": "1,4"}}, "write 1.4"),
        ("combinations.strength", {"S 1": {"SW": 1.4}}, "'S 1': a name"),
        ("combinations.strength", {"D1": {"SW": 1.4}}, "D1: names a strength combination too"),
        ("combinations.strength", {"S1": {"SW": 1.4}}, "crosscheck.strength: 'S2'"),
        ("crosscheck.strength", "D2", "under combinations.strength is allowed"),
        ("crosscheck.deflection", "D4", "D1, D2, D3"),
        ("crosscheck.subdivisions", [2], "exactly 2"),
        ("crosscheck.subdivisions", [4, 4], "two rising numbers"),
        ("crosscheck.subdivisions", [2, "4"], r"crosscheck.subdivisions\[1\]: '4'"),
        ("crosscheck.tolerance.work", 5, "at most 1"),
        ("designs", 3, "designs: 3: text"),
        ("limits.panels_max", 10**6, "at most 9000"),
    ],
)
def test_bad_setting_is_named_with_what_is_allowed(place, value, named):
    with pytest.raises(InputError, match=named) as caught:
        make_settings(changed(place, value), "config.yaml")
    message = str(caught.value)
    assert message.startswith("config.yaml: ") and "\n" not in message


def test_uplift_refuses_a_name_that_is_taken():
    config = changed("combinations.strength", {"S2": {"SW": 1.0}, "S6": {"SW": 1.0}})
    config["loads"] = {"uplift": True}
    with pytest.raises(InputError, match="S6"):
        make_settings(config)


def test_config_is_not_changed_in_place():
    config = {"sizing": {"step": 0.2}}
    before = copy.deepcopy(config)
    make_settings(config)
    assert config == before


def test_hash_follows_values_that_matter_and_no_others():
    plain = settings_hash(make_settings({}))
    assert plain == settings_hash(make_settings({"loads": {"live_kn_m2": 1}}))  # 1 and 1.0
    assert plain == settings_hash(make_settings({"designs": "other.tsv"}))
    assert plain == settings_hash(make_settings({"figures": {"width_px": 800}}))
    assert plain != settings_hash(make_settings({"loads": {"live_kn_m2": 1.1}}))
    assert plain != settings_hash(make_settings({"sizing": {"step": 0.05}}))


@pytest.mark.parametrize(
    ("place", "value", "stages"),
    [
        ("pattern.sector_angle_deg", 55, {"pattern", "fold", "study"}),
        ("fold.weights.hinge", 0.02, {"fold", "study"}),
        ("analysis.subdivisions", 2, {"mesh", "study"}),
        ("sizing.step", 0.05, {"resize", "size", "study"}),
        ("sizing.start_thickness_mm", 100, {"start", "resize", "size", "study"}),
        ("loads.live_kn_m2", 2, {"analyse", "size", "crosscheck", "study"}),
        ("crosscheck.tolerance.work", 0.1, {"crosscheck", "study"}),
        ("figures.width_px", 800, {"figures"}),
        ("designs", "other.tsv", set()),
    ],
)
def test_a_setting_changes_the_parameters_of_its_stages_only(place, value, stages):
    before, after = make_settings({}), make_settings(changed(place, value))
    differing = {
        stage
        for stage in STAGES
        if stage_parameters(before, stage) != stage_parameters(after, stage)
    }
    assert differing == stages


def test_each_setting_reaches_a_stage():
    """A setting that no stage gets would have no effect, silently."""
    reached = {name.partition(".")[0] for names in STAGES.values() for name in names}
    groups = {name for name, part in config_schema()["properties"].items() if "properties" in part}
    # The first two go into the table of designs, `jobs` changes no result.
    assert groups - reached == {"defaults", "limits", "jobs"}


def test_load_study_reads_files_strictly_and_takes_overrides(tmp_path):
    table = tmp_path / "designs.tsv"
    table.write_text("design\na\n", encoding="utf-8")
    config = tmp_path / "config.yaml"
    config.write_text("sizing: {step: 0.2}\n", encoding="utf-8")
    merged = {"sizing": {"step": 0.2}, "designs": str(table)}
    settings, designs = load_study(merged, [config])
    assert settings.sizing.step == 0.2 and [design.name for design in designs] == ["a"]
    config.write_text("sizing: {step: 0.2, step: 0.3}\n", encoding="utf-8")
    with pytest.raises(InputError, match="stands twice"):
        load_study(merged, [config])
    config.write_text("sizing: {stpe: 0.2}\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"config\.yaml: sizing\.stpe"):
        load_study(merged, [config])
