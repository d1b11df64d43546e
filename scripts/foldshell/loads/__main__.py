"""Print rows of the load table: `PYTHONPATH=scripts python -m foldshell.loads vault_snow ...`."""

import argparse
import sys
from collections.abc import Sequence

from foldshell.files.errors import InputError, user_errors
from foldshell.loads import presets
from foldshell.settings.load_rows import AREAS, VALUE_COLUMNS, LoadRow
from foldshell.settings.load_table import COLUMNS


def write_rows(name: str, rows: Sequence[LoadRow]) -> str:
    """Return the rows of a set as lines of the table, below a header."""
    lines = ["\t".join(COLUMNS)]
    for row in rows:
        column = next(key for key, kind in VALUE_COLUMNS.items() if kind == row.kind)
        cells = vars(row) | {"set": name, column: "" if row.value is None else f"{row.value:.9g}"}
        lines.append("\t".join(str(cells.get(key, "")) for key in COLUMNS))
    return "\n".join(lines) + "\n"


def main(words: Sequence[str]) -> None:
    """Print the rows that a preset makes of its numbers."""
    given = _parser().parse_args(words)
    try:
        rows = _make_rows(given)
    except ValueError as error:
        raise InputError(f"{given.preset}: {error}") from None
    print(write_rows(given.set, rows), end="")


def _make_rows(given: argparse.Namespace) -> list[LoadRow]:
    shape = given.case, given.rise, given.span
    if given.preset == "vault_wind":
        return presets.make_vault_wind(*shape, given.wall, given.pressure, given.axis)
    if given.preset == "dome_wind":
        return presets.make_dome_wind(*shape, given.pressure, given.cpe, given.axis)
    if given.preset == "vault_snow":
        return presets.make_vault_snow(*shape, given.snow, given.axis)
    return presets.make_half_span(given.case, given.live, given.area, given.axis)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m foldshell.loads", description=__doc__)
    kinds = parser.add_subparsers(dest="preset", required=True)
    for name, case, sizes in (
        ("vault_wind", "W", ("rise", "span", "wall", "pressure")),
        ("dome_wind", "W", ("rise", "span", "pressure")),
        ("vault_snow", "SNOW", ("rise", "span", "snow")),
        ("half_span", "LL", ("live",)),
    ):
        one = kinds.add_parser(name)
        one.add_argument("--set", default="own", help="name of the set")
        one.add_argument("--case", default=case, help="name of the case, to which ends are added")
        one.add_argument("--axis", choices=("x", "y"), default="x", help="across the crown")
        for size in sizes:
            one.add_argument(f"--{size}", type=float, required=True, help="m or kN/m2")
        one.set_defaults(rise=0.0, span=0.0)
        if name == "dome_wind":
            one.add_argument("--cpe", type=float, nargs=3, required=True, help="of A, B and C")
        if name == "half_span":
            one.add_argument("--area", choices=AREAS, default="plan_up")
    return parser


if __name__ == "__main__":
    with user_errors():
        main(sys.argv[1:])
