"""An IFC4 file being filled: entities by name, identifiers from words, units and contexts."""

import uuid
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from foldshell.exchange.options import load_library

SPACE = uuid.UUID("6f6c6473-6865-4c6c-8000-000000000000")
"""Identifiers are named in it, from the design and the entity's own words."""
STAMP = "2026-01-01T00:00:00"
SI = {"LENGTHUNIT": "METRE", "AREAUNIT": "SQUARE_METRE", "VOLUMEUNIT": "CUBIC_METRE",
      "PLANEANGLEUNIT": "RADIAN", "FORCEUNIT": "NEWTON", "PRESSUREUNIT": "PASCAL",
      "TIMEUNIT": "SECOND", "MASSUNIT": "GRAM"}  # fmt: skip


@dataclass
class IfcFile:
    """The file, its project and its contexts of bodies and of references."""

    file: Any
    design: str
    library: Any
    project: Any = None
    body: Any = None
    reference: Any = None
    _points: dict = field(default_factory=dict)
    _directions: dict = field(default_factory=dict)

    def make(self, kind: str, *values: Any, **named: Any) -> Any:
        """Create an entity."""
        return self.file.create_entity(kind, *values, **named)

    def identifier(self, words: str) -> str:
        """Return the identifier that words have in this design."""
        name = uuid.uuid5(SPACE, f"{self.design}/{words}")
        return self.library.guid.compress(name.hex)

    def root(self, kind: str, words: str, **named: Any) -> Any:
        """Create an entity with an identifier of its own, from its kind and words."""
        return self.make(kind, GlobalId=self.identifier(f"{kind}/{words}"), **named)

    def relate(self, kind: str, words: str, relating: Any, related: Sequence[Any]) -> Any:
        """Relate objects to another: aggregates, properties, materials, groups."""
        known = {
            "IfcRelAggregates": ("RelatingObject", "RelatedObjects"),
            "IfcRelContainedInSpatialStructure": ("RelatingStructure", "RelatedElements"),
            "IfcRelDefinesByProperties": ("RelatingPropertyDefinition", "RelatedObjects"),
            "IfcRelAssociatesMaterial": ("RelatingMaterial", "RelatedObjects"),
            "IfcRelAssignsToGroup": ("RelatingGroup", "RelatedObjects"),
            "IfcRelAssignsToProduct": ("RelatingProduct", "RelatedObjects"),
        }
        one, many = known[kind]
        return self.root(kind, words, **{one: relating, many: list(related)})

    def point(self, place: Sequence[float]) -> Any:
        """Return a point, one entity for each place."""
        key = tuple(float(value) for value in place)
        if key not in self._points:
            self._points[key] = self.make("IfcCartesianPoint", key)
        return self._points[key]

    def direction(self, values: Sequence[float]) -> Any:
        """Return a direction, one entity for each."""
        key = tuple(float(value) for value in values)
        if key not in self._directions:
            self._directions[key] = self.make("IfcDirection", key)
        return self._directions[key]

    def axes(self, place, normal=(0.0, 0.0, 1.0), along=(1.0, 0.0, 0.0)) -> Any:
        """Return a placement in space."""
        return self.make("IfcAxis2Placement3D", self.point(place), self.direction(normal),
                         self.direction(along))  # fmt: skip

    def properties(self, name: str, words: str, values: dict[str, Any], objects: list) -> None:
        """Add a property set of single values: (IFC type, value) by name."""
        single = [
            self.make("IfcPropertySingleValue", Name=key, NominalValue=self.make(kind, value))
            for key, (kind, value) in values.items()
        ]
        made = self.root("IfcPropertySet", f"{words}/{name}", Name=name, HasProperties=single)
        self.relate("IfcRelDefinesByProperties", f"{words}/{name}", made, objects)

    def to_text(self) -> str:
        """Return the file with a fixed time in its head."""
        return self.file.to_string()


def open_file(design: str) -> IfcFile:
    """Return a file with project, units and contexts."""
    library = load_library("ifcopenshell")
    __import__("ifcopenshell.guid")
    file = library.file(schema="IFC4")
    head = file.header.file_name
    head.name, head.time_stamp = f"{design}.ifc", STAMP
    head.preprocessor_version = head.originating_system = "foldshell"
    made = IfcFile(file, design, library)
    world = made.make("IfcGeometricRepresentationContext", None, "Model", 3, 1e-6,
                      made.axes((0.0, 0.0, 0.0)))  # fmt: skip
    made.body, made.reference = (
        made.make("IfcGeometricRepresentationSubContext", ContextIdentifier=name,
                  ContextType="Model", ParentContext=world, TargetView=view)
        for name, view in (("Body", "MODEL_VIEW"), ("Reference", "GRAPH_VIEW"))
    )  # fmt: skip
    units = _units(made)
    made.project = made.root(
        "IfcProject", "project", Name=design, RepresentationContexts=[world], UnitsInContext=units
    )
    return made


def _units(file: IfcFile) -> Any:
    single = {
        kind: file.make("IfcSIUnit", None, kind, "KILO" if kind == "MASSUNIT" else None, name)
        for kind, name in SI.items()
    }

    def derived(kind: str, **powers: int) -> Any:
        """Return a unit that is a product of powers of others."""
        parts = [
            file.make("IfcDerivedUnitElement", single[name], power)
            for name, power in powers.items()
        ]
        return file.make("IfcDerivedUnit", parts, kind)

    more = [
        derived("PLANARFORCEUNIT", FORCEUNIT=1, AREAUNIT=-1),
        derived("LINEARFORCEUNIT", FORCEUNIT=1, LENGTHUNIT=-1),
        derived("MODULUSOFELASTICITYUNIT", FORCEUNIT=1, AREAUNIT=-1),
        derived("MODULUSOFLINEARSUBGRADEREACTIONUNIT", FORCEUNIT=1, AREAUNIT=-1),
        derived("MASSDENSITYUNIT", MASSUNIT=1, VOLUMEUNIT=-1),
    ]
    return file.make("IfcUnitAssignment", [*single.values(), *more])
