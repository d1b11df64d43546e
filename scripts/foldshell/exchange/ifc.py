"""IFC4: the panels as plates, and the structural analysis model with supports and loads.

In m, N, Pa and rad, as SI has them. A planar panel is one plate and one surface member, of a bent
panel each facet is one, with the panel's number and the bend angle. Entities are made directly, and
identifiers follow from the design's name, so that the same design gives the same bytes.
"""

from pathlib import Path

from foldshell.exchange.ifc_analysis import add_analysis
from foldshell.exchange.ifc_file import IfcFile, open_file
from foldshell.exchange.ifc_plates import add_plates
from foldshell.exchange.model import ExportModel
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.saf import list_members
from foldshell.files.whole import atomic_path


def write_ifc(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the IFC file of a design."""
    file = open_file(model.design)
    members = list_members(model)
    building = _add_building(file, model)
    plates = add_plates(file, model, members, building)
    add_analysis(file, model, members, plates)
    with atomic_path(paths[0]) as temporary:
        temporary.write_text(file.to_text(), encoding="utf-8")


def _add_building(file: IfcFile, model: ExportModel):
    """Add site and building below the project; return the building."""
    place = file.make("IfcLocalPlacement", None, file.axes((0.0, 0.0, 0.0)))
    site = file.root("IfcSite", "site", Name="Site", ObjectPlacement=place)
    building = file.root("IfcBuilding", "building", Name=model.design, ObjectPlacement=place)
    file.relate("IfcRelAggregates", "project", file.project, [site])
    file.relate("IfcRelAggregates", "site", site, [building])
    return building
