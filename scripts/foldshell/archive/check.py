"""Check an archive on its own: the bag, the schema of every record, sums that must close."""

import csv
import json
import logging
import zipfile
from collections.abc import Iterator
from pathlib import Path

import bagit
import jsonschema
import numpy as np

from foldshell.archive.content import LEFT_OUT, RESULTS
from foldshell.archive.seal import is_sealed
from foldshell.files.errors import InputError
from foldshell.files.whole import Json
from foldshell.records.catalogue import FILES, ResultFile

SUM_TOLERANCE = 1e-9
"""Relative; sums of some hundred products of doubles close to 1e-13."""
BALANCE_TOLERANCE = 1e-6
"""Of reactions with loads, relative: what each analysis must keep."""
LARGEST = 20_000_000_000
"""Bytes that an archive may unpack to."""


def unpack(path: str | Path, folder: str | Path) -> Path:
    """Unpack an archive into a folder; return its bag.

    Raises
    ------
    InputError
        for no file, one that is no archive of ours, and one that leads outside of the folder.
    """
    if not Path(path).is_file():
        raise InputError(f"{path}: there is no such file: an archive of a study (.zip) is due")
    try:
        if not is_sealed(path):
            raise InputError(f"{path}: damaged: its bytes are not those that were sealed")
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            total = sum(info.file_size for info in archive.infolist())
            tops = {name.partition("/")[0] for name in names}
            outside = [name for name in names if name.startswith("/") or ".." in Path(name).parts]
            if len(tops) != 1 or outside or total > LARGEST:
                raise InputError(f"{path}: no archive of a study: one bag in it is due")
            archive.extractall(folder)
    except (OSError, zipfile.BadZipFile, NotImplementedError) as error:
        raise InputError(f"{path}: damaged: {error}") from None
    return Path(folder, tops.pop())


def check_bag(bag: Path) -> Iterator[str]:
    """Yield what is wrong with the bag: files added, missing or changed."""
    logging.getLogger("bagit").setLevel(logging.CRITICAL)
    try:
        opened = bagit.Bag(str(bag))
        missing, added = opened.compare_manifests_with_fs()
        yield from (f"{name}: missing" for name in missing)
        yield from (f"{name}: is not in the manifest of the bag" for name in added)
        opened.validate()
    except bagit.BagValidationError as error:
        yield from (str(detail) for detail in error.details) if error.details else [str(error)]
    except bagit.BagError as error:
        yield str(error)


def check_schemas(results: Path) -> Iterator[str]:
    """Yield every record that its schema does not allow."""
    for file in FILES:
        schema = results / "schemas" / f"{file.name}.schema.json"
        if not schema.is_file():
            continue
        validator = jsonschema.Draft202012Validator(json.loads(schema.read_text(encoding="utf-8")))
        for path in sorted(results.glob(_pattern(file))):
            if path.suffix == ".json":
                data = json.loads(path.read_text(encoding="utf-8"))
                errors = sorted(validator.iter_errors(data), key=str)
                yield from (f"{path}: {e.json_path}: {e.message[:200]}" for e in errors[:1])


def _pattern(file: ResultFile) -> str:
    """Return the glob of a result file's path."""
    path = file.path.replace("NN", "[0-9][0-9]")
    for name in ("<design>", "<variant>", "<tag>"):
        path = path.replace(name, "*")
    return f"**/{path}" if "/" not in path else path


def check_sums(results: Path) -> Iterator[str]:
    """Yield sums that do not close: volume and area of panels, reactions with loads, the rows of
    a summary with the designs."""
    for final in sorted(results.glob("*/sizing/final.json")):
        home = final.parents[1]
        yield from _check_volume(home, json.loads(final.read_text(encoding="utf-8")))
    for summary in sorted(results.glob("studies/*/summary.csv")):
        yield from _check_summary(results, summary)


def _check_volume(home: Path, final: Json) -> Iterator[str]:
    mesh, thickness = home / "shell/mesh.npz", _read_thickness(home, final)
    if thickness is None or not mesh.is_file():
        return
    with np.load(mesh) as arrays:
        corners = arrays["vertices"][arrays["facets"]]
        sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        facet_area = np.linalg.norm(np.cross(*sides), axis=1) / 2
        area = np.bincount(arrays["facet_panel"], facet_area)
        sheet = area[: len(thickness)].sum()
        thickness = np.append(thickness, arrays.get("fixed_thickness", np.empty(0)))
    volume = float(area @ thickness)
    yield from _compare(home, "volume_m3", final["volume_m3"], volume)
    yield from _compare(home, "area_m2", final["area_m2"], float(sheet))
    balance = final.get("reaction_imbalance")
    if balance is not None and not balance <= BALANCE_TOLERANCE:
        yield f"{home.name}: reactions and loads differ by {balance:.3g}"


def _read_thickness(home: Path, final: Json) -> np.ndarray | None:
    """Return the final thickness (P,) m: of the final state, or of its iteration where an archive
    leaves that out."""
    state, steps = home / "sizing/final.npz", home / "sizing/iterations.npz"
    if state.is_file():
        with np.load(state) as arrays:
            return arrays["thickness"]
    if steps.is_file() and "iteration" in final:
        with np.load(steps) as arrays:
            return arrays["thickness"][final["iteration"]]
    return None


def _compare(home: Path, name: str, stated: float, found: float) -> Iterator[str]:
    if not abs(stated - found) <= SUM_TOLERANCE * abs(found):
        yield f"{home.name}: {name}: {stated!r} is stated, the panels give {found!r}"


def _check_summary(results: Path, summary: Path) -> Iterator[str]:
    with summary.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    for row in rows:
        final = results / row["design"] / "sizing/final.json"
        if final.is_file():
            volume = json.loads(final.read_text(encoding="utf-8"))["volume_m3"]
            if float(row["volume_m3"] or "nan") != volume:
                yield f"{summary}: {row['design']}: volume_m3 is not that of its final.json"


def left_out(bag: Path) -> set[str]:
    """Return the results that were left out on purpose, as paths below results/."""
    path = bag / "data" / LEFT_OUT
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return {line.removeprefix(f"{RESULTS}/") for line in lines}
