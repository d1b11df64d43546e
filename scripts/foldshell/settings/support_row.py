"""One row of a set of supports, and the words for pinned borders."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

AXES = "xyz"
SUPPORTS = ("all", "zigzag", "strip")
"""Words for pinned borders; others name a set of the table of supports."""

PlainRow = dict[str, object]


@dataclass(frozen=True)
class SupportRow:
    """One row: what it holds (`where`, see `read_where`), and how.

    `fix` are those of x, y, z along which it lets nothing move, `clamp` holds the rotation about
    each edge, `spring` is along x, y, z in kN/m per m of edge, in kN/m at vertices.
    """

    name: str
    where: str
    fix: str = AXES
    clamp: bool = False
    spring: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def to_plain(self) -> PlainRow:
        """Return the row as Snakemake's `params` and hashes hold it."""
        return asdict(self) | {"spring": list(self.spring)}


Holding = str | Sequence[SupportRow]
"""The supports of a design: one of `SUPPORTS`, or the rows of a set."""


def from_plain(support: str | Sequence[Mapping]) -> Holding:
    """Return supports from what `params` hold of them: a word, or rows as plain values."""
    if isinstance(support, str):
        return support
    return tuple(SupportRow(**{**row, "spring": tuple(row["spring"])}) for row in support)
