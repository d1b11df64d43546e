"""written.json: what the workflow wrote into the workbook beside it."""

from dataclasses import dataclass

from foldshell.records.entry import entry


@dataclass(frozen=True, kw_only=True)
class WrittenRecord:
    """The contents of written.json: a workbook that differs was changed by a person."""

    sha256: str = entry("SHA-256 of the bytes of thickness.xlsx as it was written")
    thickness_m: tuple[float, ...] | None = entry(
        "thickness of each panel as it was written", "m", left_out=True
    )
    limits: dict[str, tuple[float | None, ...]] | None = entry(
        "columns fixed (0 or 1), least and largest (m) and group as they were written, null for "
        "empty cells; left out where all are",
        left_out=True,
    )
