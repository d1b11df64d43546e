"""function_follows_fold.md: what a fold buys and what it costs, written from explorations."""

from collections.abc import Sequence

from foldshell.explore import answer_tables as tables
from foldshell.explore import answer_words as words
from foldshell.explore.answer import Searched
from foldshell.records.rivals import FOUND
from foldshell.records.summary import SummaryRow

TITLE = "# What the fold buys, and what it costs"
RULE = (
    "All shells of a roof (the best design that was found, the row of the table that is the base, "
    "the smooth shell) are sized by one rule, on one mesh, for one limit of the buckling factor: "
    "`optimality`, which takes concrete away while it keeps that factor. The rule of a search may "
    "be another one."
)
CONFIRMED = "The best of each search by its own rule, searched and confirmed:"
FACTORS = (
    "On the mesh of the search (factor reached in brackets): the lightest of all patterns that "
    "were tried, by the rule of the search, and the three shells sized anew for each factor:"
)
STEEL = (
    "The same shells sized for reinforced concrete by the group `sizing` of "
    "`config/reinforced.yaml`, under the combinations of the study's loop; the verdict has "
    "combinations of its own and asks for its own factor."
)


def write_answer(
    searched: Sequence[Searched],
    pictures: Sequence[str],
    summary: Sequence[SummaryRow] = (),
    listed: Sequence[str] = (),
) -> str:
    """Return the answer as Markdown.

    `pictures` are the files of two charts, concrete against buckling factor and against panels;
    `summary` are the rows of the study of the table, where it has been run; `listed` names the
    explorations that are set up, run or not
    """
    parts = [
        _section(TITLE, [_open(searched)]),
        _section("## In short", words.list_short(searched)),
        _section("## What was searched", _describe(searched), _say_missing(searched, listed)),
        *_list_numbers(searched, pictures),
        _section("## What it buys", _say_bought(searched)),
        _section(
            "## What it costs", tables.tabulate_geometry(searched), words.list_costs(searched)
        ),
        _section("## Where limits decide", words.list_limits(searched)),
        _section("## Rows of the table", tables.tabulate_rows(searched, summary)),
        _section("## Read with care", _warn(searched, summary)),
    ]  # fmt: skip
    return "\n".join(line for part in parts for line in part)


def _list_numbers(searched: Sequence[Searched], pictures: Sequence[str]) -> list[list[str]]:
    """Return the sections by measure, with both fronts."""
    front, panels = pictures
    return [
        _section(
            "## By the paper's measure",
            _lead(RULE, tables.tabulate_judged(searched, "paper")),
            _lead(CONFIRMED, tables.tabulate_confirmed(searched)),
        ),
        _section(
            "## Concrete against buckling factor",
            [f"![concrete against buckling factor]({front})", ""],
            _lead(FACTORS, tables.tabulate_factors(searched)),
            words.list_factors_won(searched),
        ),
        _section(
            "## Concrete against panels",
            [f"![concrete against panels]({panels})", ""],
            tables.tabulate_front(searched),
            [_say_panels(searched)],
        ),
        _section(
            "## By the engineering verdict",
            _lead(STEEL, tables.tabulate_judged(searched, "reinforced")),
            tables.tabulate_steel(searched),
        ),
    ]  # fmt: skip


def _section(title: str, *blocks: Sequence[str]) -> list[str]:
    """Return a heading with its lines, nothing where there are none."""
    lines = [line for block in blocks for line in block]
    while lines and not lines[-1]:
        lines.pop()
    return [title, "", *lines, ""] if lines else []


def _lead(text: str, lines: Sequence[str]) -> list[str]:
    """Return a paragraph before a table, nothing without the table."""
    return [text, "", *lines] if lines else []


def _open(searched: Sequence[Searched]) -> str:
    tried = sum(one.tried for one in searched)
    kept = sum(len(one.of(FOUND)) for one in searched)
    return (
        f"{len(searched)} {'roof' if len(searched) == 1 else 'roofs'}, {tried} patterns tried, "
        f"{kept} of them sized within all limits. Written by `snakemake fold_answer` from "
        "explorations that have been run: no number here is typed by hand. How to make it again "
        "stands at the end."
    )


def _describe(searched: Sequence[Searched]) -> list[str]:
    """Return what each exploration varied and kept."""
    lines = []
    for one in searched:
        given = one.about.get("exploration")
        if not given:
            lines.append(f"- {one.title}: {one.tried} patterns tried.")
            continue
        base, search, limits = given["base"], given["search"], given["limits"]
        ranges = ", ".join(
            f"{words.WORDS.get(name, name)} " + (", ".join(choices) or f"{low:g} to {high:g}")
            for name, low, high, _, choices in given["variables"]
        )
        lines.append(
            f"- {one.title} ({one.name}), {base['span_m']:g} m span, {base['height_m']:g} m high: "
            f"{one.tried} patterns, {len(one.of(FOUND))} within all limits; rule "
            f"`{search['rule']}`, n = {search['subdivisions']}, {search['method']}, seed "
            f"{search['seed']}; {ranges}; coverage of the plan at least "
            f"{limits['plan_coverage_min']:g}, strain at most {limits['edge_strain_max']:g}, folds "
            f"{limits['depth_min_m']:g} to {limits['depth_max_m']:g} m deep, buckling factor at "
            f"least {limits['buckling_factor_min']:g}."
        )
    return lines


def _say_missing(searched: Sequence[Searched], listed: Sequence[str]) -> list[str]:
    """Return which explorations are set up and have not been run, or not been compared."""
    missing = sorted(set(listed) - {one.name for one in searched})
    alone = [one.name for one in searched if not one.judged_as("reinforced", FOUND)]
    lines = [f"- **Not run here**: {', '.join(missing)}; nothing is said of these roofs."]
    lines = lines if missing else []
    lines += [
        f"- **{one.name}: {one.unseen} rows of the table were not sized**, so the lightest is not "
        "known."
        for one in searched if one.unseen
    ]  # fmt: skip
    if alone:
        lines.append(f"- **Not sized alike at the ordinary mesh here**: {', '.join(alone)}.")
    return lines


def _say_panels(searched: Sequence[Searched]) -> str:
    aimed = [one for one in searched
             if "panels" in one.about.get("exploration", {}).get("aims", ())]  # fmt: skip
    if len(aimed) == len(searched):
        return "These searches aimed at few panels as well."
    return (
        f"{len(aimed)} of {len(searched)} of these searches aimed at few panels: of the others "
        "this front is that of designs that were tried for their concrete, and a search with the "
        "aims `volume_m3` and `panels` may find better ones."
    )


def _say_bought(searched: Sequence[Searched]) -> list[str]:
    lines = words.list_bought(searched)
    return ["The found pattern against the smooth shell, sized alike:", "", *lines] if lines else []


def _warn(searched: Sequence[Searched], summary: Sequence[SummaryRow]) -> list[str]:
    """Return what the numbers do not say."""
    lines = [
        "- Points of the charts and the table of factors are of the search's mesh; the tables by "
        "measure are of the ordinary mesh, with the mesh error that the rules find.",
        "- A smooth shell has no folds and is not flat anywhere: formwork, panels that come flat "
        "from a sheet, joints and the work of folding have no price here.",
        "- Folds are rigid joints; shear and punching beside folds hang on the mesh "
        "([docs/concrete.md](concrete.md)).",
    ]
    if not summary:
        lines.append(
            "- The study of the table has not been run in these results: `snakemake --config "
            "study=table1` adds its rows by both verdicts."
        )
    names = " ".join(one.name for one in searched)
    return [
        *lines, "", "Made by", "", "```bash", f"for name in {names}; do",
        "  snakemake --cores 2 explore beside --config exploration=config/explorations/$name.yaml",
        "done", "snakemake --cores 2 --config study=table1", "snakemake --cores 2 fold_answer",
        "```",
    ]  # fmt: skip
