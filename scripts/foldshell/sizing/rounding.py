"""Thicknesses as they stand in files: 12 significant digits."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
DIGITS = 12


def round_thickness(thickness: npt.ArrayLike) -> FloatArray:
    """Round to 12 significant digits, which survive workbooks and spreadsheets unchanged.

    Writers of .xlsx print 16 digits and spreadsheets keep 15, both fewer than a double may need.

    thickness (P,) m, or of any shape and unit.
    """
    values = np.asarray(thickness, dtype=float)
    return np.char.mod(f"%.{DIGITS}g", values).astype(float).reshape(values.shape)
