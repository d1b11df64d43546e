"""Read .3dm by rhino3dm, in the process of its own that `child` is.

Meshes, planar polysurfaces, or one untrimmed surface: that one is sampled where its parameters
lie evenly, in double precision. Imports nothing of this project.
"""

import numpy as np

SAMPLES = 161
"""Points along each side of a sampled surface: facets of a 160th of the span sag by 1e-5 of it."""
UNITS = {"Meters": "metres", "Millimeters": "millimetres", "Centimeters": "centimetres",
         "Inches": "inches", "Feet": "feet"}  # fmt: skip
_PASSED_OVER = ("Curve", "Point", "PointSet", "Annotation", "TextDot", "Light", "Hatch", "Grip",
                "ClipPlane", "Detail", "Cage", "MorphControl")  # fmt: skip


def read_rhino(path: str, unit: str, refuse) -> dict:
    """Vertices, corner counts and corners of the polygons; `refuse` makes an error of a sentence.

    `unit` is the one that the model must have, empty for any.
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
    """Polygons of the visible objects of a model."""
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
    if len(faces) == 1 and solids[0].IsSurface and not faces[0].IsPlanar(1e-6):
        return _sample(faces[0])
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


def _sample(face) -> dict:
    """Quadrilaterals over a surface's domain."""
    surface = face.UnderlyingSurface()
    ranges = [surface.Domain(axis) for axis in (0, 1)]
    u, v = (np.linspace(r.T0, r.T1, SAMPLES) for r in ranges)
    points = [surface.PointAt(float(a), float(b)) for a in u for b in v]
    number = np.arange(SAMPLES**2).reshape(SAMPLES, SAMPLES)
    sides = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    quads = np.stack([side.ravel() for side in sides], axis=1)
    return {"vertices": np.array([(p.X, p.Y, p.Z) for p in points]),
            "sizes": np.full(len(quads), 4), "corners": quads.ravel(), "sampled": True}  # fmt: skip


def _join_planar(solids: list, refuse) -> dict:
    """Polygons of planar faces with straight edges."""
    vertices, sizes = [], []
    for brep in solids:
        for k in range(len(brep.Faces)):
            face = brep.Faces[k]
            if not face.IsPlanar(1e-6):
                raise refuse(
                    "holds trimmed or several curved faces: one untrimmed surface, planar faces, "
                    "or a mesh is allowed"
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
