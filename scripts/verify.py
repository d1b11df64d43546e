"""Verify results: `python scripts/verify.py`, or rule verify.

Exit code 1 where a file was deleted, damaged or changed after it was made; with --repair those
files and what was made from them are removed, so that the next run of Snakemake makes them anew.
"""

import argparse
import sys
from pathlib import Path

from foldshell.engine.integrity import (
    find_dependents,
    find_faults,
    keep_current,
    read_records,
)
from foldshell.files.edits import keep_edited


def main(root: str | Path = ".", results: str = "results", repair: bool = False) -> list[str]:
    """Return a line a fault and what to do; empty where all files are as they were made."""
    root = Path(root)
    records = keep_current(read_records(root / ".snakemake/metadata"), results)
    if not records:
        return [f"{root / results}: no records of Snakemake: run it here first"]
    faults = find_faults(root, records)
    lines = [f"{fault.path}: {fault.kind}: {fault.detail}" for fault in faults]
    again = find_dependents(faults, records)
    if again and repair:
        for path in again:
            keep_edited(root / path)
            if (root / path).is_file():
                (root / path).unlink()
        lines.append(f"{len(again)} files removed: run snakemake to make them anew")
    elif again:
        lines.append("type: python scripts/verify.py --repair, then run snakemake again")
    return lines


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", default=".")
    parser.add_argument("--results", default="results")
    parser.add_argument("--repair", action="store_true")
    given = parser.parse_args()
    found = main(given.root, given.results, given.repair)
    print("\n".join(found) or "every file is as it was made")
    sys.exit(1 if found else 0)
