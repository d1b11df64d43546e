"""The Structural Analysis Format (SAF 2.2): a workbook that FE programs import.

A planar panel is one surface member, of a bent panel each facet is one. Units as SAF fixes them:
m, mm of thickness, MPa, kN/m2, kg/m3. A member's z is its normal, by the order of its nodes.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.exchange.fe_supports import clamp_axes
from foldshell.exchange.model import ExportModel, Panel, SpreadLoad
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.sheets import write_workbook
from foldshell.loads.cases import WEIGHT, SurfaceLoad

GRAVITY = 9.80665
VERSION = "2.2.0"
FREE = (False, False, False)
Rows = list[list[object]]


@dataclass(frozen=True)
class Member:
    """A planar surface member: its name, panel, vertices in order, unit normal, and facets."""

    name: str
    panel: Panel
    vertices: list[int]
    normal: np.ndarray
    facets: np.ndarray


def list_members(model: ExportModel) -> tuple[Member, ...]:
    """Return planar panels whole, bent ones facet by facet."""
    members = []
    for panel in model.panels:
        if panel.planar:
            area = model.area_vectors[panel.facets].sum(axis=0)
            corners = panel.corners.tolist()
            unit = area / np.linalg.norm(area)
            members.append(Member(panel.name, panel, corners, unit, panel.facets))
            continue
        for k, facet in enumerate(panel.facets.tolist(), 1):
            corners = model.facets[facet].tolist()
            normal, name = model.normals[facet], f"{panel.name}.{k}"
            members.append(Member(name, panel, corners, normal, np.array([facet])))
    return tuple(members)


def write_saf(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the workbook."""
    members = list_members(model)
    tables = {
        "Project": [["Name", model.design], ["Description", "folded shell"]],
        "Model": _model(model),
        "StructuralMaterial": _material(model),
        "StructuralPointConnection": _nodes(model),
        "StructuralSurfaceMember": _members(model, members),
        "StructuralEdgeConnection": _supports(model, members),
        **_point_supports(model),
        "StructuralLoadGroup": _groups(),
        "StructuralLoadCase": _cases(model),
        "StructuralLoadCombination": _combinations(model),
        "StructuralSurfaceAction": _actions(model, members),
    }
    write_workbook(paths[0], tables, model.design)


def _model(model: ExportModel) -> Rows:
    return [
        ["Name", model.design],
        ["Description", f"{model.verdict}; flat state {model.flat_note}"],
        ["Source application", "foldshell"],
        ["SAF Version", VERSION],
        ["Global coordinate system", "Z vertical"],
        ["LCS of cross-section", "ZYX"],
        ["System of units", "Metric"],
        ["National code", "EC-Standard-EN"],
    ]


def _material(model: ExportModel) -> Rows:
    material = model.material
    head = ["Name", "Type", "Quality", "Unit mass [kg/m3]", "E modulus [MPa]", "G modulus [MPa]",
            "Poisson Coefficient"]  # fmt: skip
    modulus = material.youngs_modulus / 1000
    shear = modulus / (2 * (1 + material.poissons_ratio))
    mass = 1000 * material.unit_weight / GRAVITY
    kind = "Concrete" if material.name.startswith("C") else "Other"
    return [head, ["M1", kind, material.name, mass, modulus, shear, material.poissons_ratio]]


def _nodes(model: ExportModel) -> Rows:
    head = ["Name", *(f"Coordinate {axis} [m]" for axis in "XYZ")]
    return [head, *([f"N{k}", *point] for k, point in enumerate(model.vertices.tolist(), 1))]


def _members(model: ExportModel, members: tuple[Member, ...]) -> Rows:
    head = ["Name", "Type", "Material", "Thickness type", "Thickness [mm]", "System plane at",
            "Nodes", "Edges", "Area [m2]", "Layer", "LCS Type", "Coordinate X [m]",
            "Coordinate Y [m]", "Coordinate Z [m]", "LCS Rotation [deg]",
            "Analysis Z Eccentricity [mm]", "Shape", "Behavior in analysis"]  # fmt: skip
    rows = []
    for member in members:
        points = model.vertices[member.vertices]
        along = points[1] - points[0]
        area = np.cross(points - points[0], np.roll(points, -1, axis=0) - points[0]).sum(axis=0)
        layer = f"class {member.panel.thickness_class}" if member.panel.sized else "edge beam"
        rows.append([
            member.name, "Plate", "M1", "Constant", _text(1000 * member.panel.thickness), "Centre",
            "; ".join(f"N{v + 1}" for v in member.vertices),
            "; ".join(["Line"] * len(member.vertices)), float(np.linalg.norm(area)) / 2, layer,
            "x by vector", *(along / np.linalg.norm(along)).tolist(), 0, 0, "Flat", "Isotropic",
        ])  # fmt: skip
    return [head, *rows]


def _text(value: float) -> str:
    return f"{value:.12g}"


def _supports(model: ExportModel, members: tuple[Member, ...]) -> Rows:
    head = ["Name", "Type", "Boundary condition", "2D Member", "Edge", "ux", "uy", "uz", "fix",
            "fiy", "fiz", "Stiffness X [MN/m2]", "Stiffness Y [MN/m2]", "Stiffness Z [MN/m2]",
            "Coordinate system", "Coordinate definition", "Origin", "Start point [m]",
            "End point [m]"]  # fmt: skip
    owners = dict(_edges(members))
    rows: Rows = []
    for support in model.supports:
        words = [
            "Rigid" if fixed else ("Flexible" if spring else "Free")
            for fixed, spring in zip(support.fixed, support.spring, strict=True)
        ]
        springs = [spring / 1000 if spring else "" for spring in support.spring]
        kind = "Hinged" if all(support.fixed) and not support.clamp else "Custom"
        turns = clamp_axes(model, support) if support.clamp else [FREE] * len(support.edges)
        for pair, turned in zip(np.sort(support.edges, axis=1).tolist(), turns, strict=True):
            member, edge = owners[tuple(pair)]
            rotations = ["Rigid" if held else "Free" for held in turned]
            rows.append([f"S{len(rows) + 1}", kind, "On edge", member, edge, *words, *rotations,
                         *springs, "Global", "Relative", "From start", 0, 1])  # fmt: skip
    return [head, *rows]


def _point_supports(model: ExportModel) -> dict[str, Rows]:
    """Return the sheet of supported vertices, none where edges alone are supported."""
    head = ["Name", "Type", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz", "Stiffness X [MN/m]",
            "Stiffness Y [MN/m]", "Stiffness Z [MN/m]", "Coordinate system"]  # fmt: skip
    rows: Rows = []
    for support in model.supports:
        pairs = list(zip(support.fixed, support.spring, strict=True))
        words = ["Rigid" if held else ("Flexible" if k else "Free") for held, k in pairs]
        springs = [spring / 1000 if spring else "" for spring in support.spring]
        kind = "Hinged" if all(support.fixed) else "Custom"
        for vertex in support.vertices.tolist():
            rows.append([f"SN{len(rows) + 1}", kind, f"N{vertex + 1}", *words, "Free", "Free",
                         "Free", *springs, "Global"])  # fmt: skip
    return {"StructuralPointSupport": [head, *rows]} if rows else {}


def _edges(members: tuple[Member, ...]) -> Iterator[tuple[tuple[int, int], tuple[str, int]]]:
    """Yield each edge with a member that has it and its number there, from 1."""
    for member in reversed(members):
        for k, first in enumerate(member.vertices):
            second = member.vertices[(k + 1) % len(member.vertices)]
            yield (min(first, second), max(first, second)), (member.name, k + 1)


def _groups() -> Rows:
    return [["Name", "Load group type", "Relation", "Load type"],
            ["LG permanent", "Permanent", "Standard", ""],
            ["LG variable", "Variable", "Standard", "Roofs"],
            ["LG wind", "Variable", "Exclusive", "Wind"]]  # fmt: skip


def _kind(case: SurfaceLoad) -> tuple[str, str, str, str]:
    """Return action type, load group, load type and duration of a case."""
    if case.kind == WEIGHT:
        return "Permanent", "LG permanent", "Self weight", ""
    if case.action == "permanent":
        return "Permanent", "LG permanent", "Others", ""
    if case.action == "snow":
        return "Variable", "LG variable", "Snow", "Short"
    if case.action == "wind":
        return "Variable", "LG wind", "Wind", "Short"
    return "Variable", "LG variable", "Static", "Short"


def _cases(model: ExportModel) -> Rows:
    head = ["Name", "Action type", "Load group", "Load type", "Duration"]
    return [head, *([case.case, *_kind(case)] for case in model.load_cases)]


def _combinations(model: ExportModel) -> Rows:
    count = max(map(len, model.combinations.values()))
    head = ["Name", "Description", "Category", "Type"]
    for k in range(1, count + 1):
        head += [f"Load factor {k}", f"Multiplier {k}", f"Load case name {k}"]
    rows = [_combination(model, name, factors) for name, factors in model.combinations.items()]
    return [head, *rows]


def _combination(model: ExportModel, name: str, factors: Mapping[str, float]) -> list[object]:
    strength = name in model.groups["strength"]
    words = " + ".join(f"{factor:g} {case}" for case, factor in factors.items())
    limit = "ULS (Ultimate Limit State)" if strength else "SLS (Serviceability Limit State)"
    row: list[object] = [name, words, limit, "Nonlinear"]
    for case, factor in factors.items():
        row += [factor, 1, case]
    return row


def _actions(model: ExportModel, members: tuple[Member, ...]) -> Rows:
    head = ["Name", "Direction", "Type", "Force action", "Value [kN/m2]", "2D Member", "Load case",
            "Coordinate system", "Location"]  # fmt: skip
    rows: Rows = []
    for case in model.load_cases:
        if case.kind == WEIGHT or not case.value:
            continue
        for member in members:
            if member.panel.sized:
                for axis, value, system, place in surface_action(model, case, member):
                    rows.append([f"A{len(rows) + 1}", axis, "Standard", "On 2D member", value,
                                 member.name, case.case, system, place])  # fmt: skip
    return [head, *rows]


def surface_action(
    model: ExportModel, case: SurfaceLoad, member: Member
) -> list[tuple[str, float, str, str]]:
    """Return direction, value kN/m2, coordinate system and location of a case on a member.

    A vertical load on plan area is a projection; the plan share of another is in its value. What
    is not uniform is the mean over the member, along the axes.
    """
    if isinstance(case, SpreadLoad):
        area = model.areas[member.facets]
        mean = area @ case.facet_loads[member.facets] / area.sum()
        return [(axis, float(part), "Global", "Length")
                for axis, part in zip("XYZ", mean, strict=True) if part]  # fmt: skip
    if case.direction is None:
        return [("Z", -case.value, "Local", "Length")]
    plan = case.area == "plan_abs"
    share = abs(float(member.normal[2])) if plan else 1.0
    found = []
    for axis, part in zip("XYZ", case.direction, strict=True):
        if part and plan and axis == "Z":
            found.append((axis, case.value * part, "Global", "Projection"))
        elif part:
            found.append((axis, case.value * part * share, "Global", "Length"))
    return found
