"""Plates of IFC4: extruded panels with material layers, quantities and property sets."""

import math
from typing import Any

import numpy as np

from foldshell.exchange.ifc_file import IfcFile
from foldshell.exchange.model import ExportModel
from foldshell.exchange.saf import Member

GRAVITY = 9.80665


def add_plates(
    file: IfcFile, model: ExportModel, members: tuple[Member, ...], building: Any
) -> list[Any]:
    """Add a plate for each member; return them in the order of the members."""
    plates = [_add_plate(file, model, member) for member in members]
    file.relate("IfcRelContainedInSpatialStructure", "plates", building, plates)
    _add_materials(file, model, members, plates)
    return plates


def _add_plate(file: IfcFile, model: ExportModel, member: Member) -> Any:
    points, thickness = model.vertices[member.vertices], member.panel.thickness
    along = points[1] - points[0]
    along /= np.linalg.norm(along)
    across = np.cross(member.normal, along)
    flat = np.column_stack([(points - points[0]) @ along, (points - points[0]) @ across])
    line = [file.make("IfcCartesianPoint", tuple(p)) for p in flat.tolist()]
    curve = file.make("IfcPolyline", [*line, line[0]])
    profile = file.make("IfcArbitraryClosedProfileDef", "AREA", None, curve)
    low = points[0] - thickness / 2 * member.normal
    solid = file.make("IfcExtrudedAreaSolid", profile, file.axes(low, member.normal, along),
                      file.direction((0.0, 0.0, 1.0)), float(thickness))  # fmt: skip
    shape = file.make("IfcShapeRepresentation", file.body, "Body", "SweptSolid", [solid])
    plate = file.root(
        "IfcPlate", member.name, Name=member.name, Tag=member.panel.name,
        ObjectPlacement=file.make("IfcLocalPlacement", None, file.axes((0.0, 0.0, 0.0))),
        Representation=file.make("IfcProductDefinitionShape", None, None, [shape]),
        PredefinedType="SHEET",
    )  # fmt: skip
    area = _area(flat)
    _add_quantities(file, member, plate, area)
    _add_properties(file, model, member, plate)
    return plate


def _area(flat: np.ndarray) -> float:
    x, y = flat.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _add_quantities(file: IfcFile, member: Member, plate: Any, area: float) -> None:
    thickness = float(member.panel.thickness)
    quantities = [
        file.make("IfcQuantityLength", Name="Width", LengthValue=thickness),
        file.make("IfcQuantityArea", Name="NetArea", AreaValue=area),
        file.make("IfcQuantityVolume", Name="NetVolume", VolumeValue=area * thickness),
    ]
    made = file.root("IfcElementQuantity", member.name, Name="Qto_PlateBaseQuantities",
                     Quantities=quantities)  # fmt: skip
    file.relate("IfcRelDefinesByProperties", f"{member.name}/quantities", made, [plate])


def _add_properties(file: IfcFile, model: ExportModel, member: Member, plate: Any) -> None:
    panel = member.panel
    values: dict[str, tuple[str, Any]] = {
        "Panel": ("IfcInteger", panel.number),
        "ThicknessClass": ("IfcInteger", panel.thickness_class),
        "Planar": ("IfcBoolean", panel.planar),
        "PartOfEdgeBeam": ("IfcBoolean", not panel.sized),
    }
    if not panel.planar:
        bends = " ".join(f"{math.degrees(bend):.9g}" for bend in panel.bends)
        values["BendAngleDeg"] = ("IfcText", bends)
    if panel.class_thickness is not None:
        values["ClassThickness"] = ("IfcPositiveLengthMeasure", panel.class_thickness)
    file.properties("Foldshell_Panel", member.name, values, [plate])
    checks = {name: ("IfcReal", value) for name, value in panel.values.items()}
    if checks:
        file.properties("Foldshell_Checks", member.name, checks, [plate])


def _add_materials(file: IfcFile, model: ExportModel, members, plates: list[Any]) -> None:
    """Add the material with its mechanics, and a layer set for each thickness."""
    material = file.make("IfcMaterial", model.material.name)
    given = model.material
    shear = given.youngs_modulus / (2 * (1 + given.poissons_ratio))
    mechanics = {
        "YoungModulus": ("IfcModulusOfElasticityMeasure", 1000 * given.youngs_modulus),
        "ShearModulus": ("IfcModulusOfElasticityMeasure", 1000 * shear),
        "PoissonRatio": ("IfcPositiveRatioMeasure", given.poissons_ratio),
    }
    common = {"MassDensity": ("IfcMassDensityMeasure", 1000 * given.unit_weight / GRAVITY)}
    strength = {"CompressiveStrength": ("IfcPressureMeasure", 1000 * given.strength)}
    sets = {"Pset_MaterialMechanical": mechanics, "Pset_MaterialCommon": common,
            "Pset_MaterialConcrete": strength}  # fmt: skip
    for name, values in sets.items():
        single = [
            file.make("IfcPropertySingleValue", Name=key, NominalValue=file.make(kind, value))
            for key, (kind, value) in values.items()
        ]
        file.make("IfcMaterialProperties", Name=name, Properties=single, Material=material)
    owners: dict[float, list[Any]] = {}
    for member, plate in zip(members, plates, strict=True):
        owners.setdefault(float(member.panel.thickness), []).append(plate)
    for thickness, own in sorted(owners.items()):
        layer = file.make("IfcMaterialLayer", Material=material, LayerThickness=thickness)
        layers = file.make("IfcMaterialLayerSet", [layer], f"{1000 * thickness:.6g} mm")
        usage = file.make("IfcMaterialLayerSetUsage", layers, "AXIS3", "POSITIVE", -thickness / 2)
        file.relate("IfcRelAssociatesMaterial", f"{thickness!r}", usage, own)
