"""Optional lists: a sentence for what is missing, hashes for all, every licence in one list."""

import re
import tomllib
from pathlib import Path

import pytest

from foldshell.files.errors import InputError
from foldshell.files.libraries import LISTS, need_library

REPOSITORY = Path(__file__).parents[3]
ENVS = REPOSITORY / "envs"


def names_in(lock):
    """Return the packages of a lock file."""
    return set(re.findall(r"(?m)^([A-Za-z0-9._-]+)==", lock.read_text()))


def asked_in(group):
    """Return the lines of an optional list."""
    lines = (ENVS / f"{group}.in").read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def test_a_library_that_is_there_is_returned():
    assert need_library("json", "exports").dumps([1]) == "[1]"


def test_a_missing_one_says_what_to_type():
    with pytest.raises(InputError) as caught:
        need_library("no_such_library", "exports")
    expected = "no_such_library: is not installed: type "
    assert str(caught.value).startswith(expected)
    assert "envs/exports.lock" in str(caught.value)


def test_a_broken_one_says_why(tmp_path, monkeypatch):
    (tmp_path / "broken_library.py").write_text("import no_such_part\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match=r"broken_library: cannot be loaded \(No module named"):
        need_library("broken_library", "bench")


@pytest.mark.parametrize("group", LISTS)
def test_every_list_is_locked_with_hashes(group):
    lock = ENVS / f"{group}.lock"
    wanted = {re.split(r"[<>=!~;\[ ]", line)[0].lower() for line in asked_in(group)}
    assert wanted <= {name.lower() for name in names_in(lock)}
    blocks = re.split(r"(?m)^(?=[A-Za-z0-9])", lock.read_text())[1:]
    assert all("--hash=sha256:" in block for block in blocks)


@pytest.mark.parametrize("group", LISTS)
def test_the_project_names_the_same_lists(group):
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]
    assert project["optional-dependencies"].get(group, []) == asked_in(group)


def test_every_package_has_its_licence_in_the_list():
    rows = re.findall(
        r"(?m)^\| ([a-z0-9._-]+) \| ([^|]+) \|", (REPOSITORY / "docs/licences.md").read_text()
    )
    listed = {name: licence.strip() for name, licence in rows if name != "package"}
    locked = set().union(*map(names_in, ENVS.glob("*.lock")))
    assert set(listed) == locked
    assert all(listed.values())
