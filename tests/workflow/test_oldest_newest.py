"""The demo by the oldest and the newest Snakemake of the range, in fresh virtual environments."""

import subprocess
import sys

import pytest
from study_runner import copy_code, results

from foldshell.engine.versions import BELOW, OLDEST

pytestmark = pytest.mark.slow
NEWEST = BELOW[0], BELOW[1] - 1
PACKAGES = ["numpy", "scipy", "cvxopt", "pandas", "meshio", "pyvista", "vtk", "openpyxl"]
PACKAGES += ["XlsxWriter", "ezdxf", "jinja2", "jsonschema", "markdown-it-py", "PyYAML"]
PACKAGES += ["matplotlib", "pillow", "psutil", "pydantic"]


def run_demo(folder, version):
    """Install the workflow's packages with a Snakemake of this minor version; run the demo."""
    code = copy_code(folder / "code")
    subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
    wanted = "snakemake=={}.{}.*".format(*version)
    pip = [folder / "venv/bin/python", "-m", "pip", "install", "-q", *PACKAGES, wanted]
    subprocess.run(pip, check=True)
    program = [folder / "venv/bin/python", "-m", "snakemake", "--cores", "2", "demo"]
    done = subprocess.run(program, cwd=code, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    assert "this Snakemake has no" not in done.stderr
    return results(code)


def test_both_ends_of_the_range_run_the_demo_to_equal_results(tmp_path):
    """All private names are there in both. Files that tell Snakemake's own version differ."""
    oldest, newest = (run_demo(tmp_path / "{}-{}".format(*end), end) for end in (OLDEST, NEWEST))
    assert len(oldest) > 60
    other = {name.split("/", 2)[2] for name in oldest if oldest[name] != newest.get(name)}
    assert set(oldest) == set(newest)
    assert other <= {"design.xlsx", "jobs/design_workbook.json", "manifest.json"}
