"""The front door: cheap to import, ten names that lead from a surface to a sized shell."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import foldshell
from entry_defaults import pattern_parameters
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import stage_parameters
from foldshell.sizing.case import open_case
from foldshell.sizing.loop import run_loop

REPOSITORY = Path(__file__).parents[2]
EXAMPLES = re.findall(r"```python\n(.*?)```", (REPOSITORY / "docs/library.md").read_text(), re.S)


def test_importing_the_library_imports_nothing_else():
    """Below 10 ms of a processor, the best of three: none of its rooms, no numpy."""
    code = "import sys, time; start = time.process_time(); import foldshell\n"
    code += "print(time.process_time() - start, 'numpy' in sys.modules,"
    code += " [name for name in sys.modules if name.startswith('foldshell.')])"
    command, path = [sys.executable, "-c", code], {"PYTHONPATH": str(REPOSITORY / "scripts")}
    said = [
        subprocess.run(command, capture_output=True, text=True, check=True, env=path).stdout.split()
        for _ in range(3)
    ]
    assert min(float(words[0]) for words in said) < 0.01
    assert said[0][1:] == ["False", "[]"]


def test_every_name_is_there_and_no_other():
    assert 8 <= len(foldshell.__all__) <= 12
    assert all(getattr(foldshell, name).__doc__ for name in foldshell.__all__)
    assert set(foldshell.__all__) <= set(dir(foldshell))
    with pytest.raises(AttributeError, match="no attribute 'no_such_name'"):
        foldshell.no_such_name  # noqa: B018


def test_the_examples_of_the_library_page_run(tmp_path, monkeypatch, capsys):
    """In their order, in one session, as a reader would type them."""
    monkeypatch.chdir(tmp_path)
    session = {}
    for example in EXAMPLES:
        exec(example, session)
    sized, said = session["sized"], capsys.readouterr().out
    assert sized.last.verdict in ("converged", "not_converged", "at_minimum_thickness")
    assert "the nearest is material.youngs_modulus_gpa" in said
    assert (tmp_path / "thickness.xlsx").exists() and (tmp_path / "dome.fold").exists()
    assert len(EXAMPLES[0].split("size_shell(shell)")[0].strip().splitlines()) <= 10


def test_a_shell_by_the_front_door_is_that_of_the_rules(tmp_path):
    """Pattern, fold, mesh and loop by the rules' own scripts, to the last bit."""
    import fold
    import mesh
    import pattern

    settings = foldshell.make_settings(
        {"analysis": {"subdivisions": 1}, "sizing": {"iterations_max": 3}}
    )
    paths = [tmp_path / name for name in ("a.fold", "folded.npz", "a.vtu", "a.json", "mesh.npz")]
    form = {"surface": "hypar", "span_m": 8.0, "height_m": 2.0}
    pattern.main(paths[0], design="a", **pattern_parameters(**form, zigzag=5, strip=6))
    fold.main(
        *paths[:4],
        design="a",
        **form,
        fold_mode="elastic",
        settings=stage_parameters(settings, "fold"),
    )
    mesh.main(
        paths[1],
        paths[4],
        tmp_path / "m.vtu",
        design="a",
        support="strip",
        subdivisions=1,
        edge_beam=(0.0, 0.0),
    )
    case = open_case(paths[4], read_stage(stage_parameters(settings, "analyse"), *ANALYSED))
    expected = run_loop(case, 8.0, settings.sizing)

    target = foldshell.make_target("hypar", 8.0, 2.0)
    folded = foldshell.fold_sheet(foldshell.make_sheet(target, 5, 6), target, settings=settings)
    sized = foldshell.size_shell(foldshell.mesh_shell(folded, "strip", settings))
    np.testing.assert_array_equal(sized.thickness, expected.arrays.thickness)
    assert sized.analyses == tuple(expected.analyses)  # the time they took does not count


def test_an_analysis_by_the_front_door_says_what_its_model_does_not_hold():
    """10 m of thickness on panels of 1 m is analysed as asked, and named."""
    settings = foldshell.make_settings({"analysis": {"subdivisions": 1}})
    target = foldshell.make_target("paraboloid", 8.0, 2.0)
    folded = foldshell.fold_sheet(foldshell.make_sheet(target, 5, 6), target, settings=settings)
    shell = foldshell.mesh_shell(folded, "all", settings)
    for thickness, count in ((0.05, 0), (10.0, 2)):
        assert len(foldshell.analyse_shell(shell, thickness).last.model_warnings) == count
