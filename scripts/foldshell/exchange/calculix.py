"""Input decks of CalculiX and Abaqus: S8R shells, one step a combination, and a buckling step.

In kN, m, s and t. A load along global axes is an acceleration of the facet that has its force, load
over density times thickness; the load against the normal is a pressure. Two files, of meshes n
times finer, allow for extrapolation.
"""

from pathlib import Path

import numpy as np

from foldshell.exchange.fe_mesh import QuadMesh, divide_facets
from foldshell.exchange.fe_supports import held_nodes, held_rotations, spring_nodes
from foldshell.exchange.model import ExportModel, load_on_facets
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import atomic_path

GRAVITY = 9.80665
MESHES = (1, 2)
"""Divisions n of the two meshes."""
MODES = 2


def _number(value: float) -> str:
    """Return a number in at most 20 characters, as many as CalculiX reads."""
    return f"{value:.12g}"


def write_inp(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write a deck for each of the two meshes."""
    for path, n in zip(paths, MESHES, strict=True):
        with atomic_path(path) as temporary:
            temporary.write_text(deck(model, n), encoding="ascii")


def deck(model: ExportModel, n: int) -> str:
    """Return the deck of a mesh of three times n x n elements a facet."""
    mesh = divide_facets(model, n, middles=True)
    lines = [
        "*HEADING",
        f"foldshell {model.design}: kN, m, s, t; facet F, panel P (B of an edge beam), n = {n}",
        *_mesh_lines(model, mesh),
        *_normal_lines(model, mesh),
        *_property_lines(model),
        *_support_lines(model, mesh),
    ]
    for name, factors in model.combinations.items():
        lines += ["*STEP", "*STATIC", *_comment(name, factors), *_load_lines(model, factors)]
        lines += _output_lines()
    name = model.compared["strength"]
    lines += ["*STEP", f"** buckling factors of {name}", "*BUCKLE", f"{MODES}"]
    lines += [*_load_lines(model, model.combinations[name]), "*NODE FILE", "U", "*END STEP", ""]
    return "\n".join(lines)


def _mesh_lines(model: ExportModel, mesh: QuadMesh) -> list[str]:
    lines = ["*NODE, NSET=NALL"]
    lines += [
        f"{k}, {', '.join(map(_number, point))}" for k, point in enumerate(mesh.nodes.tolist(), 1)
    ]
    rows = (mesh.elements + 1).tolist()
    first = np.searchsorted(mesh.facet, np.arange(len(model.facets) + 1))
    for facet in range(len(model.facets)):
        lines.append(f"*ELEMENT, TYPE=S8R, ELSET=F{facet}")
        for number in range(first[facet], first[facet + 1]):
            lines.append(", ".join(map(str, [number + 1, *rows[number]])))
    return lines


def _normal_lines(model: ExportModel, mesh: QuadMesh) -> list[str]:
    """Return each facet's own normal at its nodes on edges to others.

    Without them CalculiX takes a mean normal where facets meet at less than 20 degrees: slabs lean,
    and volume is lost.
    """
    facets = np.repeat(mesh.facet, mesh.elements.shape[1])
    owners = np.unique(np.column_stack([mesh.elements.ravel(), facets]), axis=0)[:, 0]
    shared = np.bincount(owners, minlength=len(mesh.nodes)) > 1
    text = [", ".join(map(_number, normal)) for normal in model.normals.tolist()]
    lines = ["*NORMAL"]
    for number, (nodes, facet) in enumerate(zip(mesh.elements, mesh.facet, strict=True), 1):
        lines += [f"{number}, {node + 1}, {text[facet]}" for node in nodes[shared[nodes]].tolist()]
    return lines


def _property_lines(model: ExportModel) -> list[str]:
    material = model.material
    lines = ["*MATERIAL, NAME=SHELL", "*ELASTIC"]
    lines += [f"{_number(material.youngs_modulus)}, {_number(material.poissons_ratio)}"]
    lines += ["*DENSITY", _number(material.unit_weight / GRAVITY)]
    for panel in model.panels:
        lines.append(f"*ELSET, ELSET={panel.name}")
        lines += [f"F{facet}" for facet in panel.facets]
        lines += [f"*SHELL SECTION, ELSET={panel.name}, MATERIAL=SHELL", _number(panel.thickness)]
    return lines


def _support_lines(model: ExportModel, mesh: QuadMesh) -> list[str]:
    lines, held = ["*NSET, NSET=SUPPORTED"], held_nodes(model, mesh)
    springs, turned = spring_nodes(model, mesh), held_rotations(model, mesh)
    every = [node + 1 for node in sorted({*held, *springs, *turned})]
    lines += [", ".join(map(str, every[k : k + 12])) for k in range(0, len(every), 12)]
    lines.append("*BOUNDARY")
    for first, known in ((1, held), (4, turned)):
        for node, fixed in known.items():
            axes = [axis for axis, is_held in enumerate(fixed, first) if is_held]
            lines += [f"{node + 1}, {axis}, {axis}" for axis in axes]
    return lines + _spring_lines(springs, len(mesh.elements))


def _spring_lines(springs: dict[int, tuple[float, float, float]], elements: int) -> list[str]:
    """Return one spring to the ground for each node and direction, numbered after the elements."""
    lines, number = [], elements
    for node, stiffness in springs.items():
        for axis, value in enumerate(stiffness, 1):
            if value:
                number += 1
                lines += [f"*ELEMENT, TYPE=SPRING1, ELSET=SPRING{number}", f"{number}, {node + 1}",
                          f"*SPRING, ELSET=SPRING{number}", f"{axis}", _number(value)]  # fmt: skip
    return lines


def _comment(name: str, factors) -> list[str]:
    return [f"** {name} = {' + '.join(f'{factor:g} {case}' for case, factor in factors.items())}"]


def _load_lines(model: ExportModel, factors) -> list[str]:
    """Return the loads of a combination: one acceleration and one pressure for each facet."""
    known = [case for case in model.load_cases if factors.get(case.case)]
    along = np.zeros((len(model.facets), 3))
    pressure = np.zeros(len(model.facets))
    for case in known:
        load = factors[case.case] * load_on_facets(model, case)
        if case.direction is None:
            pressure += np.einsum("fx,fx->f", load, model.normals)
        else:
            along += load
    mass = model.material.unit_weight / GRAVITY * model.thickness
    size = np.linalg.norm(along, axis=1)
    unit = along / np.where(size > 0, size, 1)[:, None]
    lines = ["*DLOAD, OP=NEW"]
    for facet, acceleration in enumerate((size / mass).tolist()):
        if acceleration:
            values = ", ".join(map(_number, [acceleration, *unit[facet]]))
            lines.append(f"F{facet}, GRAV, {values}")
        if pressure[facet]:
            lines.append(f"F{facet}, P, {_number(pressure[facet])}")
    return lines


def _output_lines() -> list[str]:
    return ["*NODE FILE, OUTPUT=2D", "U", "*EL FILE, OUTPUT=2D", "S",
            "*NODE PRINT, NSET=SUPPORTED, TOTALS=ONLY", "RF", "*NODE PRINT, NSET=NALL", "U",
            "*END STEP"]  # fmt: skip
