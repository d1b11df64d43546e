"""Pictures of a folding path: one still a state, and all of them as an animated GIF."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.folding.panel_quality import make_facet_net
from foldshell.pattern.grid import Grid
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Sheet

COLOURS = ("#d9c7a0", "#b7a27a")  # panels by parity of their column
SIZE = (960, 720)


def draw_states(states: Sequence[np.ndarray], grid: Grid) -> list[np.ndarray]:
    """Render states (V, 3) [m] from one camera that holds all of them: RGB images (h, w, 3).

    States are centred in plan, so that the sheet closes towards its middle.
    """
    parity = np.repeat(grid.strip_index[grid.quads[:, 0]] % 2, 2)
    return _render(states, grid.facets, parity, grid.edges[grid.assignments != "F"])


def draw_panel_states(states: Sequence[np.ndarray], mesh: PanelMesh) -> list[np.ndarray]:
    """Render states (V, 3) [m] of panels that are no grid, as `draw_states` does."""
    flat = make_facet_net(replace(mesh, rest=None, folded=None))
    return _render(states, flat.facets, flat.facet_panel % 2, mesh.edges)


def _render(
    states: Sequence[np.ndarray], facets: np.ndarray, parity: np.ndarray, lines: np.ndarray
) -> list[np.ndarray]:
    """Images of facets (F, 3) coloured by their parity (F,), with lines (K, 2) on them."""
    import pyvista

    centred = [s - [*(0.5 * (s.min(axis=0) + s.max(axis=0)))[:2], s[:, 2].min()] for s in states]
    reach = max(np.abs(state).max() for state in centred)
    plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE))
    mesh = pyvista.PolyData.from_regular_faces(centred[0], facets)
    mesh.cell_data["column"] = parity
    plotter.add_mesh(mesh, scalars="column", cmap=list(COLOURS), show_scalar_bar=False)
    cells = np.column_stack([np.full(len(lines), 2), lines]).ravel()
    creases = pyvista.PolyData(centred[0].copy(), lines=cells)
    plotter.add_mesh(creases, color="black", line_width=1.5)
    plotter.camera_position = [
        (1.9 * reach, -2.8 * reach, 2.0 * reach), (0, 0, 0.15 * reach), (0, 0, 1),
    ]  # fmt: skip
    images = []
    for state in centred:
        mesh.points, creases.points = state, state
        plotter.render()
        images.append(np.array(plotter.screenshot(return_img=True)))
    plotter.close()
    return images


def list_states(sheet: Sheet) -> list[np.ndarray]:
    """States of a sheet's folding path, flat state first. Each is (V, 3) m."""
    path = [frame.vertices for frame in sheet.path]
    starts_flat = bool(path) and np.ptp(path[0][:, 2]) <= 1e-9 * np.ptp(path[0])
    return path if starts_flat else [sheet.flat, *path]


def write_animation(path: str | Path, images: Sequence[np.ndarray], seconds: float = 0.2) -> None:
    """Write images as a GIF that folds and unfolds without end.

    Each image is (height, width, 3) uint8; `seconds` is the time of one.
    """
    from PIL import Image

    there = [Image.fromarray(image) for image in images]
    frames = there + there[-2:0:-1]
    with atomic_path(path) as temporary:
        frames[0].save(
            temporary, format="GIF", save_all=True, append_images=frames[1:],
            duration=int(1000 * seconds), loop=0,
        )  # fmt: skip


def write_stills(folder: str | Path, images: Sequence[np.ndarray]) -> list[Path]:
    """Write images as still_00.png, still_01.png, ... into a folder; return their paths.

    Each image is (height, width, 3) uint8.
    """
    from PIL import Image

    paths = [Path(folder) / f"still_{number:02d}.png" for number in range(len(images))]
    for path, image in zip(paths, images, strict=True):
        with atomic_path(path) as temporary:
            Image.fromarray(image).save(temporary, format="PNG")
    return paths
