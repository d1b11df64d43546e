"""A sheet that an outline cuts: the FOLD file and Rhino's flat pattern hold the exact pieces."""

from dataclasses import replace

import numpy as np
import pytest

from export_cases import DESIGN, PANELS, stage_settings, write_export_case
from foldshell.exchange.fold_file import write_fold_file
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.read_model import read_export_model
from foldshell.exchange.rhino import write_3dm
from foldshell.files.whole import read_json
from foldshell.pattern.panel_graph import make_ragged
from foldshell.pattern.panel_mesh import PanelMesh

FLAT = np.array([[0, 0, 0], [1, 0, 0], [1.5, 0.5, 0], [1, 1, 0], [0, 1, 0.0]])
PIECES = PanelMesh(
    make_ragged([[0, 1, 3, 4], [1, 2, 3]]),
    np.array([[0, 1], [1, 3], [3, 4], [0, 4], [1, 2], [2, 3]]),
    np.array(["B", "M", "B", "B", "B", "B"]),
    np.full(6, np.nan),
    flat=FLAT,
    folded=FLAT + np.array([0, 0, 2.0]),
    labels={"panel": np.array([0, 0])},
)


@pytest.fixture
def model(tmp_path):
    paths = write_export_case(tmp_path)
    return replace(read_export_model(paths, DESIGN, stage_settings()), pieces=PIECES)


def test_the_fold_file_holds_the_pieces(model, tmp_path):
    write_fold_file(model, (tmp_path / "a.fold",), ExportOptions(sources={"pattern": "unused"}))
    data = read_json(tmp_path / "a.fold")
    assert data["faces_vertices"] == [[0, 1, 3, 4], [1, 2, 3]]
    assert len(data["foldshell:panel_thickness_m"]) == PANELS
    assert np.array(data["vertices_coords"]) == pytest.approx(FLAT[:, :2])


def test_rhinos_flat_pattern_holds_the_pieces(model, tmp_path):
    rhino = pytest.importorskip("rhino3dm")
    write_3dm(model, (tmp_path / "a.3dm",), ExportOptions())
    file = rhino.File3dm.Read(str(tmp_path / "a.3dm"))
    names = [layer.FullPath for layer in file.Layers]
    flat = [
        item
        for item in file.Objects
        if names[item.Attributes.LayerIndex].startswith("FLAT PATTERN")
    ]
    assert len(flat) == 6
