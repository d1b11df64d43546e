"""Settings: one class a group for checks, defaults, documentation and what the library takes."""

import copy
import json
import math
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml

from foldshell.files.errors import InputError
from foldshell.folding.fold import SOLVERS
from foldshell.folding.quadric import make_quadric
from foldshell.pattern.design import design_sheet
from foldshell.settings.check import Reader, iterate_settings
from foldshell.settings.design import FOLD_MODES, GRID_PATTERNS, SUPPORTS, SURFACES, Design
from foldshell.settings.documentation import (
    SCHEMAS,
    generate_config,
    generate_readme,
    generate_schemas,
)
from foldshell.settings.field import list_groups, list_settings
from foldshell.settings.load_study import load_study
from foldshell.settings.make import make_settings, read_settings
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import flatten, read_stage, to_plain
from foldshell.settings.stages import STAGES, hash_decisions, stage_parameters
from foldshell.settings.study import Settings
from foldshell.shell.supports import SUPPORT_SETS
from foldshell.sizing.rounding import round_thickness
from foldshell.sizing.step import RULES

CONFIG_FOLDER = Path(__file__).parents[3] / "config"
RENEW = "run python -m foldshell.settings.documentation config"


def changed(place: str, value):
    config: dict = {}
    node = config
    *groups, last = place.split(".")
    for group in groups:
        node = node.setdefault(group, {})
    node[last] = value
    return config


def test_config_file_holds_the_defaults_of_the_classes():
    text = (CONFIG_FOLDER / "config.yaml").read_text(encoding="utf-8")
    assert text == generate_config(), RENEW
    assert read_settings(CONFIG_FOLDER / "config.yaml") == make_settings({}) == Settings()


def test_plain_yaml_reads_the_config_file_alike():
    """Snakemake reads it with an ordinary YAML 1.1 loader: both must see the same."""
    text = (CONFIG_FOLDER / "config.yaml").read_text(encoding="utf-8")
    assert make_settings(yaml.safe_load(text)) == make_settings({})


def test_readme_and_schemas_are_in_step_with_the_classes():
    text = (CONFIG_FOLDER / "README.md").read_text(encoding="utf-8")
    assert text == generate_readme(), RENEW
    for place, _ in iterate_settings(Settings):
        assert place.rpartition(".")[2] in text
    for name, schema in generate_schemas().items():
        assert (SCHEMAS / name).read_text(encoding="utf-8") == schema, RENEW


def test_each_setting_has_a_meaning_and_an_allowed_default():
    for place, known in iterate_settings(Settings):
        assert known.meaning.endswith("."), place
        assert Reader("").read_value(known, known.default, place) is not None


@pytest.mark.parametrize("place", [place for place, _ in iterate_settings(Settings)])
def test_json_schema_allows_what_the_check_allows(place):
    """Both are made from the same class, in two ways: they must agree on every setting."""
    schema = json.loads(generate_schemas()["config.schema.json"])
    tried = [None, True, "", "x", "strip", "S2", -1, 0, 0.03, 0.5, 1, 1.5, 2.0, 3, 90, 1e3, 1e9]
    tried += [[1, 2], [1], [1, 2.5], {}, {"S2": {"SW": 1}}, {"S2": {"SW": 101}}, {"S2": {}}]
    known = dict(iterate_settings(Settings))[place]
    tried += [*known.choices, *known.former, known.default, "a" * 61]
    for value in tried:
        given = list(value) if isinstance(value, tuple) else value
        try:
            Reader("").read_group(Settings, changed(place, given))
            allowed = True
        except InputError:
            allowed = False
        assert allowed == jsonschema.Draft202012Validator(schema).is_valid(changed(place, given))


def test_what_settings_name_is_what_the_library_knows():
    """Words stand in the settings once, and what they mean in the room that does it."""
    assert tuple(SOLVERS) == FOLD_MODES
    assert tuple(SUPPORT_SETS) == SUPPORTS
    assert tuple(RULES) == list_settings(Sizing)["rule"].choices
    for pattern in GRID_PATTERNS:
        assert len(design_sheet(pattern, (5.0, 5.0), 3, 4, 60.0, 2, 0.3).flat) == 12
    for surface in SURFACES:
        assert make_quadric(surface, 5.0, 2.0).name == surface


def test_lengths_are_the_numbers_that_a_workbook_gives_back():
    """Bounds that a workbook rounds would refuse the least thickness that they allow."""
    for tenths in range(1, 2000):
        length = list_settings(Sizing)["least_thickness"].convert(tenths / 10)
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
        ("defaults.span_m", -28, "at least 0.1"),
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
        (
            "crosscheck.strength",
            "D2",
            "governing alone or combinations under",
        ),
        ("crosscheck.strength", ["S1", "S9"], "crosscheck.strength: 'S9'"),
        ("crosscheck.strength", ["S1", "governing"], "'governing': governing alone"),
        ("crosscheck.strength", [], "a name or a list of names"),
        ("crosscheck.deflection", "D4", "D1, D2, D3"),
        ("crosscheck.subdivisions", [2], "exactly 2"),
        ("crosscheck.subdivisions", [4, 4], "two rising numbers"),
        ("crosscheck.subdivisions", [2, "4"], r"crosscheck.subdivisions\[1\]: '4'"),
        ("crosscheck.tolerance.work", 5, "at most 1"),
        ("fold.wieghts", {}, "fold.wieghts: unknown key, the nearest is fold.weights"),
        ("fold.weights.stretsh", 1, "the nearest is fold.weights.stretch"),
        ("fold.weights.stretch", "10", r"fold.weights.stretch: '10': .*write 1.0e\+01"),
        ("fold.weights.stretch", -1, "at least 0"),
        ("fold.weights", 3, "fold.weights: 3: a group"),
        ("fold.attract", "middle", "one of lowest, highest"),
        ("fold.max_iterations", True, "a whole number in iterations"),
        ("combinations.strength", {"s2": {"SW": 1}, "S2": {"SW": 1}}, "S2: differs from .*s2 in"),
        ("combinations.strength", {"S2": {"SW": 1}, "d2": {"SW": 1}}, "D2: differs from .*d2 in"),
        ("combinations.strength", {"S2": {"SW": 0.0}}, "combination S2 loads nothing"),
        ("combinations.strength", {"S2": {"sw": 1.0}}, "nearest is combinations.strength.S2.SW"),
        ("combinations.strength", {"S2": 3}, "S2: 3: a group of keys"),
        ("designs", 3, "designs: 3: text"),
        ("limits.panels_max", 10**7, r"of 4 to 1e\+06"),
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


@pytest.mark.parametrize(
    ("loads", "factors", "why"),
    [
        ({"live_kn_m2": 0}, {"LL": 1.6}, "loads.live_kn_m2 is 0"),
        ({"superimposed_dead_kn_m2": 0}, {"SDL": 1}, "loads.superimposed_dead_kn_m2 is 0"),
        ({"wind_kn_m2": 0}, {"WX": 1, "WY": 1}, "loads.wind_kn_m2 x wind_fraction is 0"),
        ({"wind_fraction": 0}, {"WX": 1}, "loads.wind_kn_m2 x wind_fraction is 0"),
        ({"live_kn_m2": 0}, {"LL": 1, "SW": 0}, "loads.live_kn_m2 is 0"),
    ],
)
def test_a_combination_that_loads_nothing_is_refused(loads, factors, why):
    config = {"loads": loads, "combinations": {"strength": {"S2": factors}}}
    with pytest.raises(InputError, match=f"strength.S2: combination S2 loads nothing, {why}"):
        make_settings(config)
    make_settings(config | {"loads": {}, "combinations": {"strength": {"S2": {"SW": -1}}}})


@pytest.mark.parametrize("name", ["S6", "s7"])
def test_uplift_refuses_a_name_in_any_case(name):
    given = {"S2": {"SW": 1.0}, name: {"SW": 1.0}}
    with pytest.raises(InputError, match=f"but {name} stands"):
        make_settings({"loads": {"uplift": True}, "combinations": {"strength": given}})


def test_old_words_are_read_as_the_new_ones_and_said_once(tmp_path):
    table = tmp_path / "designs.tsv"
    table.write_text("design\tfold_mode\na\tpaper\nb\tpaper\nc\texact\n", encoding="utf-8")
    config = tmp_path / "config.yaml"
    text = "sizing: {rule: literal}\nloads: {area_basis: plan}\ndefaults: {fold_mode: paper}\n"
    config.write_text(text, encoding="utf-8")
    merged = yaml.safe_load(text) | {"designs": str(table)}
    said = []
    settings, designs = load_study(merged, [config], said.append)
    assert settings.sizing.rule == "fully_stressed" and settings.loads.area_basis == "plan_abs"
    assert settings.defaults.fold_mode == "elastic"
    assert [design.fold_mode for design in designs] == ["elastic", "elastic", "exact"]
    assert said == [
        f"{config}: defaults.fold_mode: 'paper' is now called 'elastic'",
        f"{config}: loads.area_basis: 'plan' is now called 'plan_abs'",
        f"{config}: sizing.rule: 'literal' is now called 'fully_stressed'",
        f"{table}: fold_mode: 'paper' is now called 'elastic'",
    ]
    assert make_settings({"loads": {"area_basis": "mesh"}}) == make_settings({})


def test_text_of_the_command_line_is_read_by_the_setting_it_belongs_to(tmp_path):
    """`--config` knows text alone below the first level, and a number for a name."""
    table = tmp_path / "designs.tsv"
    table.write_text("design\na\n", encoding="utf-8")
    merged = {
        "designs": str(table),
        "study": 7,
        "sizing": {"step": "0.2", "iterations_max": "12", "volume_change_max_m3": "1e-3"},
        "analysis": {"second_order": "false", "solver": "superlu"},
        "crosscheck": {"subdivisions": ["2", "3"]},
        "combinations": {"strength": {"S2": {"SW": "1.35"}}},
    }
    settings, _ = load_study(merged)
    assert settings.study == "7" and settings.sizing.step == 0.2
    assert settings.sizing.iterations_max == 12 and settings.sizing.volume_change_max == 1e-3
    assert settings.analysis.second_order is False and settings.crosscheck.subdivisions == (2, 3)
    assert settings.combinations.strength == {"S2": {"SW": 1.35}}
    with pytest.raises(InputError, match=r"sizing\.step: 'x'"):
        load_study(merged | {"sizing": {"step": "x"}})


def test_one_rule_for_whole_numbers():
    for value in (15, 15.0):
        assert make_settings({"defaults": {"zigzag": value}}).defaults.zigzag == 15


def test_config_is_not_changed_in_place():
    config = {"sizing": {"step": 0.2}}
    before = copy.deepcopy(config)
    make_settings(config)
    assert config == before


def test_hash_follows_all_that_decides_a_design_and_nothing_else(tmp_path):
    """One hash: not of names, tags, pictures, classes or cross-check, which change no state."""
    design, settings = Design(name="a"), make_settings({})
    plain = hash_decisions(settings, design)
    for same in (
        {"loads": {"live_kn_m2": 1}},  # 1 and 1.0
        {"designs": "other.tsv"},
        {"figures": {"width_px": 800}},
        {"sizing": {"classes": 7}},
        {"crosscheck": {"tolerance": {"work": 0.1}}},
        {"analysis": {"subdivisions_demo": 3}},
    ):
        assert hash_decisions(make_settings(same), design) == plain, same
    for other in (
        {"loads": {"live_kn_m2": 1.1}},
        {"sizing": {"step": 0.05}},
        {"sizing": {"start_thickness_mm": 100}},
        {"analysis": {"subdivisions": 2}},
        {"analysis": {"creep_coefficient": 1}},
        {"fold": {"weights": {"hinge": 0.02}}},
        {"pattern": {"sector_angle_deg": 61}},
        {"loads": {"uplift": True}},
    ):
        assert hash_decisions(make_settings(other), design) != plain, other
    assert hash_decisions(settings, Design(name="b", tags=("x",))) == plain
    assert hash_decisions(settings, Design(name="a", tags=("demo",))) != plain
    for column in ({"span": 27.0}, {"fold_mode": "exact"}, {"support": "strip"}, {"zigzag": 9}):
        assert hash_decisions(settings, Design(name="a", **column)) != plain
    (tmp_path / "one.stl").write_bytes(b"1")
    (tmp_path / "same.stl").write_bytes(b"1")
    one, same = (Design(name="a", surface=f"{tmp_path}/{n}.stl") for n in ("one", "same"))
    first = hash_decisions(settings, one)
    assert hash_decisions(settings, same) == first != plain
    (tmp_path / "one.stl").write_bytes(b"2")
    assert hash_decisions(settings, one) != first


@pytest.mark.parametrize(
    ("place", "value", "stages"),
    [
        ("pattern.sector_angle_deg", 55, {"pattern", "study"}),
        ("fold.weights.hinge", 0.02, {"fold", "study"}),
        ("analysis.subdivisions", 2, {"mesh", "study"}),
        ("sizing.step", 0.05, {"resize", "size", "study"}),
        ("sizing.start_thickness_mm", 100, {"start", "size", "study"}),
        ("sizing.iterations_max", 20, {"analyse", "size", "study"}),
        ("sizing.classes", 5, {"size", "study"}),
        ("loads.live_kn_m2", 2, {"analyse", "size", "crosscheck", "study"}),
        ("checks.strip_width_m", 0.5, {"reinforced", "analyse", "size", "checks", "study"}),
        ("material.kind", "steel", {"crosscheck", "size", "study"}),
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
    for group, kind in list_groups(Settings).items():
        if group in ("defaults", "limits", "jobs"):
            continue  # the first two go into the table of designs, `jobs` changes no result
        named = [stage for stage, kinds in STAGES.items() if kind in kinds]
        for name, known in list_settings(kind).items():
            # Those three change other settings: combinations, Young's modulus, subdivisions.
            if name not in ("uplift", "creep_coefficient", "subdivisions_demo"):
                assert set(named) & set(known.stages or named) - {"study"}, (group, name)


def test_a_stage_gets_typed_settings_back_and_no_others():
    plain = json.loads(json.dumps(stage_parameters(make_settings({}), "resize")))
    found = read_stage(plain, *STAGES["resize"])
    assert found.sizing.step == 0.1 and found.to_plain() == plain
    with pytest.raises(AttributeError, match=r"Sizing\.iterations_max was not given to this stage"):
        _ = found.sizing.iterations_max
    with pytest.raises(AttributeError, match="not given the settings material"):
        _ = found.material
    assert found.changed(found.sizing.changed(step=0.2)).sizing.step == 0.2
    for stage, kinds in STAGES.items():
        values = json.loads(json.dumps(stage_parameters(make_settings({}), stage)))
        for kind, (name, group) in zip(
            kinds, vars(read_stage(values, *kinds)).items(), strict=True
        ):
            assert isinstance(group, kind) and to_plain(group) == values[name]
    with pytest.raises(LookupError):
        read_stage(plain, *STAGES["start"], *STAGES["fold"])


def test_a_design_goes_to_a_row_and_back():
    design = Design(name="a", tags=("x", "y"), surface="arch", edge_beam_depth=0.5)
    assert Design.from_row(json.loads(json.dumps(design.to_row()))) == design


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


def test_nested_settings_get_dotted_names():
    plain = {"a": {"b": 1, "c": {"d": [1, 2]}}, "e": "f"}
    assert flatten(plain) == [("a.b", 1), ("a.c.d", "1, 2"), ("e", "f")]


def test_a_surface_from_a_file_has_the_height_of_the_file(tmp_path):
    """What stands in the table is not what was computed: a dome of 1.5 m over 6 m by 6 m."""
    count = 13
    x, y = (axis.ravel() for axis in np.meshgrid(*2 * [np.linspace(-3, 3, count)]))
    z = 1.5 * (1 - (x**2 + y**2) / 18)
    lines = [f"v {a!r} {b!r} {c!r}" for a, b, c in zip(x, y, z, strict=True)]
    first = np.arange(1, count**2 + 1).reshape(count, count)[:-1, :-1].ravel()
    lines += [f"f {k} {k + 1} {k + count + 1} {k + count}" for k in first]
    (tmp_path / "dome.obj").write_text("\n".join(lines).replace("np.float64(", "").replace(")", ""))
    table = tmp_path / "designs.tsv"
    row = f"{tmp_path}/dome.obj\t6\t2.5"
    table.write_text(f"design\tsurface\tspan_m\theight_m\na\t{row}\nb\tarch\t6\t2.5\n")
    _, (found, named) = load_study({"designs": str(table)})
    assert found.height == pytest.approx(1.5, rel=1e-12) and named.height == 2.5
    assert found.to_row()["height_m"] == found.height
