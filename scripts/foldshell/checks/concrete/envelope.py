"""Largest means of each panel, and where and under which combination they stand."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.sampling import Sampling
from foldshell.shell.stress import StressResultants

NUMBERS = 30_000_000
"""Values at points that are held at a time, 240 MB: of large shells some combinations only."""


@dataclass(frozen=True)
class Envelope:
    """Of P panels and k quantities: `value` (P, k) in their unit, `row` (P, k) of the strips and
    `combination` (P, k) as numbers."""

    value: np.ndarray
    row: np.ndarray
    combination: np.ndarray


def split_combinations(
    sampling: Sampling, resultants: StressResultants, width: int
) -> Iterator[StressResultants]:
    """Yield combinations in parts of which `width` values at all points fit into memory.

    resultants (E, 3, m, c) kN/m and kNm/m.
    """
    elements, columns = resultants.force.shape[0], resultants.force.shape[-1]
    size = max(1, NUMBERS // (elements * len(sampling.points) * width))
    for start in range(0, columns, size):
        yield resultants.columns(slice(start, start + size))


def take_means(sampling: Sampling, values: np.ndarray) -> np.ndarray:
    """Return the mean (S, c, ...) of each row, of values (E, q, c, ...) in any unit."""
    flat = values.reshape(values.shape[0] * values.shape[1], -1)
    return (sampling.means @ flat).reshape(-1, *values.shape[2:])


def find_envelope(panel: np.ndarray, means: np.ndarray, panels: int) -> Envelope:
    """Return the largest of rows and combinations; panel (S,), means (S, c, k) in any unit.

    Values below nothing count as nothing; rows of panels beyond the first `panels` are left out.
    """
    rows = np.flatnonzero(panel < panels)
    best = means[rows].argmax(axis=1)
    largest = np.take_along_axis(means[rows], best[:, None], axis=1)[:, 0]
    order = np.argsort(panel[rows], kind="stable")
    starts = np.searchsorted(panel[rows][order], np.arange(panels))
    value = np.maximum.reduceat(largest[order], starts, axis=0)
    own = panel[rows][order]
    place = np.where(largest[order] == value[own], np.arange(len(own))[:, None], len(own))
    first = np.minimum.reduceat(place, starts, axis=0)
    at = rows[order][first]
    combination = np.take_along_axis(best[order], first, axis=0)
    return Envelope(np.maximum(value, 0.0), at, combination)
