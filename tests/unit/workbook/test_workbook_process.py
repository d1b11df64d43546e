"""What reading a workbook of thicknesses costs a process of its own: memory and imports."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from foldshell.workbook.panels import ThicknessTable, make_panel_grid
from foldshell.workbook.write_thickness import write_thickness
from workbook_cases import LARGEST, LEAST

SCRIPTS = str(Path(__file__).parents[3] / "scripts")


def run_python(code: str) -> str:
    """Run lines of Python in a new interpreter that finds the library; return what it prints."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": SCRIPTS, "OPENBLAS_NUM_THREADS": "1"},
    )
    return done.stdout.strip()


def test_whole_process_stays_small(tmp_path):
    """The largest design there is (9000 panels), interpreter and numpy included: below 200 MB."""
    if not Path("/proc/self/status").exists():
        pytest.skip("peak memory is read from /proc")
    grid = make_panel_grid(101, 91)
    path = tmp_path / "thickness.xlsx"
    table = ThicknessTable(grid, np.full(9000, 0.1), note=("some words",) * 9000)
    write_thickness(path, table, [], LEAST, LARGEST)
    peak = run_python(
        "import re\n"
        "from foldshell.workbook.panels import make_panel_grid\n"
        "from foldshell.workbook.read_thickness import read_thickness\n"
        f"read_thickness({str(path)!r}, make_panel_grid(101, 91), 0.04, 1.0)\n"
        "print(re.search(r'VmHWM:\\s+(\\d+) kB', open('/proc/self/status').read())[1])\n"
    )
    assert int(peak) / 1024 < 200


def test_hot_path_imports_neither_pandas_nor_openpyxl():
    """`analyse` and `resize` import these two modules: every one costs each iteration."""
    found = run_python(
        "import sys\n"
        "import foldshell.workbook.read_thickness, foldshell.workbook.write_thickness\n"
        "heavy = {'pandas', 'openpyxl', 'matplotlib', 'pyvista', 'scipy', 'jsonschema', 'yaml'}\n"
        "print(sorted(heavy & set(sys.modules)))\n"
    )
    assert found == "[]"
