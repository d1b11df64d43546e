"""The archive of a study."""

from foldshell.settings.field import Group, setting, settings_group


@settings_group
class Archive(Group):
    """The archive of a study, made by `snakemake archive`."""

    fields: bool = setting(
        False,
        meaning="Hold the fields of all iterations, of the final state and of pictures (.npz, "
        ".vtu; Table 1: 1.9 GB in place of 0.3), or only shape, mesh and thicknesses.",
    )
    dirty: str = setting(
        "refuse", choices=("refuse", "diff"),
        meaning="Where files differ from the commit that is checked out: make no archive, or hold "
        "the difference too.",
    )  # fmt: skip
