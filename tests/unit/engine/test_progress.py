"""What a person sees of a study that runs."""

import pytest

import progress as script
from foldshell.engine.progress import describe_iteration, estimate_left, read_progress
from foldshell.records.analysis import write_analysis
from record_cases import make_analysis


def report(number, verdict="continue", **changes):
    known = {
        "iteration": number, "verdict": verdict, "reason": "why", "volume_m3": 12.345,
        "utilization_panel_mean_max": 0.98765, "displacement_vertical_max_m": 0.05,
        "buckling_factor": {"S1": 7.0, "S2": 3.456, "D1": None}, "seconds": 2.0,
    }  # fmt: skip
    return make_analysis(**known | changes)


def write(folder, design, *reports):
    for item in reports:
        write_analysis(folder / design / f"sizing/{item.iteration:02d}/analysis.json", item)


def test_line_of_an_iteration():
    assert describe_iteration("a", report(7)) == (
        "a iteration 07: volume 12.35 m3, largest panel mean of utilization 0.988, "
        "displacement 0.0500 m, buckling factor 3.46, continue: why"
    )


def test_line_of_an_unstable_iteration_has_no_made_up_numbers():
    line = describe_iteration("a", make_analysis(reason="factor 0.9", buckling_factor={}))
    assert "utilization -," in line and "buckling factor -," in line and "nan" not in line


def test_estimate(tmp_path):
    """a took 4 iterations, b has done 1 of as many, c none: 3 + 4 iterations of 2 s on 2 cores."""
    write(tmp_path, "a", *(report(n) for n in range(3)), report(3, "converged"))
    write(tmp_path, "b", report(0))
    found = read_progress(tmp_path, ["a", "b", "c"])
    assert [item.iterations for item in found] == [4, 1, 0]
    assert [item.done for item in found] == [True, False, False]
    assert estimate_left(found, 2) == pytest.approx((3 + 4) * 2 / 2)
    text = script.main(tmp_path, ["a", "b", "c"], 2)
    assert text.splitlines()[-1] == "1 of 3 designs sized, 5 iterations; left: about 7 s"
    assert "c: not begun" in text


def test_the_estimate_knows_that_large_designs_come_first(tmp_path):
    """a took 4 iterations of 2 s on a mesh of 3000 bytes; b will take 4 of a third of that, and c,
    without a mesh yet, 4 of the mean of both meshes: 8 / 3 + 16 / 3 s on one core."""
    write(tmp_path, "a", *(report(n) for n in range(3)), report(3, "converged"))
    for name, size in (("a", 3000), ("b", 1000)):
        (tmp_path / name / "shell").mkdir(parents=True)
        (tmp_path / name / "shell/mesh.npz").write_bytes(bytes(size))
    found = read_progress(tmp_path, ["a", "b", "c"])
    assert estimate_left(found, 1) == pytest.approx(4 * 2 / 3 + 4 * 2 * 2 / 3)


def test_iterations_left_over_behind_the_last_do_not_count(tmp_path):
    write(tmp_path, "a", report(0), report(1, "converged"), report(2), report(3))
    assert read_progress(tmp_path, ["a"])[0].iterations == 2


def test_half_written_files_do_not_stop_it(tmp_path):
    write(tmp_path, "a", report(0), report(1))
    (tmp_path / "a/sizing/01/analysis.json").write_text('{"iteration": 1, "verd')
    assert read_progress(tmp_path, ["a"])[0].iterations == 1
    assert estimate_left([], 2) is None


def test_a_warning_of_the_model_stands_beside_the_numbers():
    line = describe_iteration("a", make_analysis(model_warnings=("3 panels are thick", "b")))
    assert line.endswith("(model: 3 panels are thick; b)")
    assert "model" not in describe_iteration("a", make_analysis(model_warnings=()))
