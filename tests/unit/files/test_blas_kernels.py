"""Kernels of the BLAS under CHOLMOD: fast ones on every processor that has them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from foldshell.archive import machine
from foldshell.engine.environment import list_versions
from foldshell.files.blas_kernels import (
    SLOW,
    find_best_kernels,
    is_slow,
    name_kernels,
    read_flags,
)
from foldshell.report.provenance import find_provenance

SCRIPTS = Path(__file__).parents[3] / "scripts"
AVX2, AVX512 = {"avx", "avx2", "fma"}, {"avx512f", "avx512dq", "avx512bw", "avx512vl", "avx512cd"}

FALL_BACK = """
import os, sys
os.environ["OPENBLAS_CORETYPE"] = "Prescott"
import cvxopt.cholmod
from foldshell.files import blas_kernels
library = blas_kernels._open_blas()
before = blas_kernels._read_core(library)
if sys.argv[1] == "newer processor":
    del os.environ["OPENBLAS_CORETYPE"]
import numpy as np
from foldshell.shell.cholmod_library import open_library
cholmod = open_library()
size = 300
dense = np.random.default_rng(1).standard_normal((size, size))
dense = dense @ dense.T + size * np.eye(size)
indptr = np.concatenate([[0], np.cumsum(np.arange(size, 0, -1))])
indices = np.concatenate([np.arange(k, size) for k in range(size)])
values = np.concatenate([dense[k:, k] for k in range(size)])
factor = cholmod.factorise(cholmod.analyse(indptr, indices), indptr, indices, values)
right = np.random.default_rng(2).standard_normal((size, 7))
error = np.abs(dense @ cholmod.solve(factor, right) - right).max()
print(before, blas_kernels.name_kernels(), error < 1e-10, os.environ.get("OPENBLAS_CORETYPE"))
"""


def run_fallen_back(words: str) -> list[str]:
    environment = {**os.environ, "PYTHONPATH": str(SCRIPTS)}
    done = subprocess.run(
        [sys.executable, "-c", FALL_BACK, words], env=environment, capture_output=True, text=True,
        check=True, timeout=120,
    )  # fmt: skip
    return done.stdout.split()


def test_this_processor_runs_no_slow_kernels_where_it_has_fast_ones():
    assert name_kernels()
    assert not is_slow(name_kernels(), read_flags())


@pytest.mark.skipif(not read_flags() >= {"avx"}, reason="this processor has no fast kernels")
def test_a_library_that_fell_back_gets_the_kernels_of_the_processor():
    """It is made to fall back as it does on a processor newer than its list; then it factorises."""
    before, after, right, chosen = run_fallen_back("newer processor")
    assert before == "Prescott"
    assert after == find_best_kernels(read_flags())
    assert right == "True"
    assert chosen == "None"


def test_kernels_that_a_person_has_chosen_stay():
    before, after, right, chosen = run_fallen_back("chosen")
    assert before == after == chosen == "Prescott"
    assert right == "True"


@pytest.mark.parametrize(
    ("flags", "kernels"),
    [
        (AVX2 | AVX512, "SkylakeX"),
        (AVX2 | AVX512 - {"avx512vl"}, "Haswell"),
        ({"avx", "avx2"}, "Sandybridge"),
        ({"sse3"}, None),
        (set(), None),
    ],
)
def test_kernels_need_all_their_flags(flags, kernels):
    assert find_best_kernels(flags) == kernels
    assert is_slow("Prescott", flags) is (kernels is not None)
    assert not is_slow("Zen", flags)
    assert "Zen" not in SLOW


def test_flags_of_a_system_that_names_none(tmp_path):
    assert read_flags(tmp_path / "none") == set()
    (tmp_path / "cpuinfo").write_text("processor\t: 0\nflags\t\t: fpu avx2 fma\nflags\t: other\n")
    assert read_flags(tmp_path / "cpuinfo") == {"fpu", "avx2", "fma"}


def test_archive_settings_page_and_report_say_which_kernels_ran(tmp_path):
    kernels = name_kernels()
    assert machine.describe_machine()["blas_kernels"] == kernels
    assert kernels in list_versions(()).values()
    assert kernels in find_provenance(tmp_path).machine.values()
