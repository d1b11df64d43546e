"""Settings refuse what they do not know, by name."""

import pytest

from foldshell.files.errors import InputError
from foldshell.folding.settings import FoldSettings, read_settings


def test_defaults_and_overrides():
    assert read_settings({}) == FoldSettings()
    settings = read_settings({"weights": {"stretch": 3}, "attract": "highest", "tolerance": 1e-6})
    assert settings.weights.stretch == 3.0 and settings.weights.attraction == 100.0
    assert settings.attract == "highest"


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ({"wieghts": {}}, "wieghts"),
        ({"weights": {"stretsh": 1}}, "stretsh"),
        ({"weights": {"stretch": "10"}}, "weights.stretch"),
        ({"weights": {"stretch": float("nan")}}, "weights.stretch"),
        ({"weights": {"stretch": -1}}, "weights.stretch"),
        ({"weights": 3}, "weights"),
        ({"attract": "middle"}, "attract"),
        ({"engine": "dynamic"}, "engine"),
        ({"max_iterations": True}, "max_iterations"),
        ({"max_iterations": 0}, "max_iterations"),
    ],
)
def test_bad_settings_are_named(values, named):
    with pytest.raises(InputError, match=named):
        read_settings(values)
