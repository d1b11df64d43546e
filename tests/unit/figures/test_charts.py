"""Figures over all designs: sorting, histogram, and what is drawn for missing values."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.figures.charts import (
    describe_states,
    draw_axes_comparison,
    draw_comparison,
    save_figure,
)
from foldshell.figures.planarity_chart import (
    describe_correlation,
    draw_planarity_chart,
    group_medians,
)
from foldshell.figures.study_data import (
    StudyDesign,
    read_summary,
    utilization_edges,
    utilization_shares,
)
from foldshell.files.errors import InputError
from foldshell.records.summary import SummaryRow
from foldshell.records.table import write_rows
from foldshell.results.comparisons import (
    COMPARISONS,
    explain_left_out,
    pair_supports,
    sort_into_columns,
)
from foldshell.results.correlation import rank_correlation
from foldshell.settings.design import Design
from record_cases import make_summary


def design(surface="arch", support="strip", height=10, strip=16, state="converged", **number):
    """Return a design whose displacement is 10 times its height in mm."""
    values = {"span_m": 28.0, "height_m": height, "zigzag": 15, "strip": strip,
              "volume_per_area_m": 0.05, "utilization_mean": 0.4,
              "displacement_vertical_max_m": 0.01 * height}  # fmt: skip
    share = utilization_shares(np.array([0.35, 2.4]), np.array([3.0, 1.0]))
    name = f"{surface}-28-{height}-15x{strip}-{support}"
    tags = ("supports", "density", "curvature")
    return StudyDesign(name, tags, "miura", surface, support, state, values | number, share)


def test_histogram_adds_up_to_the_area():
    """Shares of 1000 random cells add up to 1; cells beyond the last edge count in the last bin."""
    rng = np.random.default_rng(6)
    share = utilization_shares(rng.exponential(0.6, 1000), rng.uniform(0.1, 2, 1000))
    assert share.sum() == pytest.approx(1, rel=1e-12)
    assert len(share) == len(utilization_edges()) - 1
    assert share[-1] > 0


def test_cells_stand_in_their_bin():
    """0.35 in [0.3, 0.4) with 3/4 of the area, 2.4 in the open last bin; 0.1 opens its own bin."""
    share = utilization_shares(np.array([0.35, 2.4]), np.array([3.0, 1.0]))
    assert share[3] == 0.75
    assert share[-1] == 0.25
    assert utilization_shares(np.array([0.1]), np.array([1.0]))[1] == 1


def test_columns_and_series_keep_the_papers_order():
    """Surfaces: paraboloid, hypar, arch; supports: all, zig-zag, strip, whatever comes first."""
    designs = [design(s, e) for s in ("arch", "hypar", "paraboloid")
               for e in ("strip", "all", "zigzag")]  # fmt: skip
    columns = sort_into_columns(designs, COMPARISONS["supports"])
    assert list(columns) == ["paraboloid", "hypar", "arch"]
    assert all(list(c) == ["all", "zigzag", "strip"] for c in columns.values())
    assert columns["hypar"]["zigzag"].name == "hypar-28-10-15x16-zigzag"


def test_density_is_compared_within_one_support():
    """Only strip-supported designs, by their number of polylines."""
    designs = [design(strip=16), design(strip=32), design(strip=32, support="zigzag")]
    columns = sort_into_columns(designs, COMPARISONS["density_strip"])
    assert {k: list(v) for k, v in columns.items()} == {"arch": ["15x16", "15x32"]}


def test_one_bar_is_no_chart():
    """A column with a single design is left out, and a chart of such columns is not made."""
    designs = [design(), design("hypar"), design("hypar", height=6)]
    assert list(sort_into_columns(designs, COMPARISONS["curvature"])) == [
        "hypar, strip edges supported"
    ]
    row = Design(name="a", surface="arch", support="all", tags=("supports",))
    rows = [row, replace(row, support="strip")]
    assert set(explain_left_out(rows)) == {
        "surface", "curvature", "density_zigzag", "density_strip", "axes"
    }  # fmt: skip
    dense = [replace(one, tags=("density",)) for one in rows]
    assert explain_left_out(dense)["density_zigzag"].startswith("of the 2 designs tagged density")
    plain = [replace(one, tags=("mine",), pattern="smooth") for one in rows]
    assert len(explain_left_out(plain)) == 7
    assert explain_left_out(plain)["supports"] == "no two designs tagged supports to compare"


def test_pairs_differ_in_the_support_alone():
    """A design without its counterpart is in no pair."""
    zigzag, strip = design(support="zigzag"), design()
    found = pair_supports([strip, design(strip=32), zigzag, design(support="all")])
    assert found == [(zigzag, strip)]


def test_bars_show_the_values():
    """Displacements of 60 and 100 mm are bars of that height; the limit is 28 m / 240."""
    designs = [design(height=6), design(height=10)]
    figure = draw_comparison(designs, COMPARISONS["curvature"])
    axes = figure.axes[1]
    assert [patch.get_height() for patch in axes.patches] == pytest.approx([60, 100])
    limit = [line.get_ydata()[0] for line in axes.lines]
    assert limit == pytest.approx([1e3 * 28 / 240] * 2)


def test_design_without_a_result_is_named_by_its_state():
    """No bar, but the word; the star is explained."""
    missing = design(height=28, state="unstable", displacement_vertical_max_m=float("nan"))
    figure = draw_comparison([design(), missing], COMPARISONS["curvature"])
    assert len(figure.axes[1].patches) == 1
    assert " unstable" in [text.get_text() for text in figure.axes[1].texts]
    assert describe_states([design(), missing]) == "* unstable"
    assert describe_states([design()]) is None


def test_strong_axis_chart_has_a_row_a_pair():
    """Two markers a pair at its two displacements."""
    stiff = design(support="zigzag", displacement_vertical_max_m=0.03)
    figure = draw_axes_comparison([stiff, design()])
    first, second = figure.axes[0].lines
    assert first.get_xdata() == pytest.approx([30])
    assert second.get_xdata() == pytest.approx([100])


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_figures_are_the_same_bytes_again(tmp_path, kind):
    """No dates and no random names in the files."""
    for name in "ab":
        figure = draw_comparison([design(), design(height=6)], COMPARISONS["curvature"])
        save_figure(figure, [tmp_path / f"{name}.{kind}"])
    assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()


def test_study_without_such_designs_says_so(tmp_path):
    """The file that the rule promises is there, with a sentence in it."""
    figure = draw_comparison([], COMPARISONS["supports"])
    assert "no design of this comparison" in figure.texts[0].get_text()
    save_figure(figure, [tmp_path / "empty.png"])
    assert (tmp_path / "empty.png").stat().st_size > 1000


def test_summary_is_read_with_its_gaps(tmp_path):
    """An empty cell is nan, tags are split at commas."""
    row = make_summary(tags="x,supports", span_m=1.5)
    write_rows(tmp_path / "summary.csv", SummaryRow, [row])
    (found,) = read_summary(tmp_path / "summary.csv")
    assert found.tags == ("x", "supports")
    assert np.isnan(found.number["volume_per_area_m"])
    assert found.number["span_m"] == 1.5


def test_damaged_summary_is_named(tmp_path):
    """File, row, column, value and what is allowed."""
    path = tmp_path / "summary.csv"
    write_rows(path, SummaryRow, [make_summary(span_m=1.5)])
    path.write_text(path.read_text().replace("1.5", "wide"))
    with pytest.raises(InputError, match=r"summary\.csv: row 1: span_m: 'wide': must be a number"):
        read_summary(path)
    path.write_text("design,tags\na,x\n")
    with pytest.raises(InputError, match="row 1: pattern: is missing"):
        read_summary(path)


def test_rank_correlation_sees_order_alone():
    """exp keeps the order, minus turns it round, a constant has none."""
    values = np.random.default_rng(8).normal(size=50)
    assert rank_correlation(values, np.exp(values)) == pytest.approx(1)
    assert rank_correlation(values, -(values**3)) == pytest.approx(-1)
    assert np.isnan(rank_correlation(values, np.ones(50)))


def test_rank_correlation_is_that_of_scipy_with_equal_values_too():
    """Integers of a small range are equal in long rows; ranks are halves of integers, so exact."""
    from scipy.stats import spearmanr

    first, second = np.random.default_rng(9).integers(0, 7, size=(2, 200))
    expected = spearmanr(first, second).statistic
    assert rank_correlation(first, second) == pytest.approx(expected, abs=1e-14)


def test_correlation_within_designs_is_not_that_of_all():
    """Two designs, each falling, the second higher in both: pooled it rises, within it falls."""
    fall = np.stack([np.linspace(0, 0.1, 20), np.linspace(0.2, 0.1, 20)])
    words = describe_correlation([fall, fall + 1])
    assert words.endswith("within designs -1.00")
    assert float(words.split()[2].rstrip(";")) > 0.4


def test_medians_of_groups():
    """Of 100 values on a line each tenth has its middle as median."""
    x, y = group_medians(np.arange(100.0)[::-1], 2 * np.arange(100.0)[::-1])
    assert np.array_equal(x, np.arange(4.5, 100, 10))
    assert np.array_equal(y, 2 * x)


def test_baselines_stay_out_of_the_planarity_chart():
    """Smooth and flat sheets are not folded: without others the chart says there is nothing."""
    panels = np.random.default_rng(9).uniform(size=(2, 30))
    smooth = replace(design(), pattern="smooth", panels=panels)
    assert "no folded design" in draw_planarity_chart([smooth]).texts[0].get_text()
    figure = draw_planarity_chart([smooth, replace(design(), panels=panels)])
    assert figure.axes[0].get_title().startswith("arch\nrank correlation")
