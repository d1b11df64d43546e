"""Run one task in one code and print its cost: `python bench_shell_run.py CODE TASK CASE N`.

A process of its own for every row, so that memory and CPU time are this task's alone. CPU time
counts from mesh arrays to displacements, without the interpreter's start, imports and tables of
elements; small linear tasks are done `REPEATS` times in the process, whose best counts, in
foldshell and in OpenSees. CalculiX is a program, and its own CPU time is that of the child process.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests"), str(ROOT / "tests" / "verification")]

from bench_shell_models import COMBINATION, peer_model  # noqa: E402
from bench_shell_stability import TASKS, Problem  # noqa: E402

from crosscheck.opensees import (  # noqa: E402
    ShellGrid,
    enter_shell,
    open_opensees,
    prepare_linear,
    solve_columns,
)
from foldshell.loads.cases import make_load_cases, surface_loads  # noqa: E402
from foldshell.settings.loads import Loads  # noqa: E402
from foldshell.shell import stiffness  # noqa: E402
from foldshell.shell.analysis import build_model  # noqa: E402
from foldshell.shell.assembly import assemble_stiffness  # noqa: E402
from foldshell.shell.geometric import geometric_tables  # noqa: E402
from foldshell.shell.linear_solver import factorise  # noqa: E402
from foldshell.shell.mesh import build_mesh  # noqa: E402
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays  # noqa: E402
from foldshell.shell.nodal_loads import nodal_forces  # noqa: E402
from foldshell.shell.reference import reference_triangle  # noqa: E402
from verification.folded_cases import CASES, CONCRETE, load_sheet  # noqa: E402

REPEATS = 3
"""Of linear tasks on fewer than six subdivisions."""

STIFF = "hhj, springs 1.7"
"""The same element with stiffer springs on slope jumps than the library's own: what it is off by on
three subdivisions is then below 5 % on all six folded sheets, where 1.5 to 1.8 do."""

SHAPES = {"ASDShellT3": "T3", "ASDShellQ4": "Q4", "S3": "T3", "S6": "T6", "S8R": "Q8"}


def run_opensees(case, n, element, system, task):
    """Return CPU s, wall s, dofs and the largest downward displacement."""
    repeats = REPEATS if n < 6 and task.startswith("linear") else 1
    return min(_run_opensees_once(case, n, element, system, task) for _ in range(repeats))


def _run_opensees_once(case, n, element, system, task):
    ops = open_opensees()
    model = peer_model(case, n, SHAPES[element])
    forces = model.forces if task == "linear7" else (model.forces[..., :5] @ COMBINATION)[..., None]
    began = time.process_time(), time.perf_counter()
    grid = ShellGrid(
        model.nodes, model.elements, model.supported, forces,
        np.full(len(model.elements), model.thickness), CONCRETE.youngs_modulus,
        CONCRETE.poissons_ratio,
    )  # fmt: skip
    second = task == "corotational"
    enter_shell(ops, grid, element, ["-corotational"] if second else [])
    if second:
        _prepare_newton(ops, system)
    else:
        prepare_linear(ops, system)
    value = 0.0
    for number in solve_columns(ops, grid, steps=2 if second else 1):
        moved = np.array([ops.nodeDisp(tag, 3) for tag in (grid.free + 1).tolist()])
        if number in (0, 2):
            value = -moved.min()
    cpu, wall = time.process_time() - began[0], time.perf_counter() - began[1]
    return cpu, wall, 6 * len(model.nodes) - 3 * len(model.supported), float(value)


def _prepare_newton(ops, system):
    """Set up second-order analysis in two steps."""
    ops.constraints("Plain")
    ops.numberer("RCM" if system != "UmfPack" else "Plain")
    ops.system(system)
    ops.test("NormDispIncr", 1e-8, 50)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.5)
    ops.analysis("Static")


def run_calculix(case, n, element, _system, task):
    """Return the child's CPU s and wall s, dofs as modelled and the displacement."""
    model = peer_model(case, n, SHAPES[element])
    forces = model.forces if task == "linear7" else (model.forces[..., :5] @ COMBINATION)[..., None]
    lines = ["*NODE,NSET=NALL"]
    lines += [f"{i},{x:.15g},{y:.15g},{z:.15g}" for i, (x, y, z) in enumerate(model.nodes, 1)]
    lines.append(f"*ELEMENT,TYPE={element},ELSET=EALL")
    lines += [
        ",".join(map(str, [i, *row])) for i, row in enumerate((model.elements + 1).tolist(), 1)
    ]
    lines.append("*NSET,NSET=HELD")
    lines += [f"{i}," for i in (model.supported + 1).tolist()]
    lines += [
        "*MATERIAL,NAME=C",
        "*ELASTIC",
        f"{CONCRETE.youngs_modulus},{CONCRETE.poissons_ratio}",
    ]
    lines += ["*SHELL SECTION,ELSET=EALL,MATERIAL=C", f"{model.thickness}"]
    lines += ["*BOUNDARY", "HELD,1,3"]
    for number in range(forces.shape[2]):
        lines += ["*STEP", "*STATIC", "*CLOAD,OP=NEW"]
        lines += [
            f"{node + 1},{axis + 1},{forces[node, axis, number]:.15g}"
            for node, axis in zip(*np.nonzero(forces[:, :, number]), strict=True)
        ]
        lines += ["*NODE PRINT,NSET=NALL", "U", "*END STEP"]
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "job.inp").write_text("\n".join(lines) + "\n")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        wall = time.perf_counter()
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                       timeout=900)  # fmt: skip
        wall = time.perf_counter() - wall
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        table = Path(folder, "job.dat").read_text().split("displacements")[-1].splitlines()[2:]
    moved = np.array([line.split()[1:4] for line in table if len(line.split()) == 4], float)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    dofs = 6 * len(model.nodes) - 3 * len(model.supported)
    return cpu, wall, dofs, float(-moved[:, 2].min())


def run_foldshell(case, n, element, solver, task):
    """Return CPU s, wall s, dofs and the largest downward displacement."""
    if task in TASKS:
        problem = Problem(case, n, solver)
        TASKS[task](problem)
        cpu, wall, value = min(TASKS[task](problem) for _ in range(3))
        return cpu, wall, problem.pattern.size, value
    if element == STIFF:
        stiffness.SLOPE_SPRING = 1.7
    factorise(*_tiny_problem(), solver)
    arrays = mesh_folded_sheet(load_sheet(case.sheet), case.support, n)
    mesh = mesh_from_arrays(arrays)
    geometric_tables(mesh.order)
    reference_triangle(mesh.order)
    repeats = REPEATS if n < 6 else 1
    return min(_solve_linear(case, mesh, arrays, solver, task) for _ in range(repeats))


def _solve_linear(case, mesh, arrays, solver, task):
    """Return what `run_foldshell` does, from mesh arrays on."""
    thickness = np.full(len(mesh.elements), case.thickness)
    began = time.process_time(), time.perf_counter()
    model = build_model(mesh, arrays["supported_nodes"], CONCRETE.poissons_ratio)
    normal = model.operators.geometry.frame[:, 2]
    surface = surface_loads(normal, thickness, make_load_cases(Loads(), CONCRETE.unit_weight))
    if task == "linear7":
        sideways = np.zeros((len(normal), 3, 2))
        sideways[:, 0, 0] = sideways[:, 1, 1] = CONCRETE.unit_weight * thickness
        surface = np.concatenate([surface, sideways], axis=2)
    else:
        surface = (surface @ COMBINATION)[..., None]
    forces = nodal_forces(model.operators, surface)
    values = assemble_stiffness(model.operators, model.pattern, thickness, CONCRETE.youngs_modulus)
    moved = np.zeros_like(forces)
    dofs = model.pattern.dofs
    moved[dofs] = factorise(model.pattern, values, solver).solve(forces[dofs])
    cpu, wall = time.process_time() - began[0], time.perf_counter() - began[1]
    column = 2 if task == "linear7" else 0
    return cpu, wall, model.pattern.size, float(-moved[2 : 3 * len(mesh.nodes) : 3, column].min())


def _tiny_problem():
    """Return a pattern and values that load the solver's library before the clock starts."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.2]])
    mesh = build_mesh(points, np.array([[0, 1, 2], [0, 2, 3]]), subdivisions=2)
    model = build_model(mesh, np.arange(4), 0.2)
    return model.pattern, assemble_stiffness(model.operators, model.pattern, np.ones(2), 1.0)


RUNNERS = {"foldshell": run_foldshell, "opensees": run_opensees, "calculix": run_calculix}


def main(code, element, system, task, case, n):
    """Print one row as json."""
    cpu, wall, dofs, value = RUNNERS[code](CASES[int(case)], int(n), element, system, task)
    who = resource.RUSAGE_CHILDREN if code == "calculix" else resource.RUSAGE_SELF
    print(json.dumps({
        "task": task, "code": f"{code} {element}".strip(), "solver": system, "dofs": dofs,
        "cpu_s": round(cpu, 4), "wall_s": round(wall, 4),
        "rss_mb": round(resource.getrusage(who).ru_maxrss / 1024, 1), "value": value,
        "case": str(CASES[int(case)]), "n": int(n),
    }))  # fmt: skip


if __name__ == "__main__":
    main(*sys.argv[1:])
