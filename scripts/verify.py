"""Verify results by content: `python scripts/verify.py`, `foldshell verify`, or rule verify.

Says of each file that is not as it was made whether it is missing, damaged, edited by hand, left
over or made by another version; exit code 1 where there is any. It needs the folder of results
alone. With --repair what is damaged is taken away, with all that its jobs and later ones made, so
that the next run of Snakemake makes it anew; copies stay under replaced/.

An archive of a study (.zip) is checked whole: hashes, schema of every record, sums that must close;
with --recompute DESIGN one design is computed anew from it, and compared digit by digit. With
--rerun FOLDER the whole study runs again there, edits by hand included; its summary is compared.
"""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from foldshell.engine.verification import Said, rerun_archive, verify_archive, verify_results
from foldshell.files.errors import user_errors


def main(results: str | Path = "results", mend: bool = False) -> Said:
    """Return lines, one per fault and what to do, and the exit code."""
    return verify_results(results, mend)


def run(call: Callable[[], Said]) -> None:
    """Print what a check says, and exit with its code."""
    with user_errors():
        said, code = call()
    print("\n".join(said))
    sys.exit(code)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="?", default="results")
    parser.add_argument("--repair", action="store_true")
    parser.add_argument("--recompute", action="append", default=[], metavar="DESIGN")
    parser.add_argument("--rerun", metavar="FOLDER")
    task = globals().get("snakemake")
    given = parser.parse_args([task.params.results] if task else None)
    if given.rerun:
        run(lambda: rerun_archive(given.results, given.rerun))
    if given.results.endswith(".zip"):
        run(lambda: verify_archive(given.results, given.recompute))
    run(lambda: main(given.results, given.repair))
