"""Read .3dm by rhino3dm, in the process of its own that `child` is.

Meshes, planar polysurfaces, or one untrimmed surface: that one is handed over as the control
points and knots that the file holds. Imports nothing of this project.
"""

import numpy as np

UNITS = {"Meters": "metres", "Millimeters": "millimetres", "Centimeters": "centimetres",
         "Inches": "inches", "Feet": "feet"}  # fmt: skip
_PASSED_OVER = ("Curve", "Point", "PointSet", "Annotation", "TextDot", "Light", "Hatch", "Grip",
                "ClipPlane", "Detail", "Cage", "MorphControl")  # fmt: skip


def read_rhino(path: str, unit: str, refuse) -> dict:
    """Vertices, corner counts and corners of the polygons, or one surface's points and knots.

    `refuse` makes an error of a sentence; `unit` is the one that the model must have, empty for
    any.
    """
    import rhino3dm

    file = rhino3dm.File3dm.Read(path)
    if file is None:
        raise refuse("damaged, cut off or no file of Rhino")
    name = str(file.Settings.ModelUnitSystem).rpartition(".")[2]
    declared = UNITS.get(name)
    if declared is None or declared != (unit or declared):
        due = unit or ", ".join(UNITS.values())
        raise refuse(f"the model is in {declared or name}: {due} are allowed")
    return {**_read_model(file, refuse), "unit": declared}


def _read_model(file, refuse) -> dict:
    """Polygons or the surface of the visible objects of a model."""
    meshes, solids = _gather(file, refuse)
    if meshes and solids:
        raise refuse(
            f"holds {len(meshes)} meshes and {len(solids)} surfaces: one of both kinds is allowed"
        )
    if meshes:
        return _join_meshes(meshes)
    if not solids:
        raise refuse("holds no mesh and no surface that is visible")
    faces = [brep.Faces[k] for brep in solids for k in range(len(brep.Faces))]
    if len(faces) == 1 and not faces[0].IsPlanar(1e-6):
        if not solids[0].IsSurface:
            raise refuse("holds a trimmed surface: untrim it, or export a mesh")
        return _take_nurbs(faces[0])
    return _join_planar(solids, refuse)


def _gather(file, refuse) -> tuple[list, list]:
    """Meshes and Breps of all visible objects."""
    meshes, solids = [], []
    hidden = {layer.Index for layer in file.Layers if not layer.Visible}
    for item in file.Objects:
        if not item.Attributes.Visible or item.Attributes.LayerIndex in hidden:
            continue
        geometry = item.Geometry
        kind = str(geometry.ObjectType).rpartition(".")[2]
        if kind == "Mesh":
            meshes.append(geometry)
        elif kind == "Brep":
            solids.append(geometry)
        elif kind == "Extrusion":
            solids.append(geometry.ToBrep(True))
        elif kind == "Surface":
            import rhino3dm

            solids.append(rhino3dm.Brep.CreateFromSurface(geometry))
        elif kind not in _PASSED_OVER:
            raise refuse(f"holds a {kind}: meshes and surfaces are allowed, explode blocks")
    return meshes, solids


def _join_meshes(meshes: list) -> dict:
    vertices, sizes, corners, first = [], [], [], 0
    for mesh in meshes:
        points = [(p.X, p.Y, p.Z) for p in (mesh.Vertices[k] for k in range(len(mesh.Vertices)))]
        for k in range(len(mesh.Faces)):
            a, b, c, d = mesh.Faces[k]
            face = [a, b, c] if c == d else [a, b, c, d]
            sizes.append(len(face))
            corners += [first + number for number in face]
        vertices += points
        first += len(points)
    return {
        "vertices": np.array(vertices, dtype=np.float32).reshape(-1, 3),
        "sizes": np.array(sizes, dtype=np.int64),
        "corners": np.array(corners, dtype=np.int64),
    }


def _take_nurbs(face) -> dict:
    """Control points (I, J, 4), times their weights, and the knots that Rhino keeps."""
    surface = face.UnderlyingSurface()
    if not hasattr(surface, "Points"):
        surface = surface.ToNurbsSurface()
    net = surface.Points
    stored = [[net[i, j] for j in range(net.CountV)] for i in range(net.CountU)]
    points = np.array([[(p.X, p.Y, p.Z, p.W) for p in row] for row in stored], dtype=float)
    knots = {
        name: np.array([kept[k] for k in range(len(kept))], dtype=float)
        for name, kept in (("knots_u", surface.KnotsU), ("knots_v", surface.KnotsV))
    }
    return {"points": points, **knots}


def _join_planar(solids: list, refuse) -> dict:
    """Polygons of planar faces with straight edges."""
    vertices, sizes = [], []
    for brep in solids:
        for k in range(len(brep.Faces)):
            face = brep.Faces[k]
            if not face.IsPlanar(1e-6):
                raise refuse(
                    "holds several curved faces, or curved and planar ones: one untrimmed "
                    "surface, planar faces, or a mesh is allowed"
                )
            if len(face.Loops) != 1:
                raise refuse("holds a planar face with a hole: faces of one outline are allowed")
            points = _trace(brep, face.OuterLoop, refuse)
            sizes.append(len(points))
            vertices += points
    total = np.arange(len(vertices))
    return {"vertices": np.array(vertices), "sizes": np.array(sizes), "corners": total}


def _trace(brep, loop, refuse) -> list:
    """Corners of an outline of straight lines."""
    points = []
    for trim in (loop.Trims[k] for k in range(loop.TrimCount)):
        if trim.EdgeIndex < 0 or not brep.Edges[trim.EdgeIndex].IsLinear(1e-6):
            raise refuse("holds a face with a curved outline: straight outlines are allowed")
        place = brep.Vertices[trim.StartVertexIndex].Location
        points.append((place.X, place.Y, place.Z))
    return points
