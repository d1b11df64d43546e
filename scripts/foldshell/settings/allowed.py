"""What a setting allows, in words, and what a wrong value was probably meant to be."""

import math
import re

from foldshell.settings.field import NUMBERS, Factors, Setting
from foldshell.settings.nearest import hint_nearest

NUMBER = re.compile(r"[-+]?(0|[1-9][0-9]{0,17})(\.[0-9]*)?([eE][-+]?[0-9]{1,3})?")
"""A plain decimal number as text: in tables, and in `--config`."""

_NUMBERS = {float: "a number", int: "a whole number"}


def describe_allowed(known: Setting) -> str:
    """Say in words what a setting allows, with its unit."""
    if known.kind == Factors:
        return f"names with factors of {', '.join(known.choices)} or of cases of the load table"
    if known.kind == tuple[str, ...] and not known.choices:
        return "a name or a list of names"
    if known.kind == tuple[str, ...]:
        return f"a list of names out of {', '.join(known.choices)}"
    if known.choices:
        return f"one of {', '.join(known.choices)}"
    if known.kind is bool:
        return "true or false"
    if known.kind is str:
        return f"text of 1 to {known.longest} characters" if known.longest else "text"
    if known.kind == tuple[int, int]:
        return f"a list of 2 values, each a whole number{_describe_range(known)}"
    unit = f" in {known.unit}" if known.unit else ""
    if known.kind == NUMBERS:
        return f"a list of rising numbers{unit}, each{_describe_range(known)}, or an empty one"
    if known.ranges:
        words = [f"of {low:g} to {high:g}" for low, high in known.ranges]
        return f"0 for none or {_NUMBERS[known.kind]}{unit} {', or '.join(words)}"
    return _NUMBERS[known.kind] + unit + _describe_range(known)


def _describe_range(known: Setting) -> str:
    words = [f"of at least {known.minimum:g}"] if known.minimum is not None else []
    words += [f"above {known.above:g}"] if known.above is not None else []
    words += [f"of at most {known.maximum:g}"] if known.maximum is not None else []
    words += [f"below {known.below:g}"] if known.below is not None else []
    return (" " if words else "") + " and ".join(words)


def in_range(known: Setting, value: float) -> bool:
    """Tell whether a number of the file, in the unit of the setting, is in its range."""
    if known.ranges:
        return value == 0 or any(low <= value <= high for low, high in known.ranges)
    return (
        (known.minimum is None or value >= known.minimum)
        and (known.maximum is None or value <= known.maximum)
        and (known.above is None or value > known.above)
        and (known.below is None or value < known.below)
    )


def describe_hint(value: object, known: Setting, yaml: bool) -> str:
    """Say what was probably meant: a near word, a decimal comma, a number written otherwise.

    `yaml` tells whether the value stands in a YAML file, where text in place of a number has
    quotes or a form that YAML does not read as one.
    """
    if not isinstance(value, str):
        return ""
    if known.kind in (str, bool):
        return hint_nearest(value.casefold(), known.choices) if known.choices else ""
    if re.fullmatch(r"[-+]?\d+,\d+", value.strip()):
        return f", write {value.strip().replace(',', '.')} with a decimal point"
    return _describe_yaml_number(value) if yaml else _describe_table_number(value)


def _describe_table_number(value: str) -> str:
    """Say what is wrong with a cell of a table that is no plain number."""
    if re.fullmatch(r"""(["']).*\1""", value):
        return ", write it without quotes"
    unit = re.fullmatch(r"[-+0-9.]+ *(m|mm|cm|in|ft|deg|%)", value)
    if unit:
        return f", write the number alone, without {unit[1]}"
    if re.fullmatch(r"[-+]?0[0-9]+(\.[0-9]*)?", value):
        return ", write it without leading zeros"
    if re.fullmatch(r"[-+]?\.[0-9]+", value):
        return ", write a digit before the point"
    return ", the value is text"


def _describe_yaml_number(value: str) -> str:
    """Say how a number that stands as text in a YAML file is written."""
    try:
        number = float(value)
    except ValueError:
        return ", the value is text"
    if not math.isfinite(number):
        return ""
    mantissa, _, exponent = f"{number:e}".partition("e")
    mantissa = mantissa.rstrip("0") + ("0" if mantissa.rstrip("0").endswith(".") else "")
    return f", the value is text in YAML: write {mantissa}e{exponent} without quotes"
