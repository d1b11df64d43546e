"""The range of Snakemake's versions: the same in every list, and a sentence outside it."""

import re
import tomllib
from pathlib import Path

import pytest

from foldshell.engine.versions import check_snakemake, describe_range
from foldshell.files.errors import InputError

REPOSITORY = Path(__file__).parents[3]


@pytest.mark.parametrize("found", ["9.0.0", "9.0.1", "9.27.1", "9.27.2.dev0"])
def test_a_version_of_the_range_is_taken(found):
    check_snakemake(found)


@pytest.mark.parametrize(
    ("found", "word"), [("8.30.0", "older"), ("9.28.0", "newer"), ("10.0", "newer")]
)
def test_any_other_is_refused_with_what_to_type(found, word):
    with pytest.raises(InputError, match=rf"snakemake {found}: {word} .*pip install 'snakemake>="):
        check_snakemake(found)


def test_every_list_has_the_same_range():
    wanted = describe_range()
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]
    assert wanted in project["dependencies"]
    assert wanted in (REPOSITORY / "envs/requirements.in").read_text().splitlines()
    conda = (REPOSITORY / "envs/foldshell.yaml").read_text()
    assert f"  - {wanted.replace('snakemake', 'snakemake-minimal')}\n" in conda
    locked = re.search(
        r"^snakemake==(\S+)", (REPOSITORY / "envs/requirements.lock").read_text(), re.M
    )
    check_snakemake(locked[1])
