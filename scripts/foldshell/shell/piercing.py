"""Panels of an edge beam that pass through the sheet they hang from."""

from collections.abc import Mapping

import numpy as np

from foldshell.files.errors import InputError
from foldshell.folding.intersections import find_piercing


def refuse_piercing(arrays: Mapping[str, np.ndarray], design: str) -> None:
    """Raise `InputError` with the place where a panel of the edge beam pierces the sheet.

    `arrays` are those of mesh.npz, whose last facets, two a panel, are the edge beam's.
    """
    sheet = len(arrays["facets"]) - 2 * len(arrays["fixed_thickness"])
    place = find_piercing(arrays["vertices"], arrays["facets"], sheet)
    if place is not None:
        raise InputError(
            f"design {design}: edge_beam_depth_m: a panel pierces the sheet near "
            f"{place.round(2).tolist()} m: an edge beam clear of it is allowed, such as one of the "
            "other sign, which stands on the other side of the border"
        )
