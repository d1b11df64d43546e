"""Pages over all designs."""

from foldshell.report.study_pages import write_settings_page, write_summary_page

HEADER = ("design,state,surface,span_m,height_m,zigzag,strip,support,volume_m3,volume_per_area_m,"
          "utilization_mean,utilization_p99,displacement_vertical_max_m,buckling_factor_min,"
          "mesh_error,crosscheck,iterations,reason")  # fmt: skip


def test_every_design_is_a_row_with_its_units(tmp_path):
    """Metres become mm, shares per cent; a design without results has dashes and its reason."""
    path = tmp_path / "summary.csv"
    good = "a,converged,arch,28,10,15,16,all,95.28,0.0646,0.64,2.4,0.0979,10.9,0.045,pass,15,met"
    bad = "b,unstable,arch,28,10,15,16,strip,,,,,,,,,1,<b>mechanism</b>"
    path.write_text(f"{HEADER}\n{good}\n{bad}\n")
    page = write_summary_page(path)
    assert '<a href="../a/page.html">a</a>' in page
    for text in ("64.6", "97.9", "4.5", "volume / area [mm]", "1 converged, 1 unstable: 2 in all"):
        assert text in page
    assert "&lt;b&gt;mechanism" in page
    assert page.count("<tr>") == 3
    for cell in ('"good">converged', '"good">pass', '"bad">unstable', '"">–'):
        assert f"<td class={cell}</td>" in page


def test_settings_are_listed_with_hash_and_versions():
    """Nested settings get dotted names."""
    page = write_settings_page({"combinations": {"strength": {"S1": {"SW": 1.4}}}}, "abc123",
                               {"numpy": "2.0"})  # fmt: skip
    for text in ("strength.S1.SW", "1.4", "abc123", "numpy", "2.0"):
        assert text in page
