"""The sentences of the answer; every one follows from numbers of the explorations."""

from collections.abc import Callable, Iterator, Sequence

from foldshell.explore.answer import Point, Searched, choose_point
from foldshell.explore.bounds import AT_BOUND
from foldshell.records.candidate import SIZED
from foldshell.records.rivals import FOUND, SMOOTH, TABLE, JudgedRow, ResizedRow

NAMES = {FOUND: "the found pattern", TABLE: "the row of the table that is the base",
         SMOOTH: "the smooth shell"}  # fmt: skip
WORDS = {"rest_fold_angle_deg": "rest fold angle", "sector_angle_deg": "sector angle",
         "strip_grading": "grading of strips", "zigzag": "zig-zag lines", "strip": "strip lines",
         "height_m": "height", "span_m": "span"}  # fmt: skip
ALIKE = 0.01
"""Relative difference within which two numbers count as alike; that of meshes is larger."""
THIN = 1.02
"""Mean thickness over the least one up to which a shell counts as thin nearly everywhere."""
Value = Callable[[JudgedRow], float | None]


def compare(
    searched: Sequence[Searched], measure: str, rival: str, value: Value
) -> Iterator[tuple[str, float]]:
    """Yield each roof with its found design over a rival in what `value` gives, less 1."""
    for one in searched:
        found, other = (one.judged_as(measure, kind) for kind in (FOUND, rival))
        first, second = (row and value(row) for row in (found, other))
        if first and second:
            yield one.title, first / second - 1


def compare_covered(searched: Sequence[Searched], measure: str) -> Iterator[tuple[str, float]]:
    """Yield each roof with the concrete of found over smooth shell for each m2 of covered plan."""
    for one in searched:
        rows = [one.judged_as(measure, kind) for kind in (FOUND, SMOOTH)]
        points = [choose_point(one, kind) for kind in (FOUND, SMOOTH)]
        if all(rows) and all(point and point.coverage for point in points):
            found, smooth = (
                row.volume_m3 / point.coverage for row, point in zip(rows, points, strict=True)
            )
            yield one.title, found / smooth - 1


def compare_factors(
    searched: Sequence[Searched], factor: float, covered: bool
) -> Iterator[tuple[str, float]]:
    """Yield each roof with the concrete of the fold over that of the smooth shell for one factor.

    The fold is the lightest that was tried or the best sized anew; `covered`: for each m2 of plan
    that is covered.
    """
    for one in searched:
        tried, anew = one.lightest(factor), one.resized_for(FOUND, factor)
        smooth, whole = one.resized_for(SMOOTH, factor), choose_point(one, SMOOTH)
        rows = [(tried.volume, tried)] if tried else []
        rows += [(anew.volume_m3, one.point_of(anew.candidate))] if anew else []
        shares = [point.coverage if covered and point.coverage else 1.0 for _, point in rows]
        volumes = [volume / share for (volume, _), share in zip(rows, shares, strict=True)]
        if volumes and smooth:
            share = (covered and whole and whole.coverage) or 1.0
            yield one.title, min(volumes) * share / smooth.volume_m3 - 1


def list_factors(searched: Sequence[Searched]) -> list[str]:
    """Return the fold against the smooth shell for each factor but those of single designs."""
    given = {row.factor_due for one in searched for row in one.resized}
    lines = []
    for factor in sorted(given - {find_own_factor(one) for one in searched}):
        if pairs := list(compare_factors(searched, factor, False)):
            more = say_changes(list(compare_factors(searched, factor, True)))
            lines.append(
                f"- **At a buckling factor of {factor:g}, on the mesh of the search, against "
                f"{NAMES[SMOOTH]}**: concrete {count_less(pairs)} ({say_changes(pairs)}); for each "
                f"m² of plan that is covered {more}."
            )
    return lines


def find_own_factor(one: Searched) -> float | None:
    """Return the factor that shells were sized for since the best of the search has it."""
    found = [point.factor for row in one.resized if (point := one.point_of(row.candidate))
             and row.kind == FOUND]  # fmt: skip
    factors = [row.factor_due for row in one.resized if row.factor_due % 1]
    return next((due for due in factors if found and abs(due - found[0]) < 0.01), None)


def say_changes(pairs: Sequence[tuple[str, float]]) -> str:
    """Return ratios in words, the least first: roof and per cent."""
    ordered = sorted(pairs, key=lambda pair: (pair[1], pair[0]))
    return "; ".join(f"{title} {100 * change:+.0f} %" for title, change in ordered)


def count_less(pairs: Sequence[tuple[str, float]]) -> str:
    """Return how many are less, alike, more: "less on 3 of 6 roofs, alike on 1, more on 2"."""
    less = sum(change < -ALIKE for _, change in pairs)
    more = sum(change > ALIKE for _, change in pairs)
    words = [f"less on {less} of {len(pairs)} {'roof' if len(pairs) == 1 else 'roofs'}"]
    alike = len(pairs) - less - more
    words += [f"alike (within {100 * ALIKE:g} %) on {alike}"] * bool(alike)
    return ", ".join([*words, *([f"more on {more}"] * bool(more))])


def list_short(searched: Sequence[Searched]) -> list[str]:
    """Return the answer in a few sentences: concrete by both measures, against both rivals."""
    lines = []
    for measure, words in (
        ("paper", "By the paper's measure"), ("reinforced", "With reinforcement"),
    ):  # fmt: skip
        for rival in (TABLE, SMOOTH):
            if pairs := list(compare(searched, measure, rival, lambda row: row.volume_m3)):
                lines.append(
                    f"- **{words}, against {NAMES[rival]}**: concrete {count_less(pairs)} "
                    f"({say_changes(pairs)})."
                )
        if pairs := list(compare_covered(searched, measure)):
            lines.append(
                f"- {words}, for each m² of plan that is covered, against {NAMES[SMOOTH]}: "
                f"concrete {count_less(pairs)} ({say_changes(pairs)})."
            )
    alone = lines or ["- Nothing has been sized alike at the ordinary mesh yet."]
    factors = list_factors(searched)
    return [*list_lightest(searched), *factors, *alone, *list_verdicts(searched)]


def list_lightest(searched: Sequence[Searched]) -> list[str]:
    """Return what the searches found beside the lightest row of the table, by their own rule."""
    pairs = []
    for one in searched:
        rows, found = one.of(TABLE), one.of(FOUND)
        rows = [point for point in rows if not point.edge_beam and point.state == SIZED]
        if rows and found and not one.unseen:
            pairs.append((one.title, found[0].volume / rows[0].volume - 1))
    words = (
        "- **On the mesh and by the rule of each search, against the lightest row of the table**"
    )
    return [f"{words}: concrete {count_less(pairs)} ({say_changes(pairs)})."] if pairs else []


def list_verdicts(searched: Sequence[Searched]) -> list[str]:
    """Return how many shells pass the engineering verdict, by the measure they were sized by."""
    lines = []
    for measure, words in (
        ("paper", "Sized by the paper's measure"), ("reinforced", "Sized with reinforcement"),
    ):  # fmt: skip
        counts = []
        for kind in (FOUND, TABLE, SMOOTH):
            rows = [row for one in searched if (row := one.judged_as(measure, kind))]
            passed = sum(row.engineering == "passes" for row in rows)
            counts += [f"{passed} of {len(rows)} {NAMES[kind].removeprefix('the ')}"] * bool(rows)
        if counts:
            lines.append(f"- {words}, the engineering verdict is passed by {', '.join(counts)}.")
    return lines


def list_factors_won(searched: Sequence[Searched]) -> list[str]:
    """Return, for each roof, at which buckling factors the fold or the smooth shell is lighter."""
    lines = []
    for one in searched:
        words: dict[str, list[str]] = {}
        for factor in sorted({row.factor_due for row in one.resized}):
            if not all(one.was_sized(kind, factor) for kind in (FOUND, SMOOTH)):
                continue
            found = [one.lightest(factor), one.resized_for(FOUND, factor)]
            volumes = [find_volume(row) for row in found if row]
            smooth = one.resized_for(SMOOTH, factor)
            winner = _name_winner(min(volumes, default=None), smooth and smooth.volume_m3)
            words.setdefault(winner, []).append(f"{factor:g}")
        if words:
            parts = [f"{winner} at a factor of {', '.join(f)}" for winner, f in words.items()]
            lines.append(f"- {one.title}: {'; '.join(parts)}.")
    return lines


def find_volume(row: Point | ResizedRow) -> float:
    """Return the concrete (m3) of a design that was tried, or of one that was sized anew."""
    return row.volume if isinstance(row, Point) else row.volume_m3


def _name_winner(found: float | None, smooth: float | None) -> str:
    if not (found and smooth):
        kept = "the found pattern" if found else "the smooth shell" if smooth else "neither"
        return f"only {kept} keeps its factor" if found or smooth else "neither keeps its factor"
    ratio = found / smooth
    if abs(ratio - 1) <= ALIKE:
        return "both are alike"
    winner = "the fold is lighter" if ratio < 1 else "the smooth shell is lighter"
    return f"{winner} ({100 * (min(ratio, 1 / ratio) - 1):.0f} %)"


def list_bought(searched: Sequence[Searched]) -> list[str]:
    """Return what else differs from the smooth shell at the limit of the search: less or more."""
    asked = (
        ("paper", "buckling factor, both sized for the limit of the search",
         lambda row: row.buckling_factor_min),
        ("paper", "vertical displacement", lambda row: row.displacement_vertical_max_m),
        ("reinforced", "concrete with reinforcement", lambda row: row.volume_m3),
        ("reinforced", "steel", lambda row: row.steel_kg),
        ("reinforced", "CO₂ of concrete, steel and folds", lambda row: row.co2_kg),
    )  # fmt: skip
    lines = []
    for measure, words, value in asked:
        if pairs := list(compare(searched, measure, SMOOTH, value)):
            lines.append(f"- {words}: {count_less(pairs)} ({say_changes(pairs)}).")
    return lines


def list_costs(searched: Sequence[Searched]) -> list[str]:
    """Return what the fold takes that a smooth shell does not: sheet, folds, shear."""
    lines, sheets, covered, folds, shear = [], [], [], [], []
    for one in searched:
        found, smooth = (choose_point(one, kind) for kind in (FOUND, SMOOTH))
        if found and smooth and smooth.area:
            sheets.append((one.title, found.area / smooth.area - 1))
        if found and smooth and found.coverage and smooth.coverage:
            shares = f"{100 * found.coverage:.1f} %, {100 * smooth.coverage:.1f} %"
            covered.append(f"{one.title} {shares}")
        if found:
            folds.append(f"{one.title} {found.creases:.0f} m in {found.panels} panels")
        rows = [one.judged_as("reinforced", kind) for kind in (FOUND, TABLE, SMOOTH)]
        if all(row and row.shear_share is not None for row in rows):
            shares = ", ".join(f"{100 * row.shear_share:.0f} %" for row in rows)
            shear.append(f"{one.title} {shares}")
    if sheets:
        lines.append(f"- Area of the sheet over that of the smooth shell: {say_changes(sheets)}.")
    if covered:
        lines.append(f"- Plan covered (found, smooth shell): {'; '.join(covered)}.")
    if folds:
        lines.append(f"- Folds to make: {'; '.join(folds)}.")
    if shear:
        lines.append(
            "- Panels whose shear is over v_Rd,c after sizing with reinforcement (found, base in "
            f"the table, smooth): {'; '.join(shear)}."
        )
    return lines


def list_limits(searched: Sequence[Searched]) -> list[str]:
    """Return where something other than the structure decides: ends of ranges, least thickness."""
    lines, thin = [], []
    for one in searched:
        if bounds := one.about.get("bounds"):
            words = ", ".join(f"{WORDS.get(name, name)} at {end:g}" for name, end in bounds)
            lines.append(f"- {one.title}: the best stands at the end of a range: {words}.")
        row, point = next(iter(one.resized_as(FOUND)), None), choose_point(one, FOUND)
        least = one.about.get("least_thickness_m")
        if row and point and least and row.volume_m3 < THIN * least * point.area:
            thin.append(one.title)
    if lines:
        lines.append(
            f"- A value counts as at the end within {100 * AT_BOUND:g} % of the range: the limit "
            "that was set decides there, not the structure."
        )
    if thin:
        lines.append(
            f"- Nearly all panels stand at the least thickness on {len(thin)} of {len(searched)} "
            f"roofs ({'; '.join(thin)}): concrete is the area of the sheet times that thickness "
            "there, and a search can only save area."
        )
    return lines or ["- No best design stands at the end of a range or at the least thickness."]
