"""All formats by name: files, writer, libraries, and how to open them. A new one is one entry."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from foldshell.exchange.calculix import write_inp
from foldshell.exchange.fold_file import write_fold_file
from foldshell.exchange.ifc import write_ifc
from foldshell.exchange.mesh_files import write_glb, write_obj, write_ply, write_stl
from foldshell.exchange.model import ExportModel
from foldshell.exchange.opensees import write_opensees
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.panel_files import write_nesting, write_panels
from foldshell.exchange.rhino import hash_3dm, write_3dm
from foldshell.exchange.saf import write_saf
from foldshell.exchange.sap2000 import write_s2k
from foldshell.exchange.vtu_copy import copy_vtu

Writer = Callable[[ExportModel, tuple[Path, ...], ExportOptions], None]


@dataclass(frozen=True)
class Format:
    """One format: `files` with {design} for its name, in the order that `write` takes them.

    `libraries` are optional ones that it needs. `hash_content` is given where the bytes differ from
    run to run: it tells whether the content does.
    """

    files: tuple[str, ...]
    write: Writer
    holds: str
    opens: str
    libraries: tuple[str, ...] = ()
    hash_content: Callable[[Path], str] | None = None


def _both(suffix: str) -> tuple[str, str]:
    return f"{{design}}_sheet.{suffix}", f"{{design}}_solid.{suffix}"


FORMATS = {
    "3dm": Format(
        ("{design}.3dm",), write_3dm,
        "panels as planar Breps with user text, creases, supports, loads, target, flat pattern",
        "Rhino: File > Open, or Import into a model in metres", ("rhino3dm",), hash_3dm,
    ),
    "ifc": Format(
        ("{design}.ifc",), write_ifc,
        "IFC4: plates with thickness, material and checks, and the structural analysis model",
        "a BIM program or viewer: File > Open; an analysis program: Import IFC", ("ifcopenshell",),
    ),
    "saf": Format(
        ("{design}_saf.xlsx",), write_saf,
        "Structural Analysis Format 2.2: members, edge supports, surface loads, combinations",
        "SCIA Engineer, RFEM, FEM-Design, Allplan and others: Import > SAF",
    ),
    "s2k": Format(
        ("{design}.s2k",), write_s2k,
        "SAP2000: Shell-Thin areas in groups by panel, P-Delta and buckling cases",
        "SAP2000: File > Import > SAP2000 .s2k Text File",
    ),
    "inp": Format(
        ("{design}_1.inp", "{design}_2.inp"), write_inp,
        "CalculiX and Abaqus: S8R shells on two meshes, a step a combination, buckling",
        "ccx -i NAME, without .inp; Abaqus/CAE: File > Import > Model",
    ),
    "opensees": Format(
        ("{design}_opensees_1.py", "{design}_opensees_2.py"), write_opensees,
        "OpenSees: ASDShellQ4 on two meshes, load cases, combinations, sums of reactions",
        "pip install openseespy; python FILE.py OUT.json D2",
    ),
    "obj": Format(
        (*_both("obj"), "{design}_sheet.mtl"), write_obj, "folded sheet and thickened solid",
        "Blender: File > Import > Wavefront, with z up; Rhino: Import",
    ),
    "stl": Format(
        _both("stl"), write_stl, "folded sheet and thickened solid, single precision",
        "a slicer: open the solid, scale from metres",
    ),
    "ply": Format(
        _both("ply"), write_ply, "folded sheet and thickened solid with colours of classes",
        "MeshLab, Blender, CloudCompare: Import",
    ),
    "glb": Format(
        _both("glb"), write_glb, "folded sheet and thickened solid with colours of classes",
        "a browser's glTF viewer, Windows 3D Viewer, Blender: File > Import > glTF", ("trimesh",),
    ),
    "vtu": Format(
        ("{design}.vtu",), copy_vtu, "all final fields, envelopes and modes (design.vtu)",
        "ParaView: File > Open; legend and units stand in its field data",
    ),
    "fold": Format(
        ("{design}.fold",), write_fold_file, "pattern with target angles and the folding path",
        "Origami Simulator: File > Import; rabbit-ear, FOLD viewers",
    ),
    "panels": Format(
        ("panels.dxf", "panels.csv", "panels.xlsx"), write_panels,
        "each panel flat, with its neighbours, bend and mitre angles; measures and sums",
        "AutoCAD, LibreCAD, Rhino: File > Open; Excel for the tables", ("ezdxf",),
    ),
    "nesting": Format(
        ("sheets.dxf", "sheets.csv"), write_nesting, "panels nested on sheets, class by class",
        "AutoCAD, LibreCAD, a cutter's program: File > Open", ("ezdxf", "shapely", "spyrrow"),
    ),
}  # fmt: skip


def name_files(name: str, design: str) -> tuple[str, ...]:
    """Return the names of a format's files for a design."""
    return tuple(file.format(design=design) for file in FORMATS[name].files)
