"""Verify results by content: `python scripts/verify.py`, `foldshell verify`, or rule verify.

Says of each file that is not as it was made whether it is missing, damaged, edited by hand, left
over or made by another version; exit code 1 where there is any. It needs the folder of results
alone. With --repair what is damaged is taken away, with all that its jobs and later ones made, so
that the next run of Snakemake makes it anew; copies stay under replaced/.
"""

import argparse
import sys
from pathlib import Path

from foldshell.engine.integrity import find_faults, find_homes
from foldshell.engine.repair import repair


def main(results: str | Path = "results", mend: bool = False) -> tuple[list[str], int]:
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


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="?", default="results")
    parser.add_argument("--repair", action="store_true")
    given = parser.parse_args()
    said, code = main(given.results, given.repair)
    print("\n".join(said))
    sys.exit(code)
