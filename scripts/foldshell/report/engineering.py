"""The engineering verdict on pages: its checks, beside and never among the paper's criteria."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foldshell.checks.materials import CRITERION_WORDS
from foldshell.files.errors import InputError
from foldshell.records.analysis import NO_LIMIT
from foldshell.records.engineering import EngineeringCheck, EngineeringRecord
from foldshell.records.files import read_record
from foldshell.report.checks import Check, describe_share, find_governing
from foldshell.report.markup import Table, make_table
from foldshell.report.section import Box, Folded, Section, judge_met

KINDS = {"passes": "good", "fails": "bad", "not_applicable": ""}
COMPONENTS = ("nx", "ny", "nxy", "mx", "my", "mxy", "vx", "vy")
BARS = ("class [mm]", "panels", "layer", "direction", "bar [mm]", "spacing [mm]",
        "steel [cm²/m]", "mass [kg]", "used")  # fmt: skip
HEADER = ("check", "value", "limit", "of its limit", "met", "where")


def read_verdict(path: str | Path | None) -> EngineeringRecord | None:
    """Return checks/engineering.json, None where there is none or it cannot be read."""
    try:
        return read_record(path, EngineeringRecord) if path else None
    except InputError:
        return None


def list_engineering(record: EngineeringRecord | None) -> list[Check]:
    """Return the checks of an engineering verdict, displacements in mm."""
    return [] if record is None else [_show(one, record) for one in record.checks.values()]


def _show(check: EngineeringCheck, record: EngineeringRecord) -> Check:
    factor, unit = (1e3, "mm") if check.unit == "m" else (1.0, check.unit)
    value, limit = (None if one is None else factor * one for one in (check.value, check.limit))
    ratio = None
    if value and limit:
        ratio = limit / value if check.at_least else value / limit
    where = [f"combination {check.governing_combination}"] * bool(check.governing_combination)
    if check.panel is not None:
        where.append(f"panel {check.panel}{_say_place(check, record)}")
    where += ["within the mesh error"] * check.within_mesh_error
    where += [NO_LIMIT] * (check.limit is None)
    name = f"{check.words} [{unit}]" if unit else check.words
    return Check(name, value, limit, ratio, check.met, ", ".join(where))


def _say_place(check: EngineeringCheck, record: EngineeringRecord) -> str:
    """Return where in its panel a check governs, else where the panel is; in m."""
    if check.place:
        return f" ({check.place})"
    columns = [record.panels.get(f"centroid_{axis}_m", ()) for axis in "xyz"]
    if any(len(one) <= check.panel for one in columns):
        return ""
    return " at ({:.2f}, {:.2f}, {:.2f}) m".format(*(one[check.panel] for one in columns))


def make_engineering(record: EngineeringRecord | None) -> list[Section]:
    """Return verdict and checks, then combinations, reactions and section forces, folded."""
    if record is None:
        return []
    box = Box(KINDS[record.verdict], "by the engineering checks, under combinations of its own",
              record.verdict.replace("_", " "), record.reason)  # fmt: skip
    rows = [(one.name, one.value, one.limit, describe_share(one.ratio), judge_met(one.met),
             one.where) for one in list_engineering(record)]  # fmt: skip
    governing = find_governing(list_engineering(record))
    words = f"Governs by the engineering checks: {governing.words}." if governing else ""
    sections = [
        Section("Engineering verdict", box, words, table=make_table(HEADER, rows),
                note=describe_measures(record)),
        *make_reinforcement(record),
        Section("Engineering: combinations", folded=Folded(
            "factors of load cases and buckling factors", tabulate_combinations(record))),
        Section("Engineering: reactions", folded=Folded(
            "resultants of supports by combination, kN", tabulate_reactions(record))),
        Section("Engineering: section forces", folded=Folded(
            "means over panels, least and largest of strength combinations",
            tabulate_forces(record))),
    ]  # fmt: skip
    return [one for one in sections if one.folded is None or one.folded.table.rows]


def make_reinforcement(record: EngineeringRecord) -> list[Section]:
    """Return what a shell takes of steel, what governs its panels, and the schedule of bars."""
    total = record.reinforcement
    if total is None:
        return []
    share = {name: f"{one:.0%}" for name, one in total.governing_share.items() if one >= 0.005}
    rows = [
        ("reinforcement", f"{total.steel_kg_m2:.3g} kg/m², {total.steel_kg_m3:.3g} kg/m³"),
        ("the same without least steel", f"{total.steel_needed_kg_m2:.3g} kg/m²"),
        ("in all", f"{total.steel_kg:.0f} kg in {total.concrete_m3:.4g} m³ of concrete"),
        ("by the schedule of bars", f"{total.steel_bars_kg:.0f} kg"),
        ("two layers of bars fit in", f"{total.two_layers_share:.0%} of panels"),
        ("most used by", ", ".join(f"{name} {one}" for name, one in share.items())),
        ("greenhouse gases", f"{total.co2_kg / 1e3:.3g} t CO2e ({total.co2_low_kg / 1e3:.3g} to "
                             f"{total.co2_high_kg / 1e3:.3g})"),
    ]  # fmt: skip
    if total.cost is not None:
        words = f"{total.cost:.4g} ({total.cost_low:.4g} to {total.cost_high:.4g})"
        rows.append(("cost by the prices of the settings", words))
    bars = [
        (round(1e3 * one.thickness_m, 1), one.panels, one.layer, one.direction, one.diameter_mm,
         one.spacing_mm, one.area_cm2_m, one.mass_kg, describe_share(one.use))
        for one in total.bars
    ]  # fmt: skip
    note = "EN 1992-1-1; shear beside folds is open: it does not settle with the mesh."
    table = make_table(("reinforced concrete", "of the final state"), rows)
    return [
        Section("Engineering: reinforcement", table=table, note=note),
        Section("Engineering: bars", folded=Folded(
            "bars by class of thickness", make_table(BARS, bars))),
    ]  # fmt: skip


def describe_measures(record: EngineeringRecord) -> str:
    """Return utilization of the final state under the loop's combinations, by each criterion."""
    words = [
        f"{CRITERION_WORDS[name]}: largest panel mean {one.utilization_panel_mean_max:.3g}, "
        f"largest strip {one.utilization_strip_max:.3g}, {one.panels_above_one} panels above 1"
        for name, one in record.measures.items()
    ]
    return f"Under the loop's own combinations: {'; '.join(words)}." if words else ""


def tabulate_combinations(record: EngineeringRecord) -> Table:
    """Return the factors of load cases in each combination, and its buckling factor."""
    cases = list(record.loads)
    rows = [
        (name, purpose.replace("_", " "), *(one.get(case) for case in cases),
         record.buckling_factor.get(name))
        for purpose, group in vars(record.combinations).items()
        for name, one in group.items()
    ]  # fmt: skip
    return make_table(("combination", "for", *cases, "buckling factor"), rows)


def tabulate_reactions(record: EngineeringRecord) -> Table:
    """Return the reactions of each support, their thrust and their sum, by combination, in kN."""
    rows: list[tuple] = []
    names = next(iter(record.reactions.values()), {})
    for name in names:
        forces = {edge: found[name] for edge, found in record.reactions.items()}
        rows += [(name, edge, *_round(force)) for edge, force in forces.items()]
        rows.append((name, "sum", *_round(np.sum(list(forces.values()), axis=0).tolist())))
    header = ("combination", "support", "x [kN]", "y [kN]", "z [kN]", "thrust [kN]")
    return make_table(header, rows)


def _round(force: Sequence[float]) -> list[float]:
    return [round(value, 1) + 0.0 for value in (*force, float(np.hypot(*force[:2])))]


def tabulate_forces(record: EngineeringRecord) -> Table:
    """Return the least and the largest mean of each section force, and the panels of both."""
    rows = []
    for name in COMPONENTS:
        if f"{name}_min" not in record.panels:
            continue
        low, high = (np.array(record.panels[f"{name}_{end}"]) for end in ("min", "max"))
        unit = "kNm/m" if name.startswith("m") else "kN/m"
        rows.append((f"{name} [{unit}]", float(low.min()), int(low.argmin()), float(high.max()),
                     int(high.argmax())))  # fmt: skip
    return make_table(("section force", "least", "in panel", "largest", "in panel"), rows)
