"""The environment of jobs."""

import pytest

from foldshell.engine.environment import check_deployment, choose_cache, prepare_environment
from foldshell.files.errors import InputError


def test_what_a_person_has_set_stays():
    environment = {"OMP_NUM_THREADS": "2", "PYTHONDONTWRITEBYTECODE": "1", "HOME": "/home/a"}
    prepare_environment(environment)
    assert environment["OMP_NUM_THREADS"] == "2"
    assert environment["OPENBLAS_NUM_THREADS"] == "1"
    assert environment["MALLOC_TRIM_THRESHOLD_"] == "4000000000"
    assert environment["NUMPY_MADVISE_HUGEPAGE"] == "0"
    assert environment["HOME"] == "/home/a"
    assert "PYTHONDONTWRITEBYTECODE" not in environment


def test_a_home_that_cannot_be_written_has_its_cache_elsewhere(tmp_path):
    """A home that is a file, or is not there and cannot be made, stands for one without rights."""
    (tmp_path / "file").touch()
    for home in (tmp_path / "file", tmp_path / "file/below"):
        environment = {"HOME": str(home)}
        choose_cache(environment, tmp_path / "cache")
        assert environment["XDG_CACHE_HOME"] == str(tmp_path / "cache")
    environment = {"HOME": str(tmp_path)}
    choose_cache(environment, tmp_path / "cache")
    assert "XDG_CACHE_HOME" not in environment
    environment = {"HOME": str(tmp_path / "file"), "XDG_CACHE_HOME": "mine"}
    choose_cache(environment, tmp_path / "cache")
    assert environment["XDG_CACHE_HOME"] == "mine"


@pytest.mark.parametrize(
    ("methods", "installed", "word"),
    [
        ({"apptainer"}, False, "no container is declared"),
        ({"apptainer", "conda"}, False, "no container is declared"),
        ({"env_modules"}, False, "no modules are declared"),
        ({"conda"}, True, "from a checkout"),
    ],
)
def test_a_way_to_deploy_without_anything_to_deploy_is_refused(methods, installed, word):
    with pytest.raises(InputError, match=word):
        check_deployment(methods, installed)
    check_deployment({"conda"} - methods, False)
