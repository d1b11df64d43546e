"""What each stage of a design depends on: plain values for Snakemake's `params`, and hashes."""

from foldshell.files.whole import DIGITS, hash_data, hash_file
from foldshell.settings.analysed import ANALYSED, LOADED
from foldshell.settings.analysis import Analysis
from foldshell.settings.archive import Archive
from foldshell.settings.checks import Checks
from foldshell.settings.codes import Codes
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.design import FILE_COLUMNS, Design
from foldshell.settings.exports import Drawings, Exports
from foldshell.settings.field import Plain, list_groups
from foldshell.settings.fold import Fold, Pattern
from foldshell.settings.load_sets import combinations_of, place_set
from foldshell.settings.load_table import PAPER
from foldshell.settings.own import settings_of
from foldshell.settings.reinforcement import Co2, Prices, Reinforcement
from foldshell.settings.sizing import REINFORCED, Sizing
from foldshell.settings.stage import to_plain
from foldshell.settings.study import Figures, Settings

STAGES: dict[str, tuple[type, ...]] = {
    "pattern": (Pattern,),
    "fold": (Fold,),
    "mesh": (Analysis,),
    "start": (Sizing,),
    "analyse": ANALYSED,
    "resize": (Sizing,),
    "size": ANALYSED,
    "crosscheck": (*LOADED, Crosscheck),
    "reinforced": (Checks, Reinforcement),
    "figures": (Figures,),
    "drawings": (Drawings,),
    "exports": (Exports,),
    "archive": (Archive,),
    "checks": (Codes, Checks, Reinforcement, Co2, Prices),
    "study": (Pattern, Fold, *ANALYSED, Co2, Prices, Crosscheck),
}
"""Groups that each stage takes; a setting with `stages` of its own goes to those alone."""

SEARCHED = (*STAGES["study"], Codes)
"""Groups that a search of the pattern takes."""

DECIDING = ("pattern", "fold", "mesh", "start", "analyse", "resize")
"""Stages whose settings decide the final state of a design."""

NOT_DECIDING = ("design", "tags", "loads")
"""Columns that decide nothing: the name of a set does not, its loads are among the settings."""

FINAL_STATE = ("shell/mesh.npz", "folded/folded.npz", "sizing/final.npz", "sizing/final.json")
"""The files in a design's folder that hold its final state, as figures over all designs read it."""


def stage_parameters(settings: Settings, stage: str, design: Design | None = None) -> Plain:
    """Return the plain values {group: {field: value}} that one stage depends on, and no others.

    As Snakemake `params` they make a rule run again only when a setting that it needs has
    changed; `read_stage` makes typed settings of them. A design with the tag `demo` gets the
    demo's subdivisions, one with loads or settings of its own gets those, and each its
    combinations.
    """
    settings, chosen = settings_of(settings, design), {}
    for name, kind in list_groups(Settings).items():
        if kind in STAGES[stage]:
            chosen[name] = to_plain(getattr(settings, name), stage)
    if stage in ("analyse", "size") and settings.sizing.measure != REINFORCED:
        chosen["reinforcement"] = {}
    if design is not None and "combinations" in chosen:
        chosen["combinations"] = to_plain(combinations_of(settings, design), stage)
    if design is not None and "loads" in chosen and design.loads != PAPER:
        rows = place_set(settings.load_sets, design)
        chosen["loads"] = {"rows": [row.to_text() for row in rows]}
    if design is not None and "subdivisions" in chosen.get("analysis", {}):
        chosen["analysis"]["subdivisions"] = choose_subdivisions(settings, design)
    return chosen


CUT_SUBDIVISIONS = 4
"""Least subdivisions of the facets of a sheet that an outline cuts: fewer are up to 14 % low."""


def choose_subdivisions(settings: Settings, design: Design) -> int:
    """Return the refinement of a design's facets: a design tagged `demo` has its own, one that is
    cut by an outline at least `CUT_SUBDIVISIONS`."""
    demo = "demo" in design.tags
    chosen = settings.analysis.subdivisions_demo if demo else settings.analysis.subdivisions
    return max(chosen, CUT_SUBDIVISIONS) if design.is_cut else chosen


def hash_decisions(settings: Settings, design: Design) -> str:
    """Return 12 hexadecimal digits of the SHA-256 of all that decides the final state of a design.

    These are its columns but name and tags, the content of its files, and the settings of
    `DECIDING`. A thickness that a person edits is added by `hash_edit` where it is analysed. Other
    settings (cross-check, classes, pictures, jobs) change no final state.
    """
    row = {key: value for key, value in design.decide().items() if key not in NOT_DECIDING}
    row |= {key: hash_file(row[key]) for key in FILE_COLUMNS if row.get(key) in design.files}
    row["support"] = design.holding
    groups = {stage: stage_parameters(settings, stage, design) for stage in DECIDING}
    return hash_data({"design": row, "settings": groups})[:DIGITS]


def search_parameters(settings: Settings, design: Design | None = None) -> Plain:
    """Return the plain values that a search depends on: those of a study, and of the codes."""
    plain = stage_parameters(settings, "study", design)
    return {**plain, "codes": stage_parameters(settings, "checks", design)["codes"]}
