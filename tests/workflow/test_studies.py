"""Studies of one's own beside each other: tables, settings files, settings of the command line."""

import shutil

import pytest
import yaml
from study_runner import HEADER, command, hashes, make_study, run

MINE = "only-arch\tarch\t8\t2\t5\t6\tall\tmine\n"


@pytest.fixture
def folder(finished, tmp_path):
    """Return a copy of the finished study with a second table."""
    shutil.copytree(finished, tmp_path / "copy", symlinks=True, copy_function=shutil.copy2)
    (tmp_path / "copy/mine.tsv").write_text(HEADER + MINE)
    return tmp_path / "copy"


def all_files(folder):
    """Return hashes of all results but logs and times."""
    found = hashes(folder, "results/**/*.*")
    return {name: digest for name, digest in found.items() if "/benchmarks/" not in name}


def test_another_table_has_its_own_folder_and_the_first_study_stays(code, folder):
    """But for the copies in results/, which are those of the study that ran last."""
    before = all_files(folder)
    target = "results/mine/studies/mine/summary.csv"
    done = run(code, folder, target, "--config", "designs=mine.tsv", "study=mine")
    assert done.returncode == 0, done.stderr[-3000:]
    after = all_files(folder)
    changed = {name for name in before if after.get(name) != before[name]}
    assert changed <= {f"results/{name}" for name in ("summary.csv", "summary.xlsx")} | {
        "results/studies/copies.json"
    }
    assert (folder / "results/mine/only-arch/sizing/final.json").is_file()
    copy = (folder / "results/summary.csv").read_text()
    assert copy == (folder / target).read_text() and "only-arch" in copy
    assert "tiny-dome" in (folder / "results/studies/tiny/summary.csv").read_text()


def test_a_second_table_of_the_same_name_is_refused(code, folder):
    """Its designs would take the folders of the first one's."""
    (folder / "other").mkdir()
    (folder / "other/designs.tsv").write_text(HEADER + MINE.replace("mine", "tiny"))
    done = run(code, folder, "-n", "--config", "designs=other/designs.tsv")
    assert done.returncode == 1
    assert "results: holds results of the table config/designs.tsv" in done.stderr
    assert "--config results=FOLDER" in done.stderr and "Traceback" not in done.stderr
    elsewhere = ["--config", "designs=other/designs.tsv", "results=elsewhere"]
    done = run(code, folder, "-n", *elsewhere)
    assert done.returncode == 0 and "elsewhere/only-arch" in done.stdout, done.stderr[-3000:]


@pytest.mark.parametrize("name", ["studies", "tags", "exports", "a b", "{design}"])
def test_a_table_that_cannot_name_a_folder_is_refused(code, folder, name):
    (folder / "mine.tsv").rename(folder / f"{name}.tsv")
    settings = {"designs": f"{name}.tsv", "study": "mine"}
    (folder / "my.yaml").write_text(yaml.safe_dump(settings))
    done = run(code, folder, "-n", "--configfile", "my.yaml")
    assert done.returncode == 1 and "--config results=FOLDER" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_settings_file_of_ones_own_and_nested_text_make_a_whole_report(code, folder):
    """Numbers of a group from a file, and as text from the command line."""
    (folder / "my.yaml").write_text("sizing: {iterations_max: 2}\n")
    more = ["--configfile", "my.yaml", "--config", "sizing={start_thickness_mm: 70}"]
    done = run(code, folder, "results/studies/tiny/snakemake_report.html", *more)
    assert done.returncode == 0, done.stderr[-3000:]
    again = run(code, folder, "-n", "results/studies/tiny/snakemake_report.html", *more)
    assert "Nothing to be done" in again.stdout + again.stderr


def test_a_target_of_a_table_without_the_studys_tag_runs(code, folder):
    """The default study needs its tag; another target does not."""
    mine = ["--config", "designs=mine.tsv"]
    assert run(code, folder, "-n", "tag_mine", *mine).returncode == 0
    done = run(code, folder, "-n", *mine)
    assert done.returncode == 1 and "'tiny': no design has this tag" in done.stderr + done.stdout


def test_braces_in_names_of_folders_and_files_are_no_patterns(code, finished, tmp_path):
    """A project in such a folder, and a target surface of such a name."""
    here = tmp_path / "br{a}ce {design}"
    here.mkdir()
    shutil.copytree(code, here / "co{d}e")
    folder = make_study(here / "study{x}")
    rows = "".join(
        f"v {x} {y} {0.2 * (4 - x * x / 4 - y * y / 4)}\n"
        for y in range(-4, 5) for x in range(-4, 5)
    )  # fmt: skip
    faces = [(9 * j + i + 1, 9 * j + i + 2, 9 * j + i + 11) for j in range(8) for i in range(8)]
    faces += [(9 * j + i + 1, 9 * j + i + 11, 9 * j + i + 10) for j in range(8) for i in range(8)]
    text = rows + "".join("f {} {} {}\n".format(*face) for face in faces)
    (folder / "{design}.obj").write_text(text)
    (folder / "config/designs.tsv").write_text(
        HEADER + "patch\t{design}.obj\t8\t2\t5\t6\tall\ttiny\n"
    )
    done = run(here / "co{d}e", folder, "results/patch/folded/quality.json")
    assert done.returncode == 0, done.stderr[-3000:]
    assert command(code)  # the runner itself takes any path
