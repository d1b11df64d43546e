"""Show how far a study is: `python scripts/progress.py [results]`, from files alone."""

import argparse
import os
from pathlib import Path

from foldshell.engine.progress import read_progress, show_progress


def main(results: str | Path, designs: list[str], cores: int) -> str:
    """Return the text for the designs named, or for all that have begun."""
    names = designs or sorted(path.parent.name for path in Path(results).glob("*/sizing"))
    return show_progress(read_progress(results, names), cores)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="?", default="results")
    parser.add_argument("designs", nargs="*")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    print(main(given.results, given.designs, given.cores))
