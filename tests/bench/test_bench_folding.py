"""Time of folding against the number of vertices; writes results/bench/folding.csv.

`pytest -m bench tests/bench`. No absolute time is asserted: only that the cost grows less than
with the square of the vertices, which a dense or an unordered solution would not keep.
"""

import csv
import math
import resource
import time
from pathlib import Path

import numpy as np
import pytest

from foldshell.folding.fold import SOLVERS, fold_sheet
from foldshell.folding.normal_equations import cholmod
from foldshell.folding.settings import FoldSettings
from foldshell.folding.targets import make_target
from foldshell.pattern.design import design_sheet

pytestmark = pytest.mark.bench
TABLE = Path(__file__).parents[2] / "results" / "bench" / "folding.csv"
FIELDS = ("task", "code", "solver", "vertices", "cpu_s", "wall_s", "rss_mb", "iterations", "value")
SIZES = ((15, 16), (30, 32), (50, 50), (70, 70), (100, 100))
SURFACES = ("paraboloid", "hypar", "arch")


def _case(surface, zigzag, strip):
    target = make_target(surface, 28, 10)
    return design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0), target


def _time(task, solver, sheet, target, settings=None, mode="paper"):
    """Best of three runs for small tasks, one for long ones; `value` is rms over span."""
    settings = settings or FoldSettings()
    best = None
    for _ in range(3):
        cpu, wall = time.process_time(), time.perf_counter()
        shape = SOLVERS[mode](sheet, target, settings)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
        best = min(best, (cpu, wall)) if best else (cpu, wall)
        if wall > 2:
            break
    points = shape.vertices[sheet.grid.zigzag % 2 == 0]
    closest, normals = target.find_closest(points)
    rms = math.sqrt(np.mean(np.einsum("ij,ij->i", normals, points - closest) ** 2)) / target.span
    return {
        "task": task,
        "code": "foldshell",
        "solver": solver,
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
    """Every surface by size; both factorisations; both engines; exact mode at two sizes."""
    rows = []
    for surface in SURFACES:
        rows += [_time(f"fold {surface}", "default", *_case(surface, *size)) for size in SIZES]
    if cholmod:
        monkeypatch.setattr("foldshell.folding.normal_equations.cholmod", None)
        rows += [_time("fold paraboloid", "superlu", *_case("paraboloid", *s)) for s in SIZES[:4]]
        monkeypatch.undo()
    explicit = FoldSettings(engine="averaged_projections")
    rows.append(_time("fold paraboloid", "averaged_projections", *_case("paraboloid", 15, 16),
                      explicit))  # fmt: skip
    for size in ((30, 16), (30, 32)):
        rows.append(_time("exact paraboloid", "default", *_case("paraboloid", *size), mode="exact"))
    exponents = {
        surface: _exponent([r for r in rows if r["task"] == f"fold {surface}"][: len(SIZES)])
        for surface in SURFACES
    }
    for surface, exponent in exponents.items():
        rows.append({"task": f"exponent {surface}", "code": "foldshell", "value": exponent})
        print(f"{surface}: cpu ~ vertices^{exponent:.2f}")
    _write(rows)
    assert max(exponents.values()) < 2.0


def test_checks_are_cheap_beside_folding():
    """Quality with self-intersections on 10 000 vertices must not dwarf the folding itself."""
    sheet, target = _case("paraboloid", 70, 70)
    result = fold_sheet(sheet, target, "paper", FoldSettings())
    solved = _time("fold", "default", sheet, target)
    assert result.seconds < 10 * solved["wall_s"]
