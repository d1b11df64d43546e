"""The structural analysis model of IFC4: surface members, edge connections, loads, combinations."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from foldshell.exchange.fe_supports import clamp_axes
from foldshell.exchange.ifc_file import IfcFile
from foldshell.exchange.model import ExportModel, Support
from foldshell.exchange.saf import FREE, Member, surface_action
from foldshell.loads.cases import WEIGHT, SurfaceLoad

AXES = "XYZ"
SOURCES = {"permanent": "DEAD_LOAD_G", "wind": "WIND_W", "snow": "SNOW_S"}
"""Sources of actions by their kind."""


def add_analysis(
    file: IfcFile, model: ExportModel, members: tuple[Member, ...], plates: list[Any]
) -> None:
    """Add the model: members and connections in one group, load cases and combinations."""
    topology = _Topology(file, model)
    surfaces = [_add_member(file, topology, member) for member in members]
    for member, surface, plate in zip(members, surfaces, plates, strict=True):
        file.relate("IfcRelAssignsToProduct", member.name, plate, [surface])
    joined = _add_connections(file, model, topology, members, surfaces)
    joined += _add_points(file, model, topology, members, surfaces)
    cases = [_add_case(file, model, case, members, surfaces) for case in model.load_cases]
    combinations = _add_combinations(file, model, cases)
    place = file.make("IfcLocalPlacement", None, file.axes((0.0, 0.0, 0.0)))
    analysis = file.root(
        "IfcStructuralAnalysisModel", "model", Name=model.design, PredefinedType="LOADING_3D",
        LoadedBy=[*cases, *combinations], SharedPlacement=place,
    )  # fmt: skip
    for item in (*surfaces, *joined):
        item.ObjectPlacement = place
    file.relate("IfcRelAssignsToGroup", "model", analysis, [*surfaces, *joined])
    file.root("IfcRelDeclares", "model", RelatingContext=file.project,
              RelatedDefinitions=[analysis])  # fmt: skip


class _Topology:
    """Vertices and edges of the sheet, one entity each."""

    def __init__(self, file: IfcFile, model: ExportModel):
        self.file, self.model = file, model
        self.vertices: dict[int, Any] = {}
        self.edges: dict[tuple[int, int], Any] = {}

    def vertex(self, number: int) -> Any:
        """Return the vertex of a number."""
        if number not in self.vertices:
            point = self.file.point(self.model.vertices[number])
            self.vertices[number] = self.file.make("IfcVertexPoint", point)
        return self.vertices[number]

    def edge(self, first: int, second: int) -> Any:
        """Return the edge between two vertices, from the lower to the higher number."""
        key = (min(first, second), max(first, second))
        if key not in self.edges:
            self.edges[key] = self.file.make("IfcEdge", *map(self.vertex, key))
        return self.edges[key]

    def face(self, member: Member) -> Any:
        """Return the face of a member, its loop counter-clockwise about the normal."""
        file, ring = self.file, member.vertices
        pairs = zip(ring, [*ring[1:], ring[0]], strict=True)
        sides = [file.make("IfcOrientedEdge", EdgeElement=self.edge(a, b), Orientation=a < b)
                 for a, b in pairs]  # fmt: skip
        bound = file.make("IfcFaceOuterBound", file.make("IfcEdgeLoop", sides), True)
        along = self.model.vertices[ring[1]] - self.model.vertices[ring[0]]
        axes = file.axes(self.model.vertices[ring[0]], member.normal,
                         along / np.linalg.norm(along))  # fmt: skip
        return file.make("IfcFaceSurface", [bound], file.make("IfcPlane", axes), True)

    def show(self, item: Any, kind: str) -> Any:
        """Return the representation of a face or an edge."""
        shape = self.file.make("IfcTopologyRepresentation", self.file.reference, "Reference",
                               kind, [item])  # fmt: skip
        return self.file.make("IfcProductDefinitionShape", None, None, [shape])


def _add_member(file: IfcFile, topology: _Topology, member: Member) -> Any:
    return file.root(
        "IfcStructuralSurfaceMember", member.name, Name=member.name,
        Representation=topology.show(topology.face(member), "Face"),
        PredefinedType="SHELL", Thickness=float(member.panel.thickness),
    )  # fmt: skip


def _condition(file: IfcFile, support: Support, turned: Sequence[bool]) -> Any:
    """Return a support's condition along an edge: fixed, free, or a spring in N/m2; and the axes
    about which it is clamped."""
    values = _hold(file, support, "IfcModulusOfLinearSubgradeReactionMeasure")
    held = [file.make("IfcBoolean", bool(fixed)) for fixed in turned]
    return file.make("IfcBoundaryEdgeCondition", support.name, *values, *held)


def _hold(file: IfcFile, support: Support, kind: str) -> list[Any]:
    return [
        file.make(kind, 1000.0 * spring)
        if spring and not fixed
        else file.make("IfcBoolean", bool(fixed))
        for fixed, spring in zip(support.fixed, support.spring, strict=True)
    ]


def _hold_edges(file: IfcFile, model: ExportModel) -> dict[tuple[int, int], Any]:
    """Return the condition of each supported edge; edges of one support and kind share it."""
    held: dict[tuple[int, int], Any] = {}
    for support in model.supports:
        turns = clamp_axes(model, support) if support.clamp else [FREE] * len(support.edges)
        known: dict[tuple[bool, ...], Any] = {}
        for pair, turned in zip(np.sort(support.edges, axis=1).tolist(), turns, strict=True):
            if turned not in known:
                known[turned] = _condition(file, support, turned)
            held[tuple(pair)] = known[turned]
    return held


def _add_points(
    file: IfcFile, model: ExportModel, topology: _Topology, members, surfaces: list[Any]
) -> list[Any]:
    """Add a connection at every vertex that a support holds by itself."""
    made = []
    for support in model.supports:
        if not len(support.vertices):
            continue
        values = _hold(file, support, "IfcLinearStiffnessMeasure")
        free = [file.make("IfcBoolean", False) for _ in AXES]
        condition = file.make("IfcBoundaryNodeCondition", support.name, *values, *free)
        for vertex in support.vertices.tolist():
            name = f"V{vertex}"
            connection = file.root(
                "IfcStructuralPointConnection", name, Name=name, AppliedCondition=condition,
                Representation=topology.show(topology.vertex(vertex), "Vertex"),
            )  # fmt: skip
            for k in (k for k, member in enumerate(members) if vertex in member.vertices):
                file.root("IfcRelConnectsStructuralMember", f"{name}/{members[k].name}",
                          RelatingStructuralMember=surfaces[k],
                          RelatedStructuralConnection=connection)  # fmt: skip
            made.append(connection)
    return made


def _add_connections(
    file: IfcFile, model: ExportModel, topology: _Topology, members, surfaces: list[Any]
) -> list[Any]:
    """Add a connection on every edge, with a relation to each member there, and its support."""
    held = _hold_edges(file, model)
    owners: dict[tuple[int, int], list[int]] = {}
    for k, member in enumerate(members):
        for a, b in zip(member.vertices, [*member.vertices[1:], member.vertices[0]], strict=True):
            owners.setdefault((min(a, b), max(a, b)), []).append(k)
    made = []
    for (a, b), own in sorted(owners.items()):
        if len(own) < 2 and (a, b) not in held:
            continue
        name, up = f"E{a}-{b}", file.direction(_upright(model, a, b))
        connection = file.root(
            "IfcStructuralCurveConnection", name, Name=name, Axis=up,
            Representation=topology.show(topology.edge(a, b), "Edge"),
            AppliedCondition=held.get((a, b)),
        )  # fmt: skip
        for k in own:
            file.root("IfcRelConnectsStructuralMember", f"{name}/{members[k].name}",
                      RelatingStructuralMember=surfaces[k],
                      RelatedStructuralConnection=connection)  # fmt: skip
        made.append(connection)
    return made


def _upright(model: ExportModel, a: int, b: int) -> tuple[float, float, float]:
    """Return z, or x where the edge itself is upright: the connection's own axis."""
    along = model.vertices[b] - model.vertices[a]
    steep = abs(along[2]) > 0.99 * np.linalg.norm(along)
    return (1.0, 0.0, 0.0) if steep else (0.0, 0.0, 1.0)


def _add_case(
    file: IfcFile, model: ExportModel, case: SurfaceLoad, members, surfaces: list[Any]
) -> Any:
    """Add a load case, with an action on each member that carries it."""
    permanent, source = case.action == "permanent", SOURCES.get(case.action, "LIVE_LOAD_Q")
    made = file.root(
        "IfcStructuralLoadCase", case.case, Name=case.case, PredefinedType="LOAD_CASE",
        ActionType="PERMANENT_G" if permanent else "VARIABLE_Q", ActionSource=source,
        SelfWeightCoefficients=[0.0, 0.0, -1.0] if case.kind == WEIGHT else None,
    )  # fmt: skip
    if case.kind == WEIGHT or not case.value:
        return made
    loads: dict[tuple, Any] = {}
    actions = []
    for member, surface in zip(members, surfaces, strict=True):
        if member.panel.sized:
            for axis, value, system, place in surface_action(model, case, member):
                key = tuple(1000.0 * value if axis == other else None for other in AXES)
                if key not in loads:
                    loads[key] = file.make("IfcStructuralLoadPlanarForce", case.case, *key)
                actions.append(_add_action(file, case, member, surface, loads[key], system, place))
    file.relate("IfcRelAssignsToGroup", f"actions/{case.case}", made, actions)
    return made


def _add_action(file: IfcFile, case, member: Member, surface, load, system, place) -> Any:
    words = f"{case.case}/{member.name}"
    action = file.root(
        "IfcStructuralSurfaceAction", words, Name=f"{case.case} {member.name}",
        AppliedLoad=load, GlobalOrLocal=f"{system.upper()}_COORDS", DestabilizingLoad=False,
        ProjectedOrTrue="PROJECTED_LENGTH" if place == "Projection" else "TRUE_LENGTH",
        PredefinedType="CONST", ObjectPlacement=None, Representation=surface.Representation,
    )  # fmt: skip
    file.root("IfcRelConnectsStructuralActivity", words, RelatingElement=surface,
              RelatedStructuralActivity=action)  # fmt: skip
    return action


def _add_combinations(file: IfcFile, model: ExportModel, cases: list[Any]) -> list[Any]:
    """Add the combinations, each with its cases by factor."""
    by_name = {case.Name: case for case in cases}
    made = []
    for name, factors in model.combinations.items():
        purpose = "ULTIMATE" if name in model.groups["strength"] else "SERVICEABILITY"
        group = file.root(
            "IfcStructuralLoadGroup", name, Name=name, PredefinedType="LOAD_COMBINATION",
            ActionType="NOTDEFINED", ActionSource="NOTDEFINED", Purpose=purpose,
        )  # fmt: skip
        for case, factor in factors.items():
            file.root("IfcRelAssignsToGroupByFactor", f"{name}/{case}", RelatingGroup=group,
                      RelatedObjects=[by_name[case]], Factor=float(factor))  # fmt: skip
        made.append(group)
    return made
