"""Time of folding against the number of vertices; writes results/bench/folding.csv.

`pytest -m bench tests/bench`. No absolute time is asserted: only that the cost grows less than
with the square of the vertices, which a dense or an unordered solution would not keep.
"""

import csv
import resource
import time
from pathlib import Path

import numpy as np
import pytest

from foldshell.folding.fold import SOLVERS, fold_sheet
from foldshell.folding.normal_equations import cholmod
from foldshell.folding.quality import root_mean_square
from foldshell.folding.targets import make_target
from foldshell.folding.terms import measure_distances
from foldshell.pattern.design import design_sheet
from foldshell.settings.fold import Fold

pytestmark = pytest.mark.bench
TABLE = Path(__file__).parents[2] / "results" / "bench" / "folding.csv"
FIELDS = (
    "task", "code", "solver", "surface", "vertices", "cpu_s", "wall_s", "rss_mb", "iterations",
    "value", "exponent",
)  # fmt: skip
SIZES = ((15, 16), (30, 32), (50, 50), (70, 70), (100, 100))
SURFACES = ("paraboloid", "hypar", "arch")
DEFAULT = "cholmod" if cholmod else "superlu"


def _case(surface, zigzag, strip):
    target = make_target(surface, 28, 10)
    return design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0), target


def _time(solver, sheet, target, settings=None, mode="elastic"):
    """Best of three runs for small tasks, one for long ones; `value` is rms over span."""
    settings = settings or Fold()
    best = None
    for _ in range(3):
        cpu, wall = time.process_time(), time.perf_counter()
        shape = SOLVERS[mode](sheet, target, settings)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
        best = min(best, (cpu, wall)) if best else (cpu, wall)
        if wall > 2:
            break
    points = shape.vertices[sheet.grid.zigzag_index % 2 == 0]
    rms = root_mean_square(measure_distances(points, target)) / target.span
    return {
        "task": "exact" if mode == "exact" else "fold",
        "code": "foldshell",
        "solver": solver,
        "surface": target.name,
        "vertices": len(shape.vertices),
        "cpu_s": round(best[0], 4),
        "wall_s": round(best[1], 4),
        "rss_mb": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, 1),
        "iterations": shape.iterations,
        "value": rms,
    }


def _exponent(rows):
    """Slope of log time over log vertices."""
    size, cost = (np.log([row[key] for row in rows]) for key in ("vertices", "cpu_s"))
    return float(np.polyfit(size, cost, 1)[0])


def _write(rows):
    TABLE.parent.mkdir(parents=True, exist_ok=True)
    with TABLE.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, FIELDS)
        writer.writeheader()
        writer.writerows(rows)


def test_cost_of_folding(monkeypatch):
    """Every surface by size; both factorisations; both engines; exact mode at three sizes."""
    series = [[_time(DEFAULT, *_case(surface, *size)) for size in SIZES] for surface in SURFACES]
    exact = ((15, 16), (30, 16), (30, 32))
    series.append([_time(DEFAULT, *_case("paraboloid", *size), mode="exact") for size in exact])
    if cholmod:
        monkeypatch.setattr("foldshell.folding.normal_equations.cholmod", None)
        series.append([_time("superlu", *_case("paraboloid", *size)) for size in SIZES[:4]])
        monkeypatch.undo()
    for rows in series:
        exponent = _exponent(rows)
        for row in rows:
            row["exponent"] = round(exponent, 3)
        names = " ".join(rows[0][key] for key in ("task", "surface", "solver"))
        print(f"{names}: cpu ~ vertices^{exponent:.2f}")
    explicit = Fold(engine="averaged_projections")
    series.append([_time("averaged_projections", *_case("paraboloid", 15, 16), explicit)])
    _write([row for rows in series for row in rows])
    assert max(rows[0]["exponent"] for rows in series[:-1]) < 2.0


def test_checks_are_cheap_beside_folding():
    """Quality with self-intersections on 10 000 vertices must not dwarf the folding itself."""
    sheet, target = _case("paraboloid", 70, 70)
    result = fold_sheet(sheet, target, "elastic", Fold())
    solved = _time(DEFAULT, sheet, target)
    assert result.seconds < 10 * solved["wall_s"]
