"""What the graph of panels says about vertices: fans of corners, and lines that run straight on."""

import numpy as np

from foldshell.pattern.panel_graph import Ragged, find_sides, list_half_edges


def list_fans(panels: Ragged) -> tuple[dict[int, list[int]], set[int]]:
    """Return the neighbours around each vertex, counter-clockwise, and the vertices inside.

    Of a vertex on the border the fan begins and ends with its border sides. Where panels meet at a
    vertex in two separate fans the longer one stands. All are numbers of vertices.
    """
    half, _ = list_half_edges(panels)
    first = panels.starts[:-1]
    before = np.arange(-1, len(half) - 1)
    before[first] = panels.starts[1:] - 1
    turns: dict[int, dict[int, int]] = {}
    for (vertex, following), previous in zip(half.tolist(), half[before, 0].tolist(), strict=True):
        turns.setdefault(vertex, {})[following] = previous
    fans, inside = {}, set()
    for vertex, steps in turns.items():
        starts = set(steps) - set(steps.values())
        if not starts:
            inside.add(vertex)
        rows = [_follow(steps, start) for start in (starts or {next(iter(steps))})]
        fans[vertex] = max(rows, key=len)
    return fans, inside


def _follow(steps: dict[int, int], start: int) -> list[int]:
    row, at = [start], steps[start]
    while at != start:
        row.append(at)
        if at not in steps:
            break
        at = steps[at]
    return row


def group_sectors(panels: Ragged) -> list[np.ndarray]:
    """Return rows (d, N, 3) of (vertex, arm, arm) about the vertices inside, by their degree d.

    The second arm of a sector is the first one of the next, counter-clockwise.
    """
    fans, inside = list_fans(panels)
    by_degree: dict[int, list[list[list[int]]]] = {}
    for vertex in sorted(inside):
        arms = fans[vertex]
        rows = [[vertex, a, b] for a, b in zip(arms, arms[1:] + arms[:1], strict=True)]
        by_degree.setdefault(len(arms), []).append(rows)
    return [np.array(by_degree[d]).transpose(1, 0, 2) for d in sorted(by_degree)]


def trace_polylines(panels: Ragged) -> list[list[int]]:
    """Return lines of sides (k,) of vertices that run straight on where they can.

    At a vertex inside of even degree a side goes on into the one opposite in the fan; along the
    border, from corner to corner, at vertices of two panels and more. In a grid these are its
    zig-zags and strips. Closed lines end with the vertex that they begin with.
    """
    fans, inside = list_fans(panels)

    def follow(before: int, at: int) -> int | None:
        """Return the vertex after the side from `before` to `at`."""
        fan = fans[at]
        place = fan.index(before)
        if at in inside:
            return fan[(place + len(fan) // 2) % len(fan)] if len(fan) % 2 == 0 else None
        if len(fan) > 2 and place in (0, len(fan) - 1):
            return fan[-1 - place]
        return None

    sides, _, _ = find_sides(panels)
    left = {tuple(side) for side in sides.tolist()}
    lines = []
    for side in sides.tolist():
        if tuple(side) not in left:
            continue
        left.discard(tuple(side))
        line = list(side)
        for end in (1, 0):
            line = line if end else line[::-1]
            while (after := follow(line[-2], line[-1])) is not None:
                key = (min(line[-1], after), max(line[-1], after))
                if key not in left:
                    break
                left.discard(key)
                line.append(after)
        lines.append(line[::-1])
    return lines


def find_line_chains(panels: Ragged) -> np.ndarray:
    """Return rows (m, 4) of vertices two sides apart along all lines that run straight on."""
    rows = []
    for line in trace_polylines(panels):
        points = line
        if line[0] == line[-1] and len(line) > 8:
            points = line[:-1] + line[:6]
        rows += [points[k : k + 7 : 2] for k in range(len(points) - 6)]
    return np.array(rows, dtype=np.int64).reshape(-1, 4)


def find_families(panels: Ragged) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the family (S,) 0 or 1 of each side of panels, and the sides (S, 2), where all panels
    are quadrilaterals whose opposite sides fall into two families; None for others.

    Opposite sides of a panel are of one family, neighbouring ones of both. All are numbers.
    """
    if not (np.diff(panels.starts) == 4).all():
        return None
    sides, place, _ = find_sides(panels)
    own = place.reshape(-1, 4)
    beside: list[list[tuple[int, int]]] = [[] for _ in range(len(sides))]
    for a, b, c, d in own.tolist():
        for one, two, differ in ((a, c, 0), (b, d, 0), (a, b, 1)):
            beside[one].append((two, differ))
            beside[two].append((one, differ))
    family = np.full(len(sides), -1)
    family[own[0, 0]], queue = 0, [int(own[0, 0])]
    while queue:
        at = queue.pop()
        for other, differ in beside[at]:
            due = family[at] ^ differ
            if family[other] < 0:
                family[other] = due
                queue.append(other)
            elif family[other] != due:
                return None
    return (family, sides) if (family >= 0).all() else None
