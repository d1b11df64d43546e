"""Where results of a table go, and names that designs and tables may not have."""

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.designs import read_designs
from foldshell.settings.make import make_settings
from foldshell.settings.places import RESERVED, check_results, choose_results, claim_results

NAMES = "studies tags bench benchmarks figures report explorations kinematics exports archive"


@pytest.mark.parametrize(
    ("table", "results", "expected"),
    [
        ("config/designs.tsv", "auto", "results"),
        ("mine.tsv", "auto", "results/mine"),
        ("a/b/Mine-2.tsv", "auto", "results/Mine-2"),
        ("mine.tsv", "out/all", "out/all"),
        ("config/designs.tsv", "other", "other"),
    ],
)
def test_every_table_has_its_folder(table, results, expected):
    assert choose_results(make_settings({"designs": table, "results": results})) == expected


@pytest.mark.parametrize("results", ["", "/tmp/x", "../x", "a b", "{design}", "a/../b", "a//b"])
def test_a_folder_outside_or_a_pattern_is_refused(results):
    with pytest.raises(InputError, match="results"):
        choose_results(make_settings({"results": results}))


@pytest.mark.parametrize("study", ["{design}", "../x", "a b", "MINE", "-x", "a" * 40])
def test_a_study_that_can_be_no_tag_is_refused(study):
    with pytest.raises(InputError, match="study"):
        choose_results(make_settings({"study": study}))


@pytest.mark.parametrize("name", NAMES.split())
def test_reserved_names_are_refused_for_designs_and_tables(name, tmp_path):
    assert name in RESERVED
    with pytest.raises(InputError, match=r"is reserved.*--config results=FOLDER"):
        choose_results(make_settings({"designs": f"{name}.tsv"}))
    table = tmp_path / "designs.tsv"
    table.write_text(f"design\n{name}\n")
    with pytest.raises(InputError, match="reserved"):
        read_designs(table, make_settings({}))


def test_results_belong_to_one_table(tmp_path):
    table, other = tmp_path / "a/designs.tsv", tmp_path / "b/designs.tsv"
    for path in (table, other):
        path.parent.mkdir()
        path.write_text("design\nx\n")
    check_results(tmp_path / "results", table)
    claim_results(tmp_path / "results", table)
    check_results(tmp_path / "results", table)
    with pytest.raises(InputError, match=r"holds results of the table .*a/designs\.tsv"):
        check_results(tmp_path / "results", other)
    table.rename(tmp_path / "moved.tsv")  # nothing is left that could be mixed with it
    check_results(tmp_path / "results", other)


def test_the_folder_of_a_design_is_no_folder_of_a_table(tmp_path):
    (tmp_path / "results/mine/sizing").mkdir(parents=True)
    with pytest.raises(InputError, match="is the folder of a design"):
        check_results(tmp_path / "results/mine", "mine.tsv")
