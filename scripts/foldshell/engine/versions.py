"""Which Snakemake runs the workflow."""

import re
from importlib.metadata import version

from foldshell.files.errors import InputError

OLDEST, BELOW = (9, 0), (9, 28)
"""Minor versions of Snakemake: the oldest that runs, and the first that nobody has tried."""


def describe_range() -> str:
    """Return the range as pip writes it."""
    return "snakemake>={}.{},<{}.{}".format(*OLDEST, *BELOW)


def check_snakemake(found: str | None = None) -> None:
    """Raise `InputError` for a Snakemake outside the range that is tested; the installed one's
    version is `found` if None."""
    found = found or version("snakemake")
    numbers = tuple(int(number) for number in re.findall(r"\d+", found)[:2])
    if not OLDEST <= numbers < BELOW:
        raise InputError(
            f"snakemake {found}: {'older' if numbers < OLDEST else 'newer'} than this workflow has "
            f"been tried with: pip install '{describe_range()}'"
        )
