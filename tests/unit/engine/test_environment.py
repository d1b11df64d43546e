"""The environment of jobs."""

from foldshell.engine.environment import prepare_environment


def test_what_a_person_has_set_stays():
    environment = {"OMP_NUM_THREADS": "2", "PYTHONDONTWRITEBYTECODE": "1", "HOME": "/home/a"}
    prepare_environment(environment)
    assert environment["OMP_NUM_THREADS"] == "2"
    assert environment["OPENBLAS_NUM_THREADS"] == "1"
    assert environment["MALLOC_TRIM_THRESHOLD_"] == "4000000000"
    assert environment["NUMPY_MADVISE_HUGEPAGE"] == "0"
    assert environment["HOME"] == "/home/a"
    assert "PYTHONDONTWRITEBYTECODE" not in environment
