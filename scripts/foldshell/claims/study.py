"""All claims of a study, with how far each depends on settings, as plain data."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

from foldshell.claims import kinematics as folding
from foldshell.claims.design_result import Comparer, DesignResult
from foldshell.claims.planarity import describe_planarity
from foldshell.claims.sensitive import (
    SENSITIVE,
    describe_dependence,
    judge_by_strips,
    judge_equal_thickness,
    judge_variants,
)
from foldshell.claims.sized import judge_sized
from foldshell.claims.statement import Claim, describe_claim
from foldshell.claims.words import format_value, make_table
from foldshell.records.claims import ClaimRecord, Dependence
from foldshell.records.kinematics import KinematicsRecord
from foldshell.records.measures import FlatEqualRecord, Measures, SensitivityRow


def judge_study(
    design_results: Sequence[DesignResult],
    equal: Sequence[DesignResult],
    folds: Sequence[DesignResult],
    kinematics: KinematicsRecord,
    flats: Mapping[str, FlatEqualRecord],
    variants: Mapping[str, Sequence[DesignResult]],
    comparer: Comparer,
) -> list[ClaimRecord]:
    """Return the entries of claims.json: C1 to C14, then what the paper left open.

    Parameters
    ----------
    design_results, equal : final states, and those at the start with one thickness for all panels
    folds : designs of which only the folding counts
    flats : what the flat sheet of equal volume does, by folded design
    variants : design_results under other settings, by variant
    """
    geometries = choose_geometries([*design_results, *folds])
    claims = [
        folding.judge_auxetic(kinematics),
        folding.judge_soft_modes(kinematics, geometries, comparer),
        folding.judge_force_ratios(kinematics),
        *judge_sized(design_results, equal, flats, comparer),
        folding.judge_foldability(geometries),
    ]
    described = [_describe(claim, design_results, equal, variants, comparer) for claim in claims]
    return [*described, describe_planarity(design_results)]


def _describe(claim: Claim, design_results, equal, variants, comparer: Comparer) -> ClaimRecord:
    entry = describe_claim(claim)
    runs = judge_variants(claim.key, variants, comparer)
    level = judge_equal_thickness(claim.key, equal, comparer)
    strips = judge_by_strips(claim.key, design_results, comparer)
    words = describe_dependence(claim, runs, level, variants, strips)
    if claim.key in SENSITIVE:
        words += _describe_states([one for one in design_results if one.name in entry.designs])
    dependence = Dependence(words=words, runs=runs, equal_thickness=level, by_strips=strips)
    return replace(entry, sensitivity=dependence)


def _describe_states(design_results: Sequence[DesignResult]) -> str:
    """Say how many designs hang on the least thickness alone, and which did not settle."""
    names = {state: [o.name for o in design_results if o.values.state == state]
             for state in ("at_minimum_thickness", "not_converged", "unstable")}  # fmt: skip
    thin = len(names["at_minimum_thickness"])
    words = (
        f" {thin} of {len(design_results)} designs stand at the least thickness in every panel, "
        "which alone then sets volume and utilization."
        if thin
        else f" None of {len(design_results)} designs stands at the least thickness in every panel."
    )
    unsettled = names["not_converged"] + names["unstable"]
    if unsettled:
        words += f" Not settled when the loop ended: {', '.join(unsettled)}."
    return words


def choose_geometries(design_results: Sequence[DesignResult]) -> list[DesignResult]:
    """Return one design of each folded geometry; supports do not matter to it."""
    names = ("pattern", "surface", "span_m", "height_m", "zigzag", "strip", "fold_mode")
    found: dict[tuple, DesignResult] = {}
    for design_result in design_results:
        found.setdefault(tuple(getattr(design_result.row, name) for name in names), design_result)
    return list(found.values())


def list_runs(variants: Mapping[str, Sequence[DesignResult]]) -> list[SensitivityRow]:
    """Return one row per run with other settings: design, variant, measures, volume over base."""
    base = {one.name: one.values.volume for one in variants.get("base", ())}
    shared = {field.name for field in fields(SensitivityRow)} & {f.name for f in fields(Measures)}
    return [
        SensitivityRow(
            design=one.name,
            variant=variant,
            volume_over_base=one.values.volume / base[one.name] if one.name in base else None,
            **{name: getattr(one.values, name) for name in shared},
        )
        for variant, design_results in variants.items()
        for one in design_results
    ]


def write_spread(
    variants: Mapping[str, Sequence[DesignResult]],
    design_results: Sequence[DesignResult],
    words: Mapping[str, str],
) -> str:
    """Return the section on volumes: one row per design, one column per variant of settings.

    It says for how many designs the run in memory ends where the loop in files did.
    """
    final = {one.name: one.values.volume for one in design_results}
    base = variants.get("base", ())
    same = sum(one.values.volume == final.get(one.name) for one in base)
    volume = {name: {one.name: one for one in members} for name, members in variants.items()}
    rows = []
    for one in base:
        cells = [volume[name].get(one.name) for name in variants]
        shown = [f"{format_value(c.values.volume)} {MARKS[c.values.state]}" if c else "-"
                 for c in cells]  # fmt: skip
        rows.append([one.name, *shown])
    meaning = "".join(f"- `{name}`: {words[name]}\n" for name in variants)
    return (
        "## Volumes under other settings\n\n"
        f"Volume in m3; the runs in memory end at the volume of the loop in files for {same} of "
        f"{len(base)} designs. {LEGEND}\n\n{meaning}\n" + make_table(["design", *variants], rows)
    )


def write_warnings(design_results: Sequence[DesignResult]) -> str:
    """Return the section on final states that theory or mesh does not hold, nothing for none."""
    rows = [[one.name, one.warning] for one in design_results if one.warning]
    if not rows:
        return ""
    words = "Numbers of these designs stand above all the same; docs/shell.md says what a bound is."
    return f"## Models in doubt\n\n{words}\n\n" + make_table(["design", "warning"], rows) + "\n"


MARKS = {
    "converged": "c",
    "at_minimum_thickness": "m",
    "not_converged": "n",
    "unstable": "u",
    "continue": "?",
}
LEGEND = "c converged, m every panel at the least thickness, n not converged, u unstable."
