"""Crease patterns that are no Miura grid: accordion, fan, Yoshimura, waterbomb, Resch.

Each is flat, in m, sized so that it covers a target's central sections once its folds have taken up
what the pattern takes up; mountains and valleys as seen from above, angles in rad.
"""

import itertools
import math
from collections.abc import Callable

import numpy as np

from foldshell.pattern.panel_graph import find_sides, make_ragged
from foldshell.pattern.panel_mesh import PanelMesh

Rule = Callable[[int, int], tuple[str, float]]
FULL_TURN = 2 * math.pi


def build_flat(
    points: np.ndarray,
    panels: list[list[int]],
    rule: Rule,
    attract: np.ndarray | None = None,
    rows: list[tuple[int, int]] | None = None,
    free_border: bool = False,
) -> PanelMesh:
    """Build a flat pattern of points (V, 2) m and panels, counter-clockwise.

    `rule` gives letter and fold angle (rad, nan for unknown) of the side between two vertices
    inside; `attract` (N,) are vertices drawn to a target, `rows` row and place of each panel.
    """
    used, corners = np.unique(np.concatenate(panels), return_inverse=True)
    sizes = np.cumsum([0, *(len(panel) for panel in panels)])
    ragged = make_ragged([corners[a:b] for a, b in itertools.pairwise(sizes)])
    edges, _, number = find_sides(ragged)
    folds = [("B", math.nan) if count == 1 else rule(*used[edge].tolist())
             for edge, count in zip(edges, number.tolist(), strict=True)]  # fmt: skip
    flat = np.column_stack([points[used], np.zeros(len(used))])
    sets = {}
    if attract is not None:
        sets["attract"] = np.flatnonzero(np.isin(used, attract))
    if free_border:
        sets["free_border"] = np.unique(edges[number == 1])
    labels = {}
    if rows:
        row, place = np.array(rows, dtype=np.int64).T
        labels = {"row": row, "place": place}
    return PanelMesh(
        ragged, edges, np.array([letter for letter, _ in folds]),
        np.array([angle for _, angle in folds]), flat=flat, labels=labels, sets=sets,
    )  # fmt: skip


def make_accordion(
    lengths: tuple[float, float], rows: int, folds: int, fold_angle: float = math.radians(40)
) -> PanelMesh:
    """Prismatic folded plate: `folds` straight lines along y, mountains and valleys in turn.

    Panels stand at `fold_angle` [rad] to the plane; `rows` lines across cut them, which stay flat.
    """
    x = np.arange(folds) * lengths[0] / ((folds - 1) * math.cos(fold_angle))
    y = np.linspace(0, lengths[1], rows)
    points = np.array([(a, b) for b in y for a in x])

    def rule(one: int, two: int) -> tuple[str, float]:
        """Return letter and angle of a side; even lines are valleys, the first one is border."""
        if one % folds != two % folds:
            return "F", 0.0
        sign = 1.0 if one % folds % 2 == 0 else -1.0
        return ("V" if sign > 0 else "M"), sign * 2 * fold_angle

    panels, places = _grid_panels(rows, folds)
    even = np.flatnonzero(np.arange(rows * folds) % folds % 2 == 0)
    return build_flat(points, panels, rule, even, places)


def _grid_panels(rows: int, columns: int) -> tuple[list[list[int]], list[tuple[int, int]]]:
    places = [(i, j) for i in range(rows - 1) for j in range(columns - 1)]
    first = [i * columns + j for i, j in places]
    return [[k, k + 1, k + columns + 1, k + columns] for k in first], places


def make_fan(
    lengths: tuple[float, float],
    rings: int,
    spokes: int,
    opening: float = math.radians(120),
    inner: float = 0.3,
    zigzag: float = 0.8,
) -> PanelMesh:
    """Radial Miura: zig-zag rings between straight spokes, over an `opening` [rad].

    Even rings are valleys, odd ones mountains; along spokes signs alternate, as in a Miura sheet.
    `inner` is the inner radius over the outer one, `zigzag` how far a ring swings, in widths of a
    panel there, at most as far as the next ring.
    """
    outer = min(lengths) / (1.6 if opening > math.pi else 1.3)
    radius = outer * np.linspace(inner, 1.0, rings)
    step = opening / (spokes - 1)
    swing = np.minimum(zigzag * radius * step, 0.6 * (radius[1] - radius[0]))
    number = np.arange(rings * spokes)
    i, j = np.divmod(number, spokes)
    reach = radius[i] + np.where(j % 2 == 1, swing[i], 0.0)
    angle = math.pi / 2 - opening / 2 + j * step
    points = np.column_stack([reach * np.cos(angle), reach * np.sin(angle)])

    def rule(one: int, two: int) -> tuple[str, float]:
        """Return the letter of a side, as a Miura sheet has it."""
        low = min(one, two)
        row, column = low // spokes, low % spokes
        across = one // spokes == two // spokes
        parity = row if across else row + column + 1
        return ("V" if parity % 2 == 0 else "M"), math.nan

    panels, places = _grid_panels(rings, spokes)
    panels = [row[::-1] for row in panels]
    even = np.flatnonzero(i % 2 == 0)
    return build_flat(points, panels, rule, even, places, free_border=True)


def make_yoshimura(
    lengths: tuple[float, float], rows: int, columns: int, take_up: float = 0.93
) -> PanelMesh:
    """Diamonds, `rows` rows of triangles over `columns` of them: folds to a vault curved along x.

    Lines along x are valleys, diagonals mountains; all vertices lie on the vault. `take_up` is the
    share of its length along y that is left once it is folded.
    """
    width, height = lengths[0] / columns, lengths[1] / rows / take_up
    lines = []
    for i in range(rows + 1):
        inside = np.arange(columns + 1) if i % 2 == 0 else np.arange(columns) + 0.5
        lines.append(np.concatenate([[0], inside, [columns]]) if i % 2 else inside.astype(float))
    first = np.cumsum([0, *(len(line) for line in lines)])
    points = np.array([(x * width, i * height) for i, line in enumerate(lines) for x in line])
    panels, places = [], []
    for i in range(rows):
        row = _zip_lines(lines[i], lines[i + 1], first[i], first[i + 1])
        panels += row
        places += [(i, k) for k in range(len(row))]
    row_of = np.repeat(np.arange(rows + 1), np.diff(first))

    def rule(one: int, two: int) -> tuple[str, float]:
        """Return the letter of a side."""
        return ("V" if row_of[one] == row_of[two] else "M"), math.nan

    return build_flat(points, panels, rule, np.arange(len(points)), places)


def _zip_lines(low: np.ndarray, high: np.ndarray, first: int, second: int) -> list[list[int]]:
    """Triangles between two lines of points by their x, from left to right."""
    a, b, panels = 0, 0, []
    while a < len(low) - 1 or b < len(high) - 1:
        ahead_low = low[a + 1] if a < len(low) - 1 else np.inf
        ahead_high = high[b + 1] if b < len(high) - 1 else np.inf
        if ahead_low < ahead_high or (ahead_low == ahead_high and len(low) < len(high)):
            panels.append([first + a, first + a + 1, second + b])
            a += 1
        else:
            panels.append([first + a, second + b + 1, second + b])
            b += 1
    return panels


def make_waterbomb(
    lengths: tuple[float, float], rows: int, columns: int, take_up: float = 0.85
) -> PanelMesh:
    """Waterbomb tessellation: `rows` rows of `columns` bases, each row set off by half of one.

    Diagonals of a base are valleys, all other lines mountains; corners of the bases are drawn to
    the target, their middles are free. `take_up` is the share of its size that is left once folded.
    """
    width = lengths[0] / take_up / (2 * columns)
    height = lengths[1] / take_up / (2 * rows)
    number: dict[tuple[int, int], int] = {}

    def at(x: int, y: int) -> int:
        """Return the number of a vertex by its place, a new one where it is met first."""
        return number.setdefault((x, y), len(number))

    panels, places = [], []
    for i in range(rows):
        shift = i % 2
        for k in range(-shift, columns):
            x, y = 2 * k + shift, 2 * i
            middle = at(x + 1, y + 1)
            base = [
                (x, y), (x + 1, y), (x + 2, y), (x + 2, y + 2), (x + 1, y + 2), (x, y + 2),
            ]  # fmt: skip
            for n, start in enumerate(base):
                end = base[(n + 1) % 6]
                corners = [start, end, (x + 1, y + 1)]
                if all(0 <= c[0] <= 2 * columns for c in corners):
                    panels.append([at(*start), at(*end), middle])
                    places.append((i, 6 * (k + shift) + n))
    points = np.array([(x * width, y * height) for x, y in number])
    middles = {n for (x, y), n in number.items() if y % 2 == 1}
    cell = np.array(list(number))

    def rule(one: int, two: int) -> tuple[str, float]:
        """Return the letter of a side: diagonals run both ways."""
        diagonal = (cell[one] != cell[two]).all()
        return ("V" if diagonal else "M"), math.nan

    outer = np.array([n for n in range(len(number)) if n not in middles])
    return build_flat(points, panels, rule, outer, places)


def make_resch(
    lengths: tuple[float, float], rows: int, columns: int, take_up: float = 0.75
) -> PanelMesh:
    """Resch's triangles: equilateral panels on the surface, star-shaped tucks between them.

    On a lattice of triangles those that point up are panels or, every third, tucks: three short
    creases run from the middle of a tuck to its corners and three long ones to the tips across its
    sides, and all that points down is parted by these. Panels lie on the target, middles hang
    below. `rows` and `columns` of lattice triangles; `take_up` is the share of its size that is
    left once it is folded.
    """
    closed = 1 / math.sqrt(3)
    share = min(max((1 - take_up) / (1 - closed), 0.05), 0.95)
    side = lengths[0] / take_up / (columns + 0.5)
    height = lengths[1] / take_up / rows
    at = {(i, j): i * (columns + 2) + j for i in range(rows + 1) for j in range(columns + 2)}
    place = [((j + 0.5 * (i % 2) - 0.5) * side, i * height)
             for i in range(rows + 1) for j in range(columns + 2)]  # fmt: skip
    panels, tucks = _lay_lattice(rows, columns, at, np.array(place))
    points = np.vstack([place, [middle for middle, _, _ in tucks]])
    stars = []
    walls = {tuple(sorted((p[k], p[k - 1]))) for p in panels for k in range(3)}
    for n, (_, corners, tips) in enumerate(tucks):
        for k, tip in enumerate(tips):
            ends = corners[k], corners[(k + 1) % 3]
            if any(tuple(sorted((tip, end))) in walls for end in ends):
                middle = len(place) + n
                stars += [[ends[0], tip, middle], [tip, ends[1], middle]]
    count = len(place)
    corner_spokes = {(c, count + n) for n, (_, corners, _) in enumerate(tucks) for c in corners}
    angles = {"wall": -math.pi / 2, "long": math.pi, "short": -math.pi / 3}

    def rule(one: int, two: int) -> tuple[str, float]:
        """Return letter and angle of a side: wall of a tuck, or crease from its middle."""
        low, high = sorted((one, two))
        kind = "wall" if high < count else "short" if (low, high) in corner_spokes else "long"
        return ("V" if kind == "long" else "M"), share * angles[kind]

    return build_flat(points, [*panels, *stars], rule, np.arange(count))


def _lay_lattice(
    rows: int, columns: int, at: dict[tuple[int, int], int], place: np.ndarray
) -> tuple[list[list[int]], list[tuple[np.ndarray, list[int], list[int]]]]:
    """Panels, and tucks as middle, corners and tips, of a lattice of triangles.

    Corners and tips run counter-clockwise in turn. Tucks without all three tips are left out, and
    panels that no tuck joins to others.
    """
    ups, tucks = [], []
    for i in range(rows):
        for j in range(columns + 1):
            odd = i % 2
            corners = [at[i, j], at[i, j + 1], at[i + 1, j + odd]]
            if (j - i // 2 - i) % 3:  # of the three colours of triangles that point up
                ups.append(corners)
                continue
            beyond = (i - 1, j + odd), (i + 1, j + 1 + odd), (i + 1, j - 1 + odd)
            if all(tip in at for tip in beyond):
                tucks.append((place[corners].mean(axis=0), corners, [at[tip] for tip in beyond]))
    walls = {tuple(sorted((c, t))) for _, corners, tips in tucks for k, c in enumerate(corners)
             for t in (tips[k], tips[k - 1])}  # fmt: skip
    kept = [
        c for c in ups
        if sum(tuple(sorted((c[k], c[(k + 1) % 3]))) in walls for k in range(3)) >= 2
    ]  # fmt: skip
    return kept, tucks
