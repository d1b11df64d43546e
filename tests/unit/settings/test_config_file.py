"""Strict YAML: what YAML 1.1 reads as something else, or drops without a word, is refused."""

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.config_file import read_config


def read(tmp_path, data: bytes | str):
    path = tmp_path / "config.yaml"
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return read_config(path)


def test_plain_values_keep_their_types(tmp_path):
    text = 'a: 1\nb: 2.5\nc: true\nd: text\ne: "010"\nf: [1, 2.0e-3]\ng: {h: null, i: -0.5}\n'
    expected = {
        "a": 1,
        "b": 2.5,
        "c": True,
        "d": "text",
        "e": "010",
        "f": [1, 0.002],
        "g": {"h": None, "i": -0.5},
    }
    result = read(tmp_path, text)
    assert result == expected
    assert [type(value) for value in result.values()] == [int, float, bool, str, str, list, dict]


def test_byte_order_mark_and_windows_lines_are_accepted(tmp_path):
    assert read(tmp_path, b"\xef\xbb\xbfa: 1\r\nb: 2\r\n") == {"a": 1, "b": 2}


def test_numbers_that_yaml_takes_for_text_stay_text(tmp_path):
    """The schema names them, since only it knows that a number is due."""
    assert read(tmp_path, "a: 27e9\nb: 16,7\n") == {"a": "27e9", "b": "16,7"}


@pytest.mark.parametrize(
    ("data", "named"),
    [
        ("", "empty"),
        ("# only a remark\n", "empty"),
        ("- 1\n- 2\n", "list"),
        ("just text\n", "list or a single value"),
        ("a: 1\na: 2\n", "line 2: a: the key stands twice, first in line 1"),
        ("a:\n  b: 1\n  b: 1\n", "line 3: a.b: the key stands twice"),
        ("a:\n\tb: 1\n", "line 2: a tab"),
        ("a: 1\t# remark\n", "line 1: a tab"),
        (b"a: \xe9\n", "line 1: byte 0xe9 is not UTF-8"),
        ("a: 1\n".encode("utf-16"), "not UTF-8"),
        (b"a: 1\x00\n", "control character"),
        ("a: 010\n", "'010'"),
        ("a: 0x10\n", "'0x10'"),
        ("a: 1_000\n", "'1_000'"),
        ("a: 1:30\n", "'1:30'"),
        ("a: no\n", "'no'"),
        ("a: On\n", "'On'"),
        ("a: TRUE\n", "'TRUE'"),
        ("a: .nan\n", "'.nan'"),
        ("a: -.inf\n", "'-.inf'"),
        ("a: 2020-01-02\n", "a date"),
        ("no: 1\n", "key 'no'"),
        ("1: 1\n", "key '1'"),
        ("a: &x {b: 1}\nc: *x\n", "line 2: .*alias"),
        ("a: &x 1\nb: {<<: {c: 1}}\n", "key '<<'"),
        ("a: !!python/object/apply:os.system [echo]\n", "tag"),
        ("a: !!int '3'\n", "YAML reads it as|tag"),
        ("a: 1\n---\nb: 2\n", "not readable as YAML"),
        ("a: {b: 1\n", "not readable as YAML"),
        ("a: 'b\n", "not readable as YAML"),
        ("? {a: 1}\n: 2\n", "key"),
        ("a: " + "[" * 200 + "]" * 200, "nested deeper"),
        ("a: " + "[" * 5000, "not readable"),
        (b"a: " + b"x" * 1_100_000, "larger than 1 MB"),
    ],
)
def test_refused_with_file_and_place(tmp_path, data, named):
    if data == "a: !!int '3'\n":
        assert read(tmp_path, data) == {"a": 3}  # an explicit tag is no trap
        return
    with pytest.raises(InputError, match=named) as caught:
        read(tmp_path, data)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "config.yaml")) and "\n" not in message


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_config(tmp_path / "none.yaml")
    with pytest.raises(InputError, match="cannot be read"):
        read_config(tmp_path)
