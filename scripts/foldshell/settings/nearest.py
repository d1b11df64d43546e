"""The known name that a misspelt one probably means."""

import difflib
from collections.abc import Iterable


def find_nearest(word: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """Return the nearest known name; among equals one of the same letters, `step` for `stpe`."""
    near = difflib.get_close_matches(word, list(known), n=3, cutoff=cutoff)
    swapped = [name for name in near if sorted(name) == sorted(word)]
    return (swapped or near or [None])[0]


def hint_nearest(word: str, known: Iterable[str]) -> str:
    """Return the end of a sentence that names the nearest known name, empty if there is none."""
    near = find_nearest(word, known)
    return f", the nearest is {near}" if near else ""
