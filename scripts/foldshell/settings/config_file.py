"""Strict reading of YAML settings: what YAML 1.1 would read as something else is refused."""

import re
from pathlib import Path
from typing import Any

import yaml

from foldshell.files.errors import InputError
from foldshell.files.whole import read_small_file

LARGEST_FILE = 1_000_000
_DEEPEST = 20
_MAP, _SEQ = "tag:yaml.org,2002:map", "tag:yaml.org,2002:seq"
_PLAIN_FORMS = {
    "tag:yaml.org,2002:null": (re.compile(r"~|null|"), lambda text: None),
    "tag:yaml.org,2002:bool": (re.compile(r"true|false"), lambda text: text == "true"),
    "tag:yaml.org,2002:int": (re.compile(r"[-+]?(0|[1-9][0-9]{0,17})"), int),
    "tag:yaml.org,2002:float": (
        re.compile(r"[-+]?(0|[1-9][0-9]*)\.[0-9]*([eE][-+][0-9]{1,3})?"),
        float,
    ),
    "tag:yaml.org,2002:str": (re.compile(r".*", re.DOTALL), str),
}
_READ_AS = {"bool": "true or false", "int": "a number", "float": "a number", "timestamp": "a date"}


class _StrictLoader(yaml.SafeLoader):
    """Safe loader without aliases, so that a small file cannot grow large."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node of the document; an alias is refused."""
        if self.check_event(yaml.AliasEvent):
            event = self.peek_event()
            raise yaml.composer.ComposerError(
                None, None, f"alias *{event.anchor}; aliases are not allowed", event.start_mark
            )
        return super().compose_node(parent, index)


def read_config(path: str | Path) -> dict[str, Any]:
    """Read a YAML file of nested settings into plain dicts, lists, texts and numbers.

    Raises `InputError` for a file that is not UTF-8, holds tabs, duplicate keys, aliases, several
    documents or anything but keys with values, and for plain values that YAML 1.1 takes for
    something else (`010` is 8 there, `no` is False, `1:30` is 90, `.nan` is a number).
    """
    path = Path(path)
    text = read_text(path)
    for number, line in enumerate(text.splitlines(), start=1):
        if "\t" in line:
            raise InputError(f"{path}: line {number}: a tab: only spaces are allowed")
    try:
        loader = _StrictLoader(text)
        node = loader.get_single_node()
        loader.dispose()
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise InputError(f"{path}: {_describe_yaml_error(error)}") from None
    if node is None:
        raise InputError(f"{path}: the file is empty: keys with values are allowed")
    if not isinstance(node, yaml.MappingNode):
        raise InputError(f"{path}: line 1: a list or a single value: keys with values are allowed")
    return _plain(node, path, "", 0)


def read_text(path: Path) -> str:
    """Read a small UTF-8 text file, with or without a byte order mark."""
    data = read_small_file(path, LARGEST_FILE, "a text file of settings")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(
            f"{path}: line {line}: byte 0x{data[error.start]:02x} is not UTF-8: save as UTF-8"
        ) from None
    control = re.search(r"[\x00-\x08\x0b-\x1f\x7f]", text.replace("\r\n", "\n"))
    if control:
        line = text[: control.start()].count("\n") + 1
        raise InputError(
            f"{path}: line {line}: control character {control.group()!r}: only text is allowed"
        )
    return text


def _describe_yaml_error(error: Exception) -> str:
    if not isinstance(error, yaml.MarkedYAMLError):
        return f"not readable as YAML ({' '.join(str(error).split())[:120]})"
    mark = error.problem_mark or error.context_mark
    place = f"line {mark.line + 1}: " if mark else ""
    return f"{place}not readable as YAML: {' '.join((error.problem or '').split())}"


def _plain(node: yaml.Node, path: Path, place: str, depth: int) -> Any:
    if depth > _DEEPEST:
        raise InputError(f"{path}: {place}: nested deeper than {_DEEPEST} levels")
    line = node.start_mark.line + 1
    if isinstance(node, yaml.MappingNode) and node.tag == _MAP:
        return _plain_mapping(node, path, place, depth)
    if isinstance(node, yaml.SequenceNode) and node.tag == _SEQ:
        return [
            _plain(child, path, f"{place}[{index}]", depth + 1)
            for index, child in enumerate(node.value)
        ]
    if not isinstance(node, yaml.ScalarNode):
        raise InputError(f"{path}: line {line}: {place}: tag {node.tag}: no tags are allowed")
    return _plain_scalar(node, path, place)


def _plain_mapping(node: yaml.MappingNode, path: Path, place: str, depth: int) -> dict[str, object]:
    result: dict[str, object] = {}
    lines: dict[str, int] = {}
    for key_node, value_node in node.value:
        line = key_node.start_mark.line + 1
        if not (isinstance(key_node, yaml.ScalarNode) and key_node.tag.endswith(":str")):
            text = getattr(key_node, "value", "a nested value")
            raise InputError(
                f"{path}: line {line}: key {text!r}: YAML does not read it as text, "
                "only names are allowed as keys"
            )
        key = key_node.value
        here = f"{place}.{key}" if place else key
        if key in result:
            raise InputError(
                f"{path}: line {line}: {here}: the key stands twice, first in line {lines[key]}"
            )
        lines[key] = line
        result[key] = _plain(value_node, path, here, depth + 1)
    return result


def _plain_scalar(node: yaml.ScalarNode, path: Path, place: str) -> Any:
    text = node.value
    if node.style is not None and node.tag.endswith(":str"):
        return text
    pattern, convert = _PLAIN_FORMS.get(node.tag, (None, None))
    if pattern is not None and pattern.fullmatch(text):
        return convert(text)
    kind = _READ_AS.get(node.tag.rpartition(":")[2], node.tag)
    raise InputError(
        f"{path}: line {node.start_mark.line + 1}: {place}: {text!r}: YAML reads it as {kind}, "
        "which is easily mistaken: write a plain decimal number, true, false or quoted text"
    )
