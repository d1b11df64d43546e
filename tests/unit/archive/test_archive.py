"""An archive holds what made a study, names nobody, and tells of every changed bit."""

import json
import random
import shutil
import zipfile

import numpy as np
import pytest

bagit = pytest.importorskip("bagit", reason="envs/archive.lock is not installed")
pytest.importorskip("rocrate", reason="envs/archive.lock is not installed")

import verify  # noqa: E402
from archive_case import DATE, give, make_study, with_an_edit, write  # noqa: E402
from foldshell.archive.bag import write_archive  # noqa: E402
from foldshell.archive.check import check_bag, check_sums, unpack  # noqa: E402
from foldshell.archive.content import clean_text  # noqa: E402
from foldshell.archive.edits import describe_edits, find_edits  # noqa: E402
from foldshell.archive.recompute import compare_design  # noqa: E402
from foldshell.archive.rerun import compare_tables, prepare_rerun  # noqa: E402
from foldshell.archive.seal import is_sealed  # noqa: E402
from foldshell.files.errors import InputError  # noqa: E402
from foldshell.files.job_record import read_records  # noqa: E402
from foldshell.files.whole import hash_file, write_arrays, write_json  # noqa: E402
from foldshell.settings.archive import Archive  # noqa: E402
from foldshell.settings.config_file import read_config  # noqa: E402
from results_case import record  # noqa: E402
from workbook_cases import edit_with_openpyxl  # noqa: E402


@pytest.fixture
def study(tmp_path):
    return make_study(tmp_path)


def test_an_archive_checks_out_on_its_own(study, tmp_path):
    path = write(study, tmp_path / "t.zip")
    shutil.rmtree(study.project)
    said, code = verify.verify_archive(path)
    assert code == 0 and "every sum closes" in said[0]
    assert is_sealed(path)


def test_the_same_results_give_the_same_bytes(study, tmp_path):
    one, other = (write(study, tmp_path / folder / "t.zip") for folder in "xy")
    assert one.read_bytes() == other.read_bytes()


def test_any_flipped_bit_is_found(study, tmp_path):
    """Also one in what a zip holds besides the files, such as its dates."""
    path = write(study, tmp_path / "t.zip")
    data, chance = path.read_bytes(), random.Random(3)
    places = [chance.randrange(8 * len(data)) for _ in range(60)]
    for place in [*places, 0, 8 * len(data) - 1, 8 * (len(data) - 64), 8 * 10]:
        spoilt = bytearray(data)
        spoilt[place // 8] ^= 1 << place % 8
        path.write_bytes(spoilt)
        with pytest.raises(InputError, match="damaged"):
            verify.verify_archive(path)


def test_a_bag_that_was_packed_again_after_a_change_is_found(study, tmp_path):
    """By the hashes of the bag, the manifests of designs and their own hash."""
    bag = unpack(write(study, tmp_path / "t.zip"), tmp_path / "out")
    target = bag / "data/results/a/history.json"
    target.write_text(target.read_text().replace("2", "3"))
    assert any("history.json" in line for line in check_bag(bag))
    (bag / "data/results/a/page.html").unlink()
    assert any("page.html" in line for line in check_bag(bag))


def test_settings_of_an_archive_are_read_as_they_were(study, tmp_path):
    """Numbers such as 1e-6 are text in the YAML that a plain JSON writer would leave."""
    config = {"study": "t", "analysis": {"second_order_tolerance": 1e-6, "solver": "cholmod"}}
    write_archive(
        tmp_path / "t.zip",
        study,
        config,
        [study.project / "designs.tsv"],
        "ab" * 32,
        DATE,
        Archive(),
    )
    bag = unpack(tmp_path / "t.zip", tmp_path / "out")
    assert read_config(bag / "data/config/config.yaml") == config


def test_an_earlier_archive_stays_outside(study, tmp_path):
    """With the record of the job that made it: what it names is not in the new one."""
    write_json(study.home / "archive/archive.json", {"file": "old.zip"})
    record(study.home, "archive_study", "archive_study", ["archive/archive.json"])
    path = write(study, tmp_path / "t.zip")
    with zipfile.ZipFile(path) as archive:
        assert not any("archive" in name for name in archive.namelist())
    assert verify.verify_archive(path)[1] == 0


def test_without_fields_shape_and_thicknesses_stay(study, tmp_path):
    """Which is how an archive is made unless fields are asked for."""
    home = study.results / "a"
    for name in ("folded/folded.npz", "sizing/iterations.npz", "sizing/final.npz"):
        write_arrays(home / name, {"thickness": np.ones((2, 6))})
    path = write(study, tmp_path / "t.zip")
    with zipfile.ZipFile(path) as archive:
        names = "\n".join(archive.namelist())
    assert "folded.npz" in names and "iterations.npz" in names
    assert "analysis.npz" not in names and "final.npz" not in names
    assert verify.verify_archive(path)[1] == 0
    with zipfile.ZipFile(write(study, tmp_path / "f.zip", fields=True)) as archive:
        assert "t/data/results/a/sizing/final.npz".replace("t/", "f/", 1) in archive.namelist()


def test_a_dirty_tree_is_refused_or_said(study, tmp_path):
    (study.project / "Snakefile").write_text("# other\n")
    with pytest.raises(InputError, match=r"Snakefile differs from commit"):
        write(study, tmp_path / "t.zip")
    assert not (tmp_path / "t.zip").exists()
    with zipfile.ZipFile(write(study, tmp_path / "t.zip", dirty="diff")) as archive:
        assert b"+# other" in archive.read("t/data/difference.patch")
        assert archive.read("t/data/code/Snakefile") == b"# Snakefile\n"


def test_results_that_name_the_machine_are_refused(study, tmp_path):
    page = study.results / "a/page.html"
    page.write_text(f"<p>{study.project}</p>")
    with pytest.raises(InputError, match=r"page.html: .*names this machine"):
        write(study, tmp_path / "t.zip")


def test_logs_lose_paths_of_the_machine(study):
    text = clean_text("read /home/someone/project/config/x.tsv\n", ["/home/someone/project"])
    assert text == "read config/x.tsv\n"


def test_provenance_has_an_action_for_each_job_and_each_edit(study, tmp_path):
    home = study.results / "a"
    with_an_edit(study)
    (edit,) = find_edits(read_records(home))
    assert edit.path == "sizing/00/thickness.xlsx" and edit.reader == "analyse-00"
    with zipfile.ZipFile(write(study, tmp_path / "t.zip")) as archive:
        graph = json.loads(archive.read("t/data/ro-crate-metadata.json"))["@graph"]
    entities = {item["@id"]: item for item in graph}
    action = entities["#job-a-analyse-01"]
    assert action["instrument"]["@id"] == "code/scripts/analyse.py"
    assert {"@id": "results/a/sizing/01/thickness.xlsx"} in action["object"]
    assert {"@id": "results/a/sizing/01/analysis.json"} in action["result"]
    (update,) = (item for item in graph if item["@type"] == "UpdateAction")
    assert edit.written_sha256 in update["description"]
    assert "thickness!D5 (panel 2): 0.2 -> 0.25 m" in update["description"]
    (cell,) = (entities[item["@id"]] for item in update["additionalProperty"])
    assert cell["name"] == "thickness!D5" and cell["value"] == 0.25
    jobs = [item for item in graph if item["@id"].startswith("#job-")]
    controls = [item for item in graph if item["@type"] == "ControlAction"]
    assert len(jobs) == len(controls) == 2 * 6 + 1


def test_cells_of_an_edit_that_was_replaced_since_are_known_from_its_copy(study):
    """The copy that is kept aside has the bytes that the analysis read."""
    home, book = study.results / "a", study.results / "a/sizing/00/thickness.xlsx"
    edit_with_openpyxl(book, lambda workbook: workbook["thickness"].__setitem__("D4", 0.5))
    record(home, "analyse-00", "analyse", ["sizing/00/analysis.json"], ["sizing/00/thickness.xlsx"])
    book.rename(book.with_name(f"edited-{hash_file(book)[:12]}.xlsx"))
    book.write_bytes(b"another")
    (edit,) = describe_edits(home, read_records(home))
    assert [(cell.panel, cell.before, cell.after) for cell in edit.cells] == [(1, 0.2, 0.5)]
    book.with_name(edit.file.rpartition("/")[2]).unlink()
    (edit,) = describe_edits(home, read_records(home))
    assert edit.cells is None and "not known" in edit.describe()


def test_a_workbook_that_was_only_saved_anew_has_no_cells(study):
    home, book = study.results / "a", study.results / "a/sizing/00/thickness.xlsx"
    edit_with_openpyxl(book, lambda workbook: None)
    record(home, "analyse-00", "analyse", ["sizing/00/analysis.json"], ["sizing/00/thickness.xlsx"])
    (edit,) = describe_edits(home, read_records(home))
    assert edit.cells == () and "no thickness changed" in edit.describe()


def test_surface_files_are_in_the_archive_and_in_a_rerun(study, tmp_path):
    give(study, "models/roof.obj")
    bag = unpack(write(study, tmp_path / "t.zip"), tmp_path / "out")
    assert (bag / "data/given/models/roof.obj").read_text() == "v 0 0 0\n"
    task = prepare_rerun(bag, tmp_path / "again")
    assert (task.code / "models/roof.obj").is_file() and task.tables == (
        "designs=../config/designs.tsv",
    )
    with pytest.raises(InputError, match="not empty"):
        prepare_rerun(bag, tmp_path / "again")


def test_a_table_of_loads_that_no_commit_holds_is_named_in_a_rerun(study, tmp_path):
    """By its place in the archive; the one of the commit stays where it is."""
    loads = study.project / "my_loads.tsv"
    loads.write_text("set\tcase\n")
    tables = [study.project / "designs.tsv", loads]
    config = {"study": "t", "load_table": "my_loads.tsv", "supports": "config/supports.tsv"}
    write_archive(tmp_path / "t.zip", study, config, tables, "ab" * 32, DATE, Archive())
    task = prepare_rerun(unpack(tmp_path / "t.zip", tmp_path / "out"), tmp_path / "again")
    assert task.tables == ("designs=../config/designs.tsv", "load_table=../config/my_loads.tsv")
    assert (task.code.parent / "config/my_loads.tsv").is_file()


def test_a_surface_file_that_has_changed_or_lies_elsewhere_is_refused(study, tmp_path):
    give(study, "models/roof.obj")
    (study.project / "models/roof.obj").write_text("v 1 0 0\n")
    with pytest.raises(InputError, match=r"roof.obj: has changed since it was read"):
        write(study, tmp_path / "t.zip")
    give(study, "/elsewhere/roof.obj")
    with pytest.raises(InputError, match=r"roof.obj: is not in project"):
        write(study, tmp_path / "t.zip")


def test_differences_of_tables_name_design_and_column(tmp_path):
    for name, value in (("one", "1.0"), ("same", "1.0"), ("other", "2.0")):
        (tmp_path / name).write_text(f"design,volume_m3\na,{value}\n")
    assert list(compare_tables(tmp_path / "one", tmp_path / "same")) == []
    (line,) = compare_tables(tmp_path / "one", tmp_path / "other")
    assert line == "a: volume_m3: '1.0' became '2.0'"
    assert list(compare_tables(tmp_path / "one", tmp_path / "none")) == ["was not made"]


def test_a_file_that_was_left_out_is_compared_by_its_hash(tmp_path):
    for name, value in (("one", 1.0), ("other", 1.0)):
        home = tmp_path / name
        write_arrays(home / "folded/folded.npz", {"vertices": np.array([value])})
        write_arrays(home / "sizing/final.npz", {"thickness": np.array([0.1])})
        write_json(home / "sizing/final.json", {"verdict": "converged", "volume_m3": 0.1})
    record(tmp_path / "one", "size", "size", ["sizing/final.npz"])
    (tmp_path / "one/sizing/final.npz").unlink()
    found = compare_design(tmp_path / "one", tmp_path / "other")
    assert all(item.same_bytes for item in found)
    write_arrays(tmp_path / "other/sizing/final.npz", {"thickness": np.array([0.2])})
    second = compare_design(tmp_path / "one", tmp_path / "other")[1]
    assert not second.same_bytes and second.passed
    assert "not in the archive" in second.describe()


def test_sums_that_do_not_close_are_said(tmp_path):
    """Two unit triangles of one panel, 0.1 m thick: 1 m2 and 0.1 m3."""
    home = tmp_path / "a"
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    facets, panel = np.array([[0, 1, 2], [0, 2, 3]]), np.zeros(2, int)
    mesh = {"vertices": vertices, "facets": facets, "facet_panel": panel}
    write_arrays(home / "shell/mesh.npz", mesh)
    write_arrays(home / "sizing/final.npz", {"thickness": np.array([0.1])})
    final = {"volume_m3": 0.1, "area_m2": 1.0, "reaction_imbalance": 1e-9}
    write_json(home / "sizing/final.json", final)
    assert list(check_sums(tmp_path)) == []
    (home / "sizing/final.npz").unlink()  # left out: the last of all iterations is there
    write_arrays(home / "sizing/iterations.npz", {"thickness": np.array([[0.2], [0.1]])})
    write_json(home / "sizing/final.json", final | {"iteration": 1})
    assert list(check_sums(tmp_path)) == []
    write_json(home / "sizing/final.json", final | {"iteration": 0})
    assert len(list(check_sums(tmp_path))) == 1
    write_arrays(home / "sizing/final.npz", {"thickness": np.array([0.1])})
    for key, value in (("volume_m3", 0.1001), ("area_m2", 1.0001), ("reaction_imbalance", 1e-5)):
        write_json(home / "sizing/final.json", final | {key: value})
        assert len(list(check_sums(tmp_path))) == 1


@pytest.mark.parametrize(("change", "passed"), [(0.0, True), (1e-12, True), (1e-6, False)])
def test_digits_of_a_design_computed_anew(tmp_path, change, passed):
    for name, value in (("one", 1.0), ("other", 1.0 + change)):
        home = tmp_path / name
        write_arrays(home / "folded/folded.npz", {"vertices": np.array([value])})
        write_arrays(home / "sizing/final.npz", {"thickness": np.array([0.1])})
        write_json(home / "sizing/final.json", {"verdict": "converged", "volume_m3": 0.1 * value})
    found = compare_design(tmp_path / "one", tmp_path / "other")
    assert all(item.passed for item in found) is passed
    assert found[0].same_bytes is (change == 0)


def test_a_file_that_is_no_archive_is_one_sentence(tmp_path):
    path = tmp_path / "x.zip"
    for data in (b"", b"PK", b"no zip at all" * 20):
        path.write_bytes(data)
        with pytest.raises(InputError, match=r"x.zip: damaged"):
            verify.verify_archive(path)
