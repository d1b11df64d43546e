"""The design as a Python script for OpenSees: ASDShellQ4, load cases as patterns, combinations.

The script needs openseespy and nothing of this project. Run as `python FILE.py` it analyses every
combination, first order, and prints weight, sums of reactions and the largest displacements; as
`python FILE.py OUT.json` it writes them too. In kN and m; a file for each of two meshes.
"""

import json
from pathlib import Path

import numpy as np

from foldshell.exchange.fe_mesh import QuadMesh, divide_facets, mesh_loads
from foldshell.exchange.fe_supports import held_nodes, held_rotations, spring_nodes
from foldshell.exchange.model import ExportModel, load_on_facets
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import atomic_path

MESHES = (2, 4)
"""Divisions n of the two meshes: ASDShellQ4 settles with 1/n from the coarser on."""

RUN = '''

def build():
    """Enter nodes, supports, a section for each panel, and elements."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for tag, point in enumerate(NODES, 1):
        ops.node(tag, *point)
    for tag, fixed in SUPPORTS.items():
        ops.fix(tag, *fixed)
    for number, (tag, axis, stiffness) in enumerate(SPRINGS, 1):
        ground = len(NODES) + number
        ops.node(ground, *NODES[tag - 1])
        ops.fix(ground, 1, 1, 1, 1, 1, 1)
        ops.uniaxialMaterial("Elastic", number, stiffness)
        ops.element("zeroLength", len(ELEMENTS) + number, ground, tag, "-mat", number, "-dir", axis)
    for tag, thickness in enumerate(THICKNESS, 1):
        ops.section("ElasticMembranePlateSection", tag, E, NU, thickness, 0.0)
    for tag, (panel, *nodes) in enumerate(ELEMENTS, 1):
        ops.element("ASDShellQ4", tag, *nodes, panel + 1)


def solve(name):
    """Analyse one combination; return sums of load and reactions, and the largest displacements."""
    total = {}
    for case, factor in COMBINATIONS[name].items():
        for tag, force in LOADS[case].items():
            own = total.setdefault(tag, [0.0, 0.0, 0.0])
            for axis in range(3):
                own[axis] += factor * force[axis]
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for tag, force in total.items():
        ops.load(tag, *force, 0.0, 0.0, 0.0)
    ops.setTime(0.0)
    if ops.analyze(1) != 0:
        raise SystemExit(f"{name}: OpenSees found no solution")
    ops.reactions()
    moved = [ops.nodeDisp(tag)[:3] for tag in range(1, len(NODES) + 1)]
    grounds = range(len(NODES) + 1, len(NODES) + len(SPRINGS) + 1)
    held = [ops.nodeReaction(tag)[:3] for tag in (*SUPPORTS, *grounds)]
    ops.remove("loadPattern", 1)
    ops.remove("timeSeries", 1)
    return {
        "load_sum_kn": [sum(force[axis] for force in total.values()) for axis in range(3)],
        "reaction_sum_kn": [sum(force[axis] for force in held) for axis in range(3)],
        "displacement_down_max_m": -min(u[2] for u in moved),
        "displacement_max_m": max(sum(x * x for x in u) ** 0.5 for u in moved),
    }


def main(names):
    """Analyse the combinations and print what was found."""
    build()
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("Mumps")
    ops.algorithm("Linear", "-factorOnce")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    found = {name: solve(name) for name in names}
    for name, values in found.items():
        print(name, values)
    return {"design": DESIGN, "weight_kn": WEIGHT, "combinations": found}


if __name__ == "__main__":
    arguments = sys.argv[1:]
    target = arguments.pop(0) if arguments and arguments[0].endswith(".json") else None
    results = main(arguments or list(COMBINATIONS))
    if target:
        with open(target, "w") as stream:
            json.dump(results, stream)
'''


def write_opensees(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write a script for each of the two meshes."""
    for path, n in zip(paths, MESHES, strict=True):
        with atomic_path(path) as temporary:
            temporary.write_text(script(model, n), encoding="ascii")


def script(model: ExportModel, n: int) -> str:
    """Return the script of a mesh of three times n x n elements a facet."""
    mesh = divide_facets(model, n, middles=False)
    weight = model.material.unit_weight * model.volume
    moved, turned, free = held_nodes(model, mesh), held_rotations(model, mesh), (False,) * 3
    held = {
        node + 1: [*map(int, moved.get(node, free)), *map(int, turned.get(node, free))]
        for node in sorted({*moved, *turned})
    }
    springs = [
        (node + 1, axis, value)
        for node, stiffness in spring_nodes(model, mesh).items()
        for axis, value in enumerate(stiffness, 1)
        if value
    ]
    lines = [
        f'"""{model.design} for OpenSees, by foldshell: kN, m; 3 x {n} x {n} elements a facet."""',
        "", "import json", "import sys", "", "import openseespy.opensees as ops", "",
        f"DESIGN = {model.design!r}",
        f"E, NU = {model.material.youngs_modulus!r}, {model.material.poissons_ratio!r}  # kN/m2, -",
        f"WEIGHT = {weight!r}  # kN",
        f"THICKNESS = {json.dumps([panel.thickness for panel in model.panels])}  # m, by panel",
        f"COMBINATIONS = {json.dumps({k: dict(v) for k, v in model.combinations.items()})}",
        f"NODES = {json.dumps(mesh.nodes.tolist())}",
        f"SUPPORTS = {held!r}  # 1 where x, y, z and rotations about them are fixed",
        f"SPRINGS = {springs!r}  # node, axis, kN/m",
        f"ELEMENTS = {json.dumps(_elements(model, mesh))}  # panel, four nodes",
        f"LOADS = {_loads(model, mesh)!r}  # kN",
    ]  # fmt: skip
    return "\n".join(lines) + "\n" + RUN


def _elements(model: ExportModel, mesh: QuadMesh) -> list[list[int]]:
    panel = model.facet_panel[mesh.facet]
    return np.column_stack([panel, mesh.corners + 1]).tolist()


def _loads(model: ExportModel, mesh: QuadMesh) -> dict[str, dict[int, list[float]]]:
    """Return the nodal forces of each case, kN, by node."""
    cases = {}
    for case in model.load_cases:
        force = mesh_loads(model, mesh, load_on_facets(model, case))
        rows = np.flatnonzero(force.any(axis=1))
        cases[case.case] = dict(zip((rows + 1).tolist(), force[rows].tolist(), strict=True))
    return cases
