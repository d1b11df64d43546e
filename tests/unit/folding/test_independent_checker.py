"""quality.json against an independent checker that reads folded.npz and the target alone.

Sixty targets: noisy, tilted, off-centre, steep, wavy, anywhere in space; all modes on each.
"""

import json

import numpy as np
import pytest

import fold_checker
from foldshell.folding.files import write_folded, write_quality
from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target
from foldshell.pattern.design import design_sheet
from foldshell.settings.fold import Fold

MODES = ("elastic", "isometric", "exact", "rigid")
QUADRICS = {  # z = c + p x2 + q y2 + r x y, in heights and half spans
    "paraboloid": (1.0, -0.5, -0.5, 0.0),
    "hypar": (0.5, 0.5, -0.5, 0.0),
    "hypar_twist": (0.5, 0.0, 0.0, 0.5),
    "arch": (1.0, -1.0, 0.0, 0.0),
    "arch_strip": (1.0, 0.0, -1.0, 0.0),
}
PLACES = ((0.0, 0.0, 0.0), (14.0, 14.0, 0.0), (-250.0, 1200.0, 35.0), (690e3, 5334e3, 520.0))


def make_surface(number):
    """Vertices and quadrilaterals of mesh target `number`: its kind, noise, tilt and place vary."""
    rng = np.random.default_rng(number)
    span = (5.0, 13.0, 28.0)[number % 3]
    points = int(rng.integers(14, 46))
    margin = (1.0, 1.02, 1.3)[(number // 2) % 3]
    along = margin * span / 2 * np.linspace(-1, 1, points)
    x, y = np.meshgrid(along, along)
    u, v = x / span - rng.uniform(-0.2, 0.2), y / span - rng.uniform(-0.2, 0.2)
    rise = rng.uniform(0.1, 0.35) if number % 7 else 0.9
    shape = (
        rise * np.cos(2.1 * u) * np.cos(2.0 * v),
        rise * (u**2 - v**2),
        rise * 2 * u * v,
        rise * np.cos(2.2 * u) * (1 + 0.1 * v),
        0.05 * np.sin(7 * u) + 0.04 * np.cos(6 * v),
        rise * np.exp(-3 * ((u - 0.15) ** 2 + (v + 0.1) ** 2)),
    )[number % 6]
    tilt = rng.uniform(-0.3, 0.3, 2) * (number % 4 == 1)
    noise = (0.0, 0.0, 0.005, 0.02)[(number // 3) % 4]
    z = span * shape + tilt[0] * x + tilt[1] * y + noise * rng.normal(size=x.shape)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + PLACES[number % 4]
    row = np.arange(points**2).reshape(points, points)
    a, b, c, d = row[:-1, :-1], row[:-1, 1:], row[1:, 1:], row[1:, :-1]
    halves = [np.stack(k, axis=-1).reshape(-1, 3) for k in ((a, b, c), (a, c, d))]
    return vertices, np.vstack(halves), span


def make_case(number, folder):
    """Target of the library, the same for the checker, counts of polylines."""
    counts = ((9, 8), (12, 11), (15, 16))[number % 3]
    if number % 5 == 0:
        name = list(QUADRICS)[number // 5 % 5]
        span, height = ((28.0, 10.0), (13.0, 5.0), (5.0, 5.0))[number // 5 % 3]
        parts = np.array(QUADRICS[name]) * [height, *[height / (span / 2) ** 2] * 3]
        return make_target(name, span, height), fold_checker.Graph(span, tuple(parts)), counts
    vertices, triangles, span = make_surface(number)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]
    path = folder / "target.obj"
    path.write_text("\n".join(lines) + "\n")
    middle = 0.5 * (vertices[:, :2].min(axis=0) + vertices[:, :2].max(axis=0))
    own = fold_checker.Triangulation(vertices, triangles, span, tuple(middle))
    return make_target(str(path), span, 1.0), own, counts


def compare(told, found, target, folder):
    """Names of the measures that differ, with both values."""
    far = max(map(abs, getattr(target, "middle", (0.0, 0.0)))) + target.span
    # Round-off: coordinates of size `far`, sums over some hundred terms, roots of small numbers.
    small = 2e4 * np.spacing(far) / target.span + 1e-12
    limits = {
        "rms_over_span": small, "max_over_span": small, "plan_coverage": 6e-3,
        "edge_strain_max": 40 * small, "edge_strain_rms": 40 * small,
        "angle_defect_max_rad": 100 * small,
        "planarity_max": 40 * small, "planarity_mean": 40 * small, "flipped_folds": 0,
        "self_intersections": 0,
    }  # fmt: skip
    wrong = [
        f"{name}: told {told[name]!r}, found {found[name]!r}"
        for name, limit in limits.items()
        if not abs(told[name] - found[name]) <= limit + 1e-6 * abs(found[name])
    ]
    if "unfold_closure_m" in told:
        one, two = told["unfold_closure_m"], found["unfold_closure_m"]
        floor = 1e-11 + 1e4 * np.spacing(far)  # ways of laying out differ in what they add up
        wrong += [f"unfold_closure_m: {one}, {two}"] if not one <= 20 * two + floor else []
        wrong += [f"unfold_closure_m: {one}, {two}"] if not two <= 20 * one + floor else []
    return wrong


def is_sound(mode, found, far):
    """Whether a sheet may be called ok in a mode, as the checker sees it."""
    sound = found["rms_over_span"] <= 2e-3
    sound &= found["flipped_folds"] == 0 and found["self_intersections"] == 0
    sound &= found["plan_coverage"] > 0.4
    if mode in ("exact", "rigid"):
        sound &= found["unfold_closure_m"] <= 1e-9 + 1e4 * np.spacing(far)
        sound &= found["planarity_max"] <= 1e-8 + 1e3 * np.spacing(far)
    if mode == "isometric":
        sound &= found["edge_strain_max"] <= 1e-10 + 1e3 * np.spacing(far)
    return bool(sound)


def check_target(number, folder):
    """Fold onto one target in all modes; return what is told otherwise than found."""
    target, own, (zigzag, strip) = make_case(number, folder)
    sheet = design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0)
    wrong = []
    for mode in MODES:
        result = fold_sheet(sheet, target, mode, Fold())
        write_folded(folder / "folded.npz", sheet, result)
        write_quality(folder / "quality.json", result)
        told = json.loads((folder / "quality.json").read_text())
        found = fold_checker.measure(folder / "folded.npz", own)
        wrong += [f"{number} {mode} {line}" for line in compare(told, found, own, folder)]
        far = max(map(abs, own.middle)) + own.span
        if told["state"] == "ok" and not is_sound(mode, found, far):
            wrong.append(f"{number} {mode}: ok, but found {found}")
    return wrong


@pytest.mark.parametrize("number", [5, 6, 7, 23])
def test_what_is_told_is_what_is_found(tmp_path, number):
    wrong = check_target(number, tmp_path)
    assert not wrong, "\n".join(wrong)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(60))
def test_what_is_told_is_what_is_found_on_sixty_targets(tmp_path, number):
    wrong = check_target(number, tmp_path)
    assert not wrong, "\n".join(wrong)


def test_the_checker_sees_a_sheet_that_was_changed(tmp_path):
    """One vertex moved after the measures were taken: nearly every one of them differs."""
    target, own, (zigzag, strip) = make_case(6, tmp_path)
    sheet = design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0)
    result = fold_sheet(sheet, target, "exact", Fold())
    write_folded(tmp_path / "folded.npz", sheet, result)
    write_quality(tmp_path / "quality.json", result)
    told = json.loads((tmp_path / "quality.json").read_text())
    with np.load(tmp_path / "folded.npz") as data:
        arrays = dict(data)
    arrays["vertices"][2 * strip + 3] += [0.0, 0.0, 0.02]
    np.savez(tmp_path / "folded.npz", **arrays)
    wrong = compare(told, fold_checker.measure(tmp_path / "folded.npz", own), own, tmp_path)
    named = {line.split(":")[0] for line in wrong}
    assert named >= {"max_over_span", "edge_strain_max", "angle_defect_max_rad", "planarity_max",
                     "unfold_closure_m"}  # fmt: skip
