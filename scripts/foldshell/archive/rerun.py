"""Run the workflow of an archive again, edits by hand included, and compare what came out."""

import csv
import io
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import yaml

from foldshell.archive.content import CODE, CONFIG, GIVEN, RESULTS
from foldshell.archive.edits import Edit, describe_edits
from foldshell.files.errors import InputError
from foldshell.files.job_record import read_records
from foldshell.files.whole import Json

TABLES = ("load_table", "supports")
"""Settings that name further tables."""


@dataclass(frozen=True)
class Rerun:
    """A folder in which the workflow of an archive runs: contents of the archive, the folder
    `code` that it runs in, settings that name its tables as seen from there."""

    data: Path
    code: Path
    tables: tuple[str, ...]

    def run(self, targets: Sequence[str], cores: int, show: bool = False) -> None:
        """Run Snakemake for targets, or for the whole study without any.

        Raises
        ------
        InputError
            for a run that fails.
        """
        words = [sys.executable, "-m", "snakemake", "--cores", str(cores), "--configfile"]
        words += [f"../{CONFIG}/config.yaml", "--config", *self.tables]
        words += [f"results={RESULTS}", "--", *targets]
        done = subprocess.run(words, cwd=self.code, capture_output=not show, text=True)
        if done.returncode:
            last = ((done.stderr or "").strip().splitlines() or ["see above"])[-1]
            raise InputError(f"the workflow of the archive failed: {last}")

    def run_with_edits(
        self, designs: Iterable[str], targets: Sequence[str], cores: int, show: bool = False
    ) -> None:
        """Run for targets, then lay in the workbooks that a person edited, one of each design at a
        time in order of iterations, and run on."""
        self.run(targets, cores, show)
        for step in _rounds(self.data, designs):
            for design, edit in step:
                source = self.data / RESULTS / design / edit.file
                shutil.copyfile(source, self.code / RESULTS / design / edit.path)
            self.run(targets, cores, show)


def prepare_rerun(bag: Path, folder: Path) -> Rerun:
    """Lay out code, settings and given files of an archive in a folder; raises `InputError` where
    something stands there already."""
    data = bag / "data"
    if folder.exists() and any(folder.iterdir()):
        raise InputError(f"{folder}: is not empty: name a new folder")
    shutil.copytree(data / CODE, folder / CODE)
    shutil.copytree(data / CONFIG, folder / CONFIG)
    if (data / GIVEN).is_dir():
        shutil.copytree(data / GIVEN, folder / CODE, dirs_exist_ok=True)
    settings = yaml.safe_load((data / CONFIG / "config.yaml").read_text(encoding="utf-8"))
    for key in ("load_table", "supports"):
        place = Path(str(settings.get(key, "")))
        if not place.is_absolute() and (data / CONFIG / place.name).is_file():
            (folder / CODE / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(data / CONFIG / place.name, folder / CODE / place)
    table = Path(str(settings.get("designs", "designs.tsv"))).name
    return Rerun(
        data, folder / CODE, (f"designs=../{CONFIG}/{table}", *_other_tables(data, settings))
    )


def _other_tables(data: Path, settings: Json) -> list[str]:
    """Return settings that name the archived tables of loads and supports, where the commit does
    not hold them at their own place."""
    named = [(key, Path(str(settings[key]))) for key in TABLES if key in settings]
    return [
        f"{key}=../{CONFIG}/{path.name}" for key, path in named
        if not (data / CODE / path).is_file() and (data / CONFIG / path.name).is_file()
    ]  # fmt: skip


def rerun_study(bag: Path, folder: Path, cores: int = 2) -> list[str]:
    """Run the study of an archive again in a new folder; return what its summaries differ in.

    Raises
    ------
    InputError
        for a folder that is not empty, and a run that fails.
    """
    task = prepare_rerun(bag, folder)
    summaries = sorted((task.data / RESULTS).glob("studies/*/summary.csv"))
    if not summaries:
        raise InputError(f"{bag.name}: no summary of a study in it")
    designs = [row["design"] for row in _rows(summaries[0])]
    task.run_with_edits(designs, (), cores, show=True)
    lines = []
    for summary in summaries:
        name = summary.relative_to(task.data).as_posix()
        lines += [f"{name}: {line}" for line in compare_tables(summary, task.code / name)]
    return lines


def compare_tables(one: Path, other: Path) -> Iterator[str]:
    """Yield where two tables of designs differ, by design and column; nothing for equal bytes."""
    if not other.is_file():
        yield "was not made"
        return
    if one.read_bytes() == other.read_bytes():
        return
    rows = {row["design"]: row for row in _rows(other)}
    before = _rows(one)
    if [row["design"] for row in before] != list(rows):
        yield "other designs"
        return
    for row in before:
        for column, value in row.items():
            if rows[row["design"]].get(column) != value:
                found = rows[row["design"]].get(column)
                yield f"{row['design']}: {column}: {value!r} became {found!r}"


def _rows(path: Path) -> list[dict[str, str]]:
    text = path.read_text(encoding="utf-8")
    return list(csv.DictReader(io.StringIO(text)))


def _rounds(data: Path, designs: Iterable[str]) -> list[list[tuple[str, Edit]]]:
    """Return the edits of designs, first ones together, then second ones."""
    edits = {}
    for design in designs:
        home = data / RESULTS / design
        edits[design] = [edit for edit in describe_edits(home, read_records(home)) if edit.file]
    most = max(map(len, edits.values()), default=0)
    return [
        [(design, found[number]) for design, found in edits.items() if number < len(found)]
        for number in range(most)
    ]
