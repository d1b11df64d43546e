"""Rule draw: files from files."""

import numpy as np
import pytest
from PIL import Image

import draw
from figure_cases import COMBINATIONS, write_case
from foldshell.files.errors import InputError
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters

NAMES = ("thickness", "classes", "utilization", "displacement", "planarity", "strain",
         "principal_stress_lines", "isolines", "buckling", "loads")  # fmt: skip
SETTINGS = stage_parameters(make_settings({}), "size")
SETTINGS |= {"combinations": COMBINATIONS, "figures": {"width_px": 480, "height_px": 360}}


def run(folder, paths, names=NAMES):
    """Call the script's main on the files of a case; return the pictures by name."""
    pictures = {name: folder / f"figures/{name}.png" for name in names}
    vtu = (folder / "design.vtu", folder / "design_lines.vtu")
    draw.main(*paths, *vtu, pictures, design="case", span_m=5.0, pattern="miura", settings=SETTINGS)
    return {name: np.asarray(Image.open(path)) for name, path in pictures.items()}


def test_all_pictures_have_the_size_asked_for(tmp_path):
    """Ten PNG files of 480 x 360, that of load cases higher, and the two VTU files."""
    images = run(tmp_path, write_case(tmp_path))
    assert images.pop("loads").shape[0] > 360
    assert {image.shape for image in images.values()} == {(360, 480, 3)}
    assert (tmp_path / "design.vtu").stat().st_size > 1000
    assert (tmp_path / "design_lines.vtu").stat().st_size > 1000


def test_picture_follows_the_thickness(tmp_path):
    """Another thickness, another picture of it; the planarity stays as it was."""
    names = ("thickness", "planarity")
    before = run(tmp_path, write_case(tmp_path), names)
    after = run(tmp_path, write_case(tmp_path, thickness=np.linspace(0.15, 0.05, 20)), names)
    assert (before["thickness"] != after["thickness"]).any(axis=-1).mean() > 0.05
    assert np.array_equal(before["planarity"], after["planarity"])


def test_unstable_design_is_drawn(tmp_path):
    """A mechanism has no displacements; every picture is written all the same."""
    paths = write_case(
        tmp_path, utilization=None, move=lambda x: np.nan * x, verdict="unstable",
        reason="not positive definite", buckling_factor={"S1": None},
    )  # fmt: skip
    assert set(run(tmp_path, paths)) == set(NAMES)


def test_thickness_of_another_design_is_refused(tmp_path):
    """19 thicknesses for 20 panels: one sentence, and no file."""
    paths = write_case(tmp_path, thickness=np.full(19, 0.1), utilization=None)
    with pytest.raises(InputError, match=r"final\.npz: thickness: \(19,\): one for each of 20"):
        run(tmp_path, paths)
    assert not (tmp_path / "figures").exists()
    assert not (tmp_path / "design.vtu").exists()
