"""SAP2000's text files (.s2k): written, and read back as tables.

Areas are quadrilaterals, three times 2 x 2 a facet, in groups by panel; sections carry thickness.
Every combination is a nonlinear static case with P-Delta, as the design was analysed, and a
buckling case stands beside. In kN, m, C.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

from foldshell.exchange.fe_mesh import QuadMesh, divide_facets
from foldshell.exchange.fe_supports import held_nodes, held_rotations, spring_nodes
from foldshell.exchange.model import ExportModel, SpreadLoad
from foldshell.exchange.options import ExportOptions
from foldshell.files.errors import InputError
from foldshell.files.whole import atomic_path
from foldshell.loads.cases import WEIGHT, SurfaceLoad

GRAVITY = 9.80665
DIVISIONS = 2
"""n of the mesh: three times n x n areas a facet."""
Row = Mapping[str, object]
AXES = {(1.0, 0.0, 0.0): ("X", 1), (0.0, 1.0, 0.0): ("Y", 1), (0.0, 0.0, -1.0): ("Gravity", 1)}
"""Directions of SAP2000 by unit vector; others are taken by components."""


def write_s2k(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the .s2k file."""
    mesh = divide_facets(model, DIVISIONS, middles=False)
    lines = [f"File {paths[0].name} was made by foldshell for design {model.design}", ""]
    for name, rows in _tables(model, mesh):
        lines += [f'TABLE:  "{name}"', *("   " + "   ".join(_entries(row)) for row in rows), ""]
    lines += ["END TABLE DATA", ""]
    with atomic_path(paths[0]) as temporary:
        temporary.write_text("\n".join(lines), encoding="ascii")


def read_s2k(path: str | Path) -> dict[str, list[dict[str, str]]]:
    """Read a .s2k file: rows {field: text} by table, quotes and continued lines resolved.

    Raises `InputError` where the file ends before its end mark.
    """
    tables: dict[str, list[dict[str, str]]] = {}
    rows: list[dict[str, str]] = []
    ended, begun = False, ""
    for line in Path(path).read_text(encoding="ascii").splitlines():
        line = begun + line.strip()
        begun = ""
        if line.endswith(" _"):
            begun = line[:-1]
        elif line.startswith("TABLE:"):
            rows = tables.setdefault(line.partition('"')[2].rstrip('"'), [])
        elif line == "END TABLE DATA":
            ended = True
        elif "=" in line and tables:
            rows.append(dict(_split(line)))
    if not ended:
        raise InputError(f"{path}: cut off: no END TABLE DATA")
    return tables


def _split(line: str) -> Iterator[tuple[str, str]]:
    while "=" in line:
        name, _, line = line.partition("=")
        mark = '"' if line.startswith('"') else None
        value, _, line = line[1:].partition('"') if mark else line.partition(" ")
        yield name.strip(), value


def _entries(row: Row) -> Iterator[str]:
    for name, value in row.items():
        if isinstance(value, float):
            text = repr(value)
        else:
            text = f'"{value}"' if " " in str(value) or "," in str(value) else str(value)
        yield f"{name}={text}"


def _tables(model: ExportModel, mesh: QuadMesh) -> Iterator[tuple[str, list[Row]]]:
    """Yield each table's name and rows."""
    yield "PROGRAM CONTROL", [{"ProgramName": "SAP2000", "Version": "21.0.0",
                               "CurrUnits": "KN, m, C"}]  # fmt: skip
    freedoms = ("UX", "UY", "UZ", "RX", "RY", "RZ")
    yield "ACTIVE DEGREES OF FREEDOM", [{name: "Yes" for name in freedoms}]
    yield from _materials(model)
    yield from _loading(model)
    joints = enumerate(mesh.nodes.tolist(), 1)
    yield "JOINT COORDINATES", [
        {"Joint": k, "CoordSys": "GLOBAL", "CoordType": "Cartesian", "XorR": x, "Y": y, "Z": z,
         "SpecialJt": "No"} for k, (x, y, z) in joints
    ]  # fmt: skip
    corners = (mesh.corners + 1).tolist()
    yield (
        "CONNECTIVITY - AREA",
        [
            {"Area": k, "NumJoints": 4, **{f"Joint{n}": joint for n, joint in enumerate(own, 1)}}
            for k, own in enumerate(corners, 1)
        ],
    )
    panel = [model.panels[number] for number in model.facet_panel[mesh.facet].tolist()]
    yield (
        "AREA SECTION ASSIGNMENTS",
        [{"Area": k, "Section": one.name, "MatProp": "Default"} for k, one in enumerate(panel, 1)],
    )
    yield "GROUPS 1 - DEFINITIONS", [{"GroupName": one.name} for one in model.panels]
    yield (
        "GROUPS 2 - ASSIGNMENTS",
        [
            {"GroupName": one.name, "ObjectType": "Area", "ObjectLabel": k}
            for k, one in enumerate(panel, 1)
        ],
    )
    yield from _supports(model, mesh)
    yield "AREA LOADS - UNIFORM", list(_area_loads(model, mesh))


def _materials(model: ExportModel) -> Iterator[tuple[str, list[Row]]]:
    material = model.material
    shear = material.youngs_modulus / (2 * (1 + material.poissons_ratio))
    yield (
        "MATERIAL PROPERTIES 01 - GENERAL",
        [{"Material": "SHELL", "Type": "Concrete", "SymType": "Isotropic", "TempDepend": "No"}],
    )
    yield "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", [
        {"Material": "SHELL", "UnitWeight": material.unit_weight,
         "UnitMass": material.unit_weight / GRAVITY, "E1": material.youngs_modulus, "G12": shear,
         "U12": material.poissons_ratio, "A1": material.thermal_expansion}
    ]  # fmt: skip
    yield "AREA SECTION PROPERTIES", [
        {"Section": panel.name, "Material": "SHELL", "MatAngle": 0, "AreaType": "Shell",
         "Type": "Shell-Thin", "DrillDOF": "Yes", "Thickness": panel.thickness,
         "BendThick": panel.thickness} for panel in model.panels
    ]  # fmt: skip


def _loading(model: ExportModel) -> Iterator[tuple[str, list[Row]]]:
    """Yield load patterns and cases: one nonlinear case a combination, and buckling."""
    yield "LOAD PATTERN DEFINITIONS", [
        {"LoadPat": case.case, "DesignType": "Dead" if case.kind == WEIGHT else "Other",
         "SelfWtMult": 1 if case.kind == WEIGHT else 0} for case in model.load_cases
    ]  # fmt: skip
    buckling = f"BUCK {model.compared['strength']}"
    yield "LOAD CASE DEFINITIONS", [
        *({"Case": name, "Type": "NonStatic", "InitialCond": "Zero", "RunCase": "Yes"}
          for name in model.combinations),
        {"Case": buckling, "Type": "LinBuckling", "InitialCond": "Zero", "RunCase": "Yes"},
    ]  # fmt: skip
    rows = [_assign(name, factors) for name, factors in model.combinations.items()]
    yield "CASE - STATIC 1 - LOAD ASSIGNMENTS", [row for case in rows for row in case]
    yield (
        "CASE - STATIC 2 - NONLINEAR LOAD APPLICATION",
        [
            {"Case": name, "LoadApp": "Full Load", "MonitorDOF": "U3", "MonitorJt": 1}
            for name in model.combinations
        ],
    )
    yield (
        "CASE - STATIC 4 - NONLINEAR PARAMETERS",
        [{"Case": name, "GeoNonLin": "P-Delta"} for name in model.combinations],
    )
    yield "CASE - BUCKLING 1 - GENERAL", [{"Case": buckling, "NumBuckMode": 6, "EigenTol": 1e-9}]
    own = model.combinations[model.compared["strength"]]
    yield "CASE - BUCKLING 2 - LOAD ASSIGNMENTS", _assign(buckling, own)


def _assign(name: str, factors: Mapping[str, float]) -> list[Row]:
    """Return the rows that put load patterns with their factors into a load case."""
    return [
        {"Case": name, "LoadType": "Load pattern", "LoadName": case, "LoadSF": float(factor)}
        for case, factor in factors.items()
    ]


def _supports(model: ExportModel, mesh: QuadMesh) -> Iterator[tuple[str, list[Row]]]:
    words, free = {True: "Yes", False: "No"}, (False, False, False)
    moved, turned = held_nodes(model, mesh), held_rotations(model, mesh)
    yield "JOINT RESTRAINT ASSIGNMENTS", [
        {"Joint": node + 1,
         **{f"U{k}": words[bool(f)] for k, f in enumerate(moved.get(node, free), 1)},
         **{f"R{k}": words[bool(f)] for k, f in enumerate(turned.get(node, free), 1)}}
        for node in sorted({*moved, *turned})
    ]  # fmt: skip
    springs = spring_nodes(model, mesh)
    if springs:
        yield "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", [
            {"Joint": node + 1, "CoordSys": "GLOBAL",
             **{f"U{k}": value for k, value in enumerate(stiffness, 1)},
             "R1": 0, "R2": 0, "R3": 0} for node, stiffness in springs.items()
        ]  # fmt: skip


def _area_loads(model: ExportModel, mesh: QuadMesh) -> Iterator[Row]:
    """Yield uniform loads: local 3 against the normal, else global; plan shares in the value."""
    normal, self_weight_only = model.normals[:, 2], model.self_weight_only
    for case in model.load_cases:
        if case.kind == WEIGHT or not case.value:
            continue
        spread = isinstance(case, SpreadLoad)
        for area, facet in enumerate(mesh.facet.tolist(), 1):
            if spread:
                for axis, value in zip("XYZ", case.facet_loads[facet].tolist(), strict=True):
                    if value:
                        yield {"Area": area, "LoadPat": case.case, "CoordSys": "GLOBAL",
                               "Dir": axis, "UnifLoad": value}  # fmt: skip
                continue
            if self_weight_only[facet]:
                continue
            share = abs(float(normal[facet])) if case.area == "plan_abs" else 1.0
            for system, direction, value in _directions(case):
                yield {"Area": area, "LoadPat": case.case, "CoordSys": system, "Dir": direction,
                       "UnifLoad": value * share}  # fmt: skip


def _directions(case: SurfaceLoad) -> list[tuple[str, str, float]]:
    if case.direction is None:
        return [("Local", "3", -case.value)]
    known = AXES.get(tuple(map(float, case.direction)))
    if known:
        return [("GLOBAL", known[0], known[1] * case.value)]
    parts = zip("XYZ", case.direction, strict=True)
    return [("GLOBAL", axis, part * case.value) for axis, part in parts if part]
