"""The panel that governs: number, place, words."""

from types import SimpleNamespace

import numpy as np

from foldshell.report.places import find_panel, read_panels


def test_the_most_utilized_panel_stands_at_the_mean_of_its_corners():
    """A unit square beside one of 2 x 1 m that lies 3 m higher: its middle is 2, 0.5, 3."""
    flat = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    high = [[1, 0, 3], [3, 0, 3], [3, 1, 3], [1, 1, 3]]
    folded = SimpleNamespace(
        vertices=np.array(flat + high, dtype=float), quads=np.array([[0, 1, 2, 3], [4, 5, 6, 7]])
    )
    found = find_panel(np.array([0.4, 0.9]), folded)
    assert found.words == "panel 1 at x 2.0, y 0.5, z 3.0 m"
    assert find_panel(np.array([0.9, np.nan]), folded).panel == 0
    assert find_panel(None, folded) is None
    assert find_panel(np.full(2, np.nan), folded) is None


def test_files_that_are_missing_name_no_place(tmp_path):
    assert read_panels(tmp_path / "final.npz", tmp_path / "folded.npz") == {}
