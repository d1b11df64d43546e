"""Every setting of a study, group by group, and the small groups."""

from collections.abc import Mapping

from foldshell.settings.analysis import Analysis
from foldshell.settings.archive import Archive
from foldshell.settings.checks import Checks
from foldshell.settings.codes import Codes
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.design import DesignColumns
from foldshell.settings.exports import Drawings, Exports
from foldshell.settings.field import Group, setting, settings_group
from foldshell.settings.fold import Fold, Pattern
from foldshell.settings.load_table import LoadSets
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.settings.reinforcement import Co2, Prices, Reinforcement
from foldshell.settings.sizing import Sizing


@settings_group
class Limits(Group):
    """Guards."""

    panels_max: int = setting(
        0,
        unit="panels",
        ranges=((4, 10**6),),
        meaning="Largest number of panels of a design; 0 sets none. Designs whose analysis takes "
        "more memory than the machine has are refused in any case, 8 kB a freedom.",
    )


@settings_group
class Jobs(Group):
    """How jobs are started; results do not depend on it."""

    fork: bool = setting(
        True,
        meaning="Linux, one machine: jobs are forks of a process that has imported the libraries. "
        "Otherwise each job starts Python anew (0.25 s of a processor).",
    )


@settings_group
class Figures(Group):
    """Pictures."""

    width_px: int = setting(1200, unit="px", minimum=200, maximum=8000, meaning="Width.")
    height_px: int = setting(900, unit="px", minimum=200, maximum=8000, meaning="Height.")


AUTO = "auto"

NO_EXPLORATION = "none"

LOAD_TABLE = "config/loads.tsv"


@settings_group
class Settings(Group):
    """Every setting of a study; a stage's settings hold only the groups that it takes."""

    designs: str = setting(
        "config/designs.tsv",
        meaning="Table of designs, one row each; `--config designs=PATH` takes another one.",
    )
    supports: str = setting(
        "config/supports.tsv",
        meaning="Table of supports: sets of rows that the column support of the designs names. It "
        "is read where a design names one.",
        stages=(),
    )
    results: str = setting(
        AUTO,
        meaning="Folder of the results. `auto` is `results`, and `results/<name>` for a table that "
        "is not called designs.tsv; `--config results=FOLDER` takes another one.",
    )
    load_table: str = setting(
        LOAD_TABLE,
        meaning="Table of the sets of loads that designs name in the column `loads`; "
        "docs/loads.md says more.",
    )
    load_sets: LoadSets = setting({}, internal=True, meaning="The sets that the table holds.")
    own: Mapping[str, "Settings"] = setting(
        {}, internal=True, meaning="Settings of the files that designs name, by file."
    )
    exploration: str = setting(
        NO_EXPLORATION,
        meaning="File of the exploration that the target `explore` runs; config/explorations/ has "
        "some, docs/explore.md says what stands in them.",
    )
    study: str = setting(
        "table1",
        meaning="Tag of the designs that the default target runs; what is said over all of them "
        "stands in `results/studies/<study>/`. `--config study=TAG` takes another one.",
    )
    loop: str = setting(
        "auto", choices=("auto", "steps", "whole"), stages=(),
        meaning="How the thickness loop runs, with the same files and results: a job for each "
        "analysis and each workbook (steps), or one job for each design (whole). auto takes steps "
        "on this machine for a study of up to 60 designs, else whole.",
    )  # fmt: skip
    defaults: DesignColumns
    pattern: Pattern
    fold: Fold
    material: Material
    loads: Loads
    combinations: Combinations
    codes: Codes
    analysis: Analysis
    sizing: Sizing
    checks: Checks
    reinforcement: Reinforcement
    co2: Co2
    prices: Prices
    crosscheck: Crosscheck
    limits: Limits
    jobs: Jobs
    figures: Figures
    drawings: Drawings
    exports: Exports
    archive: Archive
