"""Drawings, and files for other programs; lengths in m."""

from foldshell.settings.field import Group, setting, settings_group

FORMATS = (
    "3dm", "ifc", "saf", "s2k", "inp", "opensees", "obj", "stl", "ply", "glb", "vtu", "fold",
    "panels", "nesting",
)  # fmt: skip


@settings_group
class Drawings(Group):
    """Drawings of patterns and panels, DXF and SVG."""

    preset: str = setting(
        "fold", choices=("fold", "paper", "laser"),
        meaning="Colours and layers. fold, as tools that fold read them: red mountains, blue "
        "valleys, black border; paper, green mountains and red valleys; laser, a red layer CUT for "
        "the border, blue mountains and green valleys.",
    )  # fmt: skip
    scale: float = setting(
        1, minimum=0.001, maximum=10,
        meaning="Length in the drawing over the true one, 0.02 for 1:50; 1 is full size.",
    )  # fmt: skip


@settings_group
class Exports(Group):
    """Files for other programs, made by `snakemake export`."""

    formats: tuple[str, ...] = setting(
        FORMATS, choices=FORMATS,
        meaning="What is written; docs/exports.md says what each one holds.",
    )  # fmt: skip
    sheet_length: float = setting(
        12, unit="m", above=0, maximum=100,
        meaning="Length of the sheets that panels are cut from.",
    )  # fmt: skip
    sheet_width: float = setting(
        3, unit="m", above=0, maximum=100, meaning="Width of those sheets."
    )
    nesting_seconds: int = setting(
        20, unit="s", minimum=1, maximum=3600,
        meaning="Time of a processor that the nesting of a design may take.",
    )  # fmt: skip
