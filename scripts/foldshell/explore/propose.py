"""Propose designs: an even spread (Sobol), or by a model of what was found.

Gaussian process with Matern 5/2 kernel on the logarithm of the aims (Rasmussen and Williams 2006,
Gaussian Processes for Machine Learning), expected improvement (Jones, Schonlau and Welch 1998)
times the probability that limits are kept (Gardner et al. 2014), batches by believing the model's
mean (Ginsbourger, Le Riche and Carraro 2010); two aims by the expected gain of the dominated area
(Emmerich, Deutz and Klinkenberg 2011). What columns tell (numbers of panels) is no model's affair.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.explore.found import MIDDLE, Found, find_silent, gather
from foldshell.explore.gains import expect_front_gain, expect_improvement
from foldshell.records.candidate import CandidateRecord
from foldshell.settings.exploration import Exploration

POOL = 1024
NEAR = 256
"""Points of the pool: spread over the box, and near the best designs."""
SPREAD = 0.08


@dataclass(frozen=True)
class Model:
    """Mean and deviation of a quantity over the box, from what was found."""

    predict: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


def spread_points(exploration: Exploration, count: int, skip: int = 0) -> np.ndarray:
    """Return scrambled Sobol points (count, d) from 0 to 1, after `skip` of the same sequence."""
    from scipy.stats import qmc

    sequence = qmc.Sobol(len(exploration.variables), seed=exploration.search.seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # counts that are no power of two are meant
        if skip:
            sequence.fast_forward(skip)
        return sequence.random(count)


def snap(exploration: Exploration, points: np.ndarray) -> np.ndarray:
    """Return points (k, d), no unit, where columns put them: wholes in the middle of a part, what
    a pattern does not have in the middle."""
    snapped = points.copy()
    names = [variable.name for variable in exploration.variables]
    for place, variable in enumerate(exploration.variables):
        if variable.whole or variable.choices:
            values = [variable.to_value(float(share)) for share in points[:, place]]
            snapped[:, place] = [variable.to_share(value) for value in values]
    if "pattern" in names:
        chosen = exploration.variables[names.index("pattern")]
        for point in snapped:
            silent = find_silent(chosen.to_value(float(point[names.index("pattern")])))
            point[[place for place, name in enumerate(names) if name in silent]] = MIDDLE
    return snapped


def fit_process(points: np.ndarray, values: np.ndarray, seed: int) -> Model:
    """Fit a Gaussian process to values (k,) at points (k, d); no unit."""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    scales = np.full(points.shape[1], 0.5)
    kernel = ConstantKernel(1.0, (1e-2, 1e2)) * Matern(scales, (5e-2, 2e1), nu=2.5)
    kernel += WhiteKernel(1e-3, (1e-6, 1e-1))
    process = GaussianProcessRegressor(
        kernel, normalize_y=True, n_restarts_optimizer=1, random_state=seed
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(points, values)
    return Model(lambda where: process.predict(where, return_std=True))


def propose_points(
    exploration: Exploration, records: Sequence[CandidateRecord], number: int, count: int
) -> np.ndarray:
    """Return `count` points (count, d) for round `number`, from 1: the first is an even spread."""
    search = exploration.search
    if number == 1 or search.method == "sobol":
        before = 0 if number == 1 else search.first + (number - 2) * search.batch
        return spread_points(exploration, count, before)
    found = gather(exploration, records)
    known = np.isfinite(found.aims).all(axis=1)
    if known.sum() < 3:
        return spread_points(exploration, count, search.first + (number - 2) * search.batch)
    pool = snap(exploration, make_pool(exploration, found, number))
    return choose_batch(exploration, found, pool, count, seed=search.seed + number)


def make_pool(exploration: Exploration, found: Found, number: int) -> np.ndarray:
    """Return points (POOL + NEAR, d), no unit: over the box, and around the best found."""
    from scipy.stats import qmc

    size, seed = len(exploration.variables), exploration.search.seed + 1000 * number
    spread = qmc.Sobol(size, seed=seed).random(POOL)
    chance = np.random.default_rng(seed)
    best = found.points[_find_best(found)]
    near = best[chance.integers(len(best), size=NEAR)] + chance.normal(0, SPREAD, (NEAR, size))
    return np.vstack([spread, np.clip(near, 0, 1)])


def _find_best(found: Found) -> np.ndarray:
    """Return the rows of the best designs: the four best of one aim, of two the front."""
    order = np.argsort(np.where(found.feasible, 0, 10) + np.nan_to_num(found.aims[:, 0], nan=20))
    if found.aims.shape[1] == 1:
        return order[:4]
    least, front = np.inf, []
    for row in order[found.feasible[order]]:
        if found.aims[row, 1] < least:
            least = found.aims[row, 1]
            front.append(row)
    return np.array(front) if front else order[:4]


def choose_batch(
    exploration: Exploration, found: Found, pool: np.ndarray, count: int, seed: int,
    cheap: np.ndarray | None = None,
) -> np.ndarray:  # fmt: skip
    """Return the `count` points (count, d) of a pool (k, d) that promise most, one after the other.

    `cheap` (k,): logarithms of the cheap answers of the pool's points, which become the mean of
    the model in place of a constant.
    """
    chosen: list[int] = []
    keep = keep_probability(found, pool, seed)
    for _ in range(min(count, len(pool))):
        gain = expect_gain(exploration, found, pool, seed, cheap) * keep
        gain[chosen] = -1
        for place in chosen:
            gain[np.linalg.norm(pool - pool[place], axis=1) < 1e-6] = -1
        best = int(np.argmax(gain))
        chosen.append(best)
        found = believe(found, pool[best], seed, None if cheap is None else cheap[best])
    return pool[chosen]


def _shift(found: Found, column: int, cheap: np.ndarray | None) -> tuple[np.ndarray, Callable]:
    """Return which rows are known, and the mean that the cheap answers give, by least squares."""
    known = np.isfinite(found.aims[:, column])
    if cheap is None or not found.leads[column]:
        return known, lambda logs: np.zeros(len(logs))
    known &= np.isfinite(found.cheap)
    slope, start = np.polyfit(found.cheap[known], found.aims[known, column], 1)
    slope = float(np.clip(slope, 0, 1.5))
    start = float(np.mean(found.aims[known, column] - slope * found.cheap[known]))
    return known, lambda logs: start + slope * logs


def predict_aim(
    found: Found, pool: np.ndarray, column: int, seed: int, cheap: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return mean and deviation (k,) of the logarithm of one aim at a pool (k, d); no unit."""
    if column in found.told:
        return found.told[column](pool), np.zeros(len(pool))
    known, mean_of = _shift(found, column, cheap)
    rest = found.aims[known, column] - mean_of(found.cheap[known])
    mean, deviation = fit_process(found.points[known], rest, seed).predict(pool)
    return mean + (mean_of(cheap) if cheap is not None else 0.0), deviation


def expect_gain(
    exploration: Exploration, found: Found, pool: np.ndarray, seed: int, cheap: np.ndarray | None
) -> np.ndarray:
    """Return the expected gain (k,) at a pool (k, d), no unit: of one aim, or of the front."""
    count = len(exploration.aims)
    told = [predict_aim(found, pool, column, seed, cheap) for column in range(count)]
    known = np.isfinite(found.aims).all(axis=1)
    kept = found.aims[known & found.feasible]
    if count == 1:
        best = kept.min() if len(kept) else found.aims[known].max()
        return expect_improvement(*told[0], float(best))
    corner = found.aims[known].max(axis=0) + 0.1
    front = kept if len(kept) else np.empty((0, 2))
    return expect_front_gain(*told, front, corner)


def keep_probability(found: Found, pool: np.ndarray, seed: int) -> np.ndarray:
    """Return the probability (k,), no unit, that a point of the pool (k, d) keeps all limits."""
    from scipy.special import ndtr

    keep = np.ones(len(pool))
    for column in range(found.margins.shape[1]):
        margin = found.margins[:, column]
        known = np.isfinite(margin)
        if known.sum() < 3 or margin[known].min() > 0.0:
            continue  # never broken so far
        mean, deviation = fit_process(found.points[known], margin[known], seed).predict(pool)
        keep *= ndtr(mean / np.maximum(deviation, 1e-9))
    return keep


def believe(found: Found, point: np.ndarray, seed: int, cheap: float | None) -> Found:
    """Return what is known with a point (d,), no unit, at which the models are believed."""
    count = found.aims.shape[1]
    logs = None if cheap is None else np.array([cheap])
    aims = [float(predict_aim(found, point[None], c, seed, logs)[0][0]) for c in range(count)]
    missing = np.full(found.margins.shape[1], np.nan)
    return Found(
        np.vstack([found.points, point]),
        np.vstack([found.aims, aims]),
        np.append(found.feasible, True),
        np.append(found.cheap, np.nan if cheap is None else cheap),
        np.vstack([found.margins, missing]),
        found.leads,
        found.told,
    )
