"""Entry script of rule resize."""

import numpy as np
import pytest

import resize
from foldshell.files.whole import read_arrays, write_arrays
from foldshell.records.analysis import Criteria, write_analysis
from foldshell.records.edits import is_edited
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.read_thickness import read_thickness
from record_cases import make_analysis, make_criterion
from sizing_case import PANELS, STRIP, ZIGZAG, stage

USED = np.linspace(0.1, 1.2, PANELS)


def _analysis(folder, state="ok", **arrays):
    criteria = Criteria(displacement_vertical_m=make_criterion())
    factors = {"S1": 9.0, "D1": None}
    record = make_analysis(state=state, criteria=criteria, buckling_factor=factors, volume_m3=4.0)
    write_analysis(folder / "analysis.json", record)
    write_arrays(folder / "analysis.npz", {"thickness": np.full(PANELS, 0.1), **arrays})
    return folder / "analysis.json", folder / "analysis.npz"


def _run(folder, analysis, memory=None, **sizing):
    book = folder / "01/thickness.xlsx"
    resize.main(
        *analysis, book, folder / "01/memory.npz", folder / "01/written.json", design="small",
        zigzag=ZIGZAG, strip=STRIP, settings=stage("resize", **sizing),
        previous_memory=memory,
    )  # fmt: skip
    return read_thickness(book, make_panel_grid(ZIGZAG, STRIP), 0.04, 1.0), book


def test_panels_move_by_the_dead_band(tmp_path):
    """10 % down below 0.6, 10 % up above 1, none in between (Tsiamis et al. 2018)."""
    new, book = _run(tmp_path, _analysis(tmp_path, utilization_panel_mean=USED), rule="dead_band")
    expected = np.where(USED > 1, 0.11, np.where(USED < 0.6, 0.09, 0.1))
    assert new == pytest.approx(expected, rel=1e-12)
    assert not is_edited(book)


def test_other_measure_is_read(tmp_path):
    analysis = _analysis(
        tmp_path, utilization_panel_mean=USED, utilization_element_max=np.full(PANELS, 2.0)
    )
    new, _ = _run(tmp_path, analysis, rule="dead_band", measure="element_max")
    assert new == pytest.approx(np.full(PANELS, 0.11))


def test_memory_goes_on_to_the_next_step(tmp_path):
    """Unstable after a stable step of 100 mm: thicken from there, with the reason as a note."""
    _run(tmp_path, _analysis(tmp_path, utilization_panel_mean=USED), rule="dead_band")
    memory = read_arrays(tmp_path / "01/memory.npz")
    assert np.array_equal(memory["stable"], np.full(PANELS, 0.1))
    unstable = _analysis(tmp_path, "unstable")
    new, _ = _run(tmp_path / "b", unstable, tmp_path / "01/memory.npz", rule="dead_band")
    assert new == pytest.approx(np.full(PANELS, 0.11))


def test_same_values_same_bytes(tmp_path):
    analysis = _analysis(tmp_path, utilization_panel_mean=USED)
    books = [_run(tmp_path / name, analysis)[1] for name in "ab"]
    assert books[0].read_bytes() == books[1].read_bytes()
