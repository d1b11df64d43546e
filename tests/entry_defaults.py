"""Parameters of entry scripts at the defaults of the settings, as the rules pass them."""

from typing import Any

from foldshell.settings.design import DesignColumns
from foldshell.settings.exports import Drawings
from foldshell.settings.field import list_settings
from foldshell.settings.fold import Fold
from foldshell.settings.stage import to_plain

_ROW = {known.key: known.convert(known.default) for known in list_settings(DesignColumns).values()}
DRAWINGS = {"drawings": to_plain(Drawings())}


def pattern_parameters(**values: Any) -> dict[str, Any]:
    """Return the parameters of rule pattern; `values` replace some of them."""
    names = ("pattern", "surface", "span_m", "height_m", "zigzag", "strip")
    return {
        **{name: _ROW[name] for name in names},
        "sector_angle_deg": 60.0,
        "settings": DRAWINGS,
        **values,
    }


def fold_parameters(**values: Any) -> dict[str, Any]:
    """Return the parameters of rule fold; `values` replace some of them."""
    names = ("surface", "span_m", "height_m", "fold_mode")
    return {
        **{name: _ROW[name] for name in names},
        "settings": {"fold": to_plain(Fold())},
        **values,
    }
