"""What `verify` says of a folder of results, or of an archive of them."""

import tempfile
from collections.abc import Iterable
from pathlib import Path

from foldshell.engine.integrity import Fault, find_faults, find_homes
from foldshell.engine.repair import repair
from foldshell.files.libraries import need_library

Said = tuple[list[str], int]
"""Lines to print, and the exit code."""


def verify_results(results: str | Path = "results", mend: bool = False) -> Said:
    """Return lines, one per fault and what to do, and the exit code."""
    if not find_homes(results):
        return [f"{results}: no manifest and no record of a job: nothing was made here"], 1
    faults = find_faults(results)
    lines = [f"{fault.path}: {fault.kind}: {fault.detail}" for fault in faults]
    open_faults = [fault for fault in faults if not fault.used]
    broken = [fault for fault in open_faults if fault.kind != "edited by hand"]
    if broken and mend:
        count = len(repair(results, broken))
        lines.append(f"{count} files taken away: run snakemake to make them anew")
    elif broken:
        lines.append("type: python scripts/verify.py --repair, then run snakemake again")
    return lines or ["every file is as it was made"], int(bool(open_faults))


def verify_archive(path: str | Path, recomputed: Iterable[str] = ()) -> Said:
    """Return lines on an archive, and the exit code; `recomputed` are designs to compute anew."""
    need_library("bagit", "archive")
    from foldshell.archive.check import check_bag, check_schemas, check_sums, left_out, unpack

    with tempfile.TemporaryDirectory() as scratch:
        bag = unpack(path, scratch)
        results, lines = bag / "data/results", list(check_bag(bag))
        out = left_out(bag)
        faults = [f for f in find_faults(results) if not _left_out(f, results, out) and not f.used]
        lines += [f"{fault.path}: {fault.kind}: {fault.detail}" for fault in faults]
        if not lines:
            lines += [*check_schemas(results), *check_sums(results)]
        lines = [line.replace(f"{bag}/", "") for line in lines]
        code = int(bool(lines))
        for design in recomputed if not code else ():
            more, failed = _recompute(bag, design, Path(scratch, f"anew-{design}"))
            lines, code = lines + more, code | failed
    return lines or [f"{path}: every file is as it was archived, every sum closes"], code


def rerun_archive(path: str | Path, folder: str | Path) -> Said:
    """Run the study of an archive again in a new folder; return lines on what its summary differs
    in, and the exit code."""
    need_library("bagit", "archive")
    from foldshell.archive.check import check_bag, unpack
    from foldshell.archive.rerun import rerun_study

    with tempfile.TemporaryDirectory() as scratch:
        bag = unpack(path, scratch)
        faults = [line.replace(f"{bag}/", "") for line in check_bag(bag)]
        if faults:
            return faults, 1
        lines = rerun_study(bag, Path(folder))
    return lines or [f"{folder}: summary.csv has the same bytes as the archived one"], int(
        bool(lines)
    )


def _left_out(fault: Fault, results: Path, names: set[str]) -> bool:
    inside = fault.path.is_relative_to(results)
    return (
        fault.kind == "missing" and inside and fault.path.relative_to(results).as_posix() in names
    )


def _recompute(bag: Path, design: str, folder: Path) -> Said:
    from foldshell.archive.recompute import recompute

    found = recompute(bag, design, folder)
    lines = [f"{design}: {item.describe()}" for item in found]
    return lines, int(not all(item.passed for item in found))
