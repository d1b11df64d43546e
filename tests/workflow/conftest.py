"""A copy of the workflow and a tiny study that has run undisturbed, made once for all tests."""

from pathlib import Path

import pytest
from study_runner import TARGET, copy_code, make_study, run


@pytest.fixture(scope="session")
def code(tmp_path_factory):
    """Return a copy of the workflow's code."""
    return copy_code(tmp_path_factory.mktemp("code"))


@pytest.fixture(scope="session")
def finished(code, tmp_path_factory):
    """Return the folder of a tiny study that has run undisturbed."""
    folder = make_study(tmp_path_factory.mktemp("study"))
    done = run(code, folder, TARGET)
    assert done.returncode == 0, done.stderr[-3000:]
    return folder


def pytest_collection_modifyitems(items):
    """Mark every test of this folder: it starts Snakemake."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker("workflow")
