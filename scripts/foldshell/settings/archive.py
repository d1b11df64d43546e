"""The archive of a study."""

from foldshell.settings.field import Group, setting, settings_group


@settings_group
class Archive(Group):
    """The archive of a study, made by `snakemake archive`."""

    fields: bool = setting(
        True,
        meaning="Hold the fields of all iterations and pictures (.npz, .vtu), or only shape, mesh "
        "and final state of each design.",
    )
    dirty: str = setting(
        "refuse", choices=("refuse", "diff"),
        meaning="Where files differ from the commit that is checked out: make no archive, or hold "
        "the difference too.",
    )  # fmt: skip
