"""Entry script of rule animate."""

from itertools import pairwise

import numpy as np
from PIL import Image

import animate
import pattern
from entry_defaults import pattern_parameters


def test_path_becomes_a_moving_picture(tmp_path):
    pattern.main(tmp_path / "a.fold", design="x", **pattern_parameters(zigzag=5, strip=6, frames=4))
    animate.main(tmp_path / "a.fold", tmp_path / "a.gif", tmp_path / "stills")
    stills = sorted((tmp_path / "stills").glob("still_*.png"))
    assert len(stills) == 4  # the path starts flat, so no frame is added before it
    images = [np.asarray(Image.open(path).convert("L"), dtype=float) for path in stills]
    for one, two in pairwise(images):
        assert np.abs(one - two).mean() > 0.5
    assert all(image.std() > 10 for image in images)  # a sheet is to be seen
    with Image.open(tmp_path / "a.gif") as gif:
        assert gif.n_frames == 6  # there and back
