"""Arrays in a page: whole numbers come back as they were, real ones to half a step."""

import numpy as np
import pytest

from foldshell.report.arrays import STEPS, pack_arrays, unpack_arrays


@pytest.mark.parametrize(("largest", "kind"), [(255, "uint8"), (256, "uint16"), (70_000, "uint32")])
def test_whole_numbers_are_exact_in_the_least_type(largest, kind):
    """The largest number decides the type; values and shape come back."""
    values = np.array([[0, largest, 3], [1, 2, 4]])
    headers, text = pack_arrays({"a": values})
    assert headers[0]["type"] == kind
    assert np.array_equal(unpack_arrays(headers, text)["a"], values)


def test_real_numbers_are_within_half_a_step():
    """65534 steps from the least to the largest, so at most half a 65534th of the range off."""
    values = np.random.default_rng(3).normal(size=(50, 3)) * 1e-4 - 7
    headers, text = pack_arrays({"first": np.arange(3), "a": values})
    found = unpack_arrays(headers, text)["a"]
    assert np.abs(found - values).max() <= 0.5001 * np.ptp(values) / STEPS
    assert found.shape == values.shape


def test_missing_and_equal_values():
    """nan stays nan, equal values come back exactly, empty arrays stay empty."""
    arrays = {"gap": np.array([np.nan, 1.0, 3.0]), "same": np.full(4, 0.04),
              "none": np.empty((0, 3)), "lines": np.empty((0, 5), dtype=int),
              "lost": np.full(2, np.nan)}  # fmt: skip
    found = unpack_arrays(*pack_arrays(arrays))
    for name, values in arrays.items():
        assert np.allclose(found[name], values, rtol=1e-15, atol=0, equal_nan=True)
        assert found[name].shape == values.shape


def test_arrays_start_at_multiples_of_four():
    """Typed arrays of a browser must be aligned to their item size."""
    headers, _ = pack_arrays({"a": np.arange(3), "b": np.arange(7), "c": np.ones(3)})
    assert all(header["offset"] % 4 == 0 for header in headers)


def test_single_precision_takes_a_byte():
    """Values that are only to be looked at: 254 steps, nan stays nan."""
    values = np.linspace(-3, 5, 100, dtype=np.float32)
    values[7] = np.nan
    headers, text = pack_arrays({"a": values})
    assert headers[0]["type"] == "uint8"
    found = unpack_arrays(headers, text)["a"]
    assert np.isnan(found[7]) and np.nanmax(np.abs(found - values)) <= 0.5001 * 8 / 254
