"""Random settings files and tables: a refusal in one sentence, or just what stands there.

The oracles are PyYAML's own reading of an accepted file, and a table split at tabs.
"""

import dataclasses
import math
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings

from foldshell.files.errors import InputError
from foldshell.settings.config_file import read_config
from foldshell.settings.designs import read_designs
from foldshell.settings.make import make_settings
from fuzzing import (
    BYTE_EDITS,
    FUZZ,
    LINE_EDITS,
    TREE_EDITS,
    edit_bytes,
    edit_lines,
    edit_tree,
    is_one_sentence,
)

CONFIG = Path(__file__).parents[3] / "config" / "config.yaml"
TEXT = CONFIG.read_text(encoding="utf-8")
TREE = yaml.safe_load(TEXT)
SETTINGS = make_settings({})
COLUMNS = {"design": "name", "span_m": "span", "height_m": "height", "zigzag": "zigzag",
           "strip": "strip", "surface": "surface", "support": "support", "pattern": "pattern",
           "fold_mode": "fold_mode"}  # fmt: skip
TABLE = "\n".join(
    ["# designs", "\t".join([*COLUMNS, "tags"]),
     "first\t28\t10\t15\t16\tparaboloid\tall\tmiura\telastic\tx,y",
     "second\t13.5\t5\t9\t8\tarch\tstrip\tarc_miura\texact\t",
     "third\t\t\t30\t\t\t\t\t\tx", ""]
)  # fmt: skip
OLD_WORDS = {"paper": "elastic", "literal": "fully_stressed"}


def leaves(tree, path=()):
    """Every value of a tree of plain data that is no group, with its path."""
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, (*path, key))
        else:
            yield (*path, key), value


BASE = dict(leaves(TREE))
OPEN = ("combinations",)
"""Groups whose keys a user names."""


def check_types(tree):
    """What was accepted is of the kind of the default, and known."""
    for path, value in leaves(tree):
        if path[0] in OPEN or path not in BASE:
            continue
        default = BASE[path]
        number = isinstance(default, int | float) and not isinstance(default, bool)
        if number and not isinstance(value, str):  # some settings are a number or a word
            assert isinstance(value, int | float) and not isinstance(value, bool), path
            assert math.isfinite(value), path
        if isinstance(default, bool):
            assert isinstance(value, bool), path


def check_finite(group):
    """No setting is a number that is none."""
    for field in dataclasses.fields(group):
        value = getattr(group, field.name)
        if dataclasses.is_dataclass(value):
            check_finite(value)
        elif isinstance(value, float):
            assert math.isfinite(value), field.name


def check_config(path, data):
    path.write_bytes(data)
    try:
        tree = read_config(path)
        made = make_settings(tree, str(path))
    except InputError as error:
        assert is_one_sentence(error, path), str(error)[:500]
        return
    assert repr(yaml.safe_load(data.decode("utf-8-sig"))) == repr(tree)
    check_types(tree)
    check_finite(made)


def check_tree(edits):
    tree = edit_tree(TREE, edits)
    try:
        made = make_settings(tree, "configuration")
    except InputError as error:
        assert is_one_sentence(error, "configuration"), str(error)[:500]
        return
    check_types(tree)
    check_finite(made)


def check_table(path, data):
    path.write_bytes(data)
    try:
        designs = read_designs(path, SETTINGS)
    except InputError as error:
        assert is_one_sentence(error, path), str(error)[:500]
        return
    text = data.decode("utf-8-sig").replace("\r\n", "\n")
    rows = [line.split("\t") for line in text.split("\n") if line.strip() and line[:1] != "#"]
    header = [cell.strip(" ") for cell in rows[0]]
    assert len(designs) == len(rows) - 1
    for design, row in zip(designs, rows[1:], strict=True):
        for column, cell in zip(header, row, strict=True):
            word = cell.strip(" ")
            if column not in COLUMNS or not word:
                continue
            found = getattr(design, COLUMNS[column], None)
            if isinstance(found, int | float):
                assert found == float(word), (column, word)
            elif found is not None:
                assert found == OLD_WORDS.get(word, word), (column, word)


@settings(max_examples=60, **FUZZ)
@given(edits=LINE_EDITS)
def test_lines_of_a_settings_file(tmp_path, edits):
    text = edit_lines(TEXT, edits)
    check_config(tmp_path / "config.yaml", text.encode("utf-8", "surrogatepass"))


@settings(max_examples=60, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_a_settings_file(tmp_path, edits):
    check_config(tmp_path / "config.yaml", edit_bytes(TEXT.encode(), edits))


@settings(max_examples=150, **FUZZ)
@given(edits=TREE_EDITS)
def test_values_of_settings(edits):
    check_tree(edits)


@settings(max_examples=100, **FUZZ)
@given(edits=LINE_EDITS)
def test_cells_of_a_table(tmp_path, edits):
    text = edit_lines(TABLE, edits, "\t")
    check_table(tmp_path / "designs.tsv", text.encode("utf-8", "surrogatepass"))


@settings(max_examples=100, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_a_table(tmp_path, edits):
    check_table(tmp_path / "designs.tsv", edit_bytes(TABLE.encode(), edits))


@pytest.mark.slow
@settings(max_examples=800, **FUZZ)
@given(edits=LINE_EDITS)
def test_lines_of_a_settings_file_at_length(tmp_path, edits):
    text = edit_lines(TEXT, edits)
    check_config(tmp_path / "config.yaml", text.encode("utf-8", "surrogatepass"))


@pytest.mark.slow
@settings(max_examples=800, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_a_settings_file_at_length(tmp_path, edits):
    check_config(tmp_path / "config.yaml", edit_bytes(TEXT.encode(), edits))


@pytest.mark.slow
@settings(max_examples=1200, **FUZZ)
@given(edits=TREE_EDITS)
def test_values_of_settings_at_length(edits):
    check_tree(edits)


@pytest.mark.slow
@settings(max_examples=1000, **FUZZ)
@given(edits=LINE_EDITS)
def test_cells_of_a_table_at_length(tmp_path, edits):
    text = edit_lines(TABLE, edits, "\t")
    check_table(tmp_path / "designs.tsv", text.encode("utf-8", "surrogatepass"))


@pytest.mark.slow
@settings(max_examples=1000, **FUZZ)
@given(edits=BYTE_EDITS)
def test_bytes_of_a_table_at_length(tmp_path, edits):
    check_table(tmp_path / "designs.tsv", edit_bytes(TABLE.encode(), edits))
