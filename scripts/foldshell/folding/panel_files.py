"""Files of a folded sheet of any panels: folded.npz, folded.vtu, quality.json."""

from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.folding.panel_quality import (
    FacetNet,
    make_facet_net,
    measure_facet_strain,
    measure_panel_quality,
    measure_panel_warp,
)
from foldshell.pattern.folded_panels import number_kinds
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Frame
from foldshell.records.arrays import write_typed_arrays
from foldshell.records.files import write_record
from foldshell.records.quality import QualityMeasures, QualityRecord
from foldshell.records.sheet_arrays import FoldedArrays


@dataclass(frozen=True)
class FoldedPanels:
    """A folded sheet of panels: the mesh with its folded state, its facets, quality and state.

    `attracted` (N,) are the vertices drawn to a target and `distances` (V,) m those to it, None
    without one; `residuals` are further measures of the mode by name, `path` steps from flat.
    """

    mesh: PanelMesh
    net: FacetNet
    quality: QualityMeasures
    state: str
    reason: str
    iterations: int = 0
    seconds: float = 0.0
    attracted: np.ndarray | None = None
    distances: np.ndarray | None = None
    residuals: dict[str, float] = field(default_factory=dict)
    path: tuple[Frame, ...] = ()


def take_folded(mesh: PanelMesh) -> FoldedPanels:
    """Take a sheet that is folded already as it stands in its file."""
    net = make_facet_net(mesh)
    quality = measure_panel_quality(mesh, net)
    reason = "taken as it stands in its file"
    if quality.self_intersections:
        reason += f", with {quality.self_intersections} facet pairs that cut each other"
    return FoldedPanels(mesh, net, quality, "ok", reason)


def describe_panels(result: FoldedPanels) -> QualityRecord:
    """Build the record of quality.json."""
    return QualityRecord(
        state=result.state,
        reason=result.reason,
        **asdict(result.quality),
        **result.residuals,
        notes=result.mesh.notes or None,
        iterations=result.iterations,
        seconds=round(result.seconds, 4),
    )


def panel_arrays(result: FoldedPanels) -> FoldedArrays:
    """Return the contents of folded.npz."""
    return mesh_arrays(result.mesh, result.net.facets, result.net.facet_panel)


def mesh_arrays(mesh: PanelMesh, facets: np.ndarray, facet_panel: np.ndarray) -> FoldedArrays:
    """Return the contents of folded.npz for panels of any number of corners.

    facets (F, 3) vertices of `mesh`, facet_panel (F,) panel of each, as indices
    """
    return FoldedArrays(
        vertices=mesh.vertices,
        facets=facets,
        planarity=measure_panel_warp(mesh.vertices, mesh.panels),
        facet_panel=facet_panel,
        panel_starts=mesh.panels.starts,
        panel_corners=mesh.panels.corners,
        edges=mesh.edges,
        edge_kind=number_kinds(mesh.assignments),
        flat=mesh.flat,
        strain=measure_facet_strain(mesh, facets),
        panel_row=mesh.labels.get("row"),
        panel_place=mesh.labels.get("place"),
    )


def write_panels(
    folded: str | Path, vtu: str | Path, quality: str | Path, result: FoldedPanels
) -> None:
    """Write folded.npz, folded.vtu and quality.json."""
    write_typed_arrays(folded, panel_arrays(result))
    _write_vtu(vtu, result)
    write_record(quality, describe_panels(result))


def _write_vtu(path: str | Path, result: FoldedPanels) -> None:
    import meshio  # only here: the stages that follow read folded.npz

    mesh, net = result.mesh, result.net
    panel, points = net.facet_panel, {}
    warp = measure_panel_warp(mesh.vertices, mesh.panels)
    cells = {"panel": [panel], "planarity": [warp[panel]]}
    strain = measure_facet_strain(mesh, net.facets)
    if strain is not None:
        cells["strain"] = [strain]
    cells |= {f"panel_{name}": [values[panel]] for name, values in mesh.labels.items()}
    if result.distances is not None:
        attracted = np.zeros(len(mesh.vertices), dtype=int)
        attracted[result.attracted] = 1
        points = {"distance": result.distances, "attracted": attracted}
    grid = meshio.Mesh(mesh.vertices, [("triangle", net.facets)], point_data=points,
                       cell_data=cells)  # fmt: skip
    with atomic_path(path) as temporary:
        meshio.write(temporary, grid, file_format="vtu")
