"""Rule page: one file per design, whatever became of it."""

import html
import re
import shutil
import subprocess

import numpy as np
import pytest

import page
from foldshell.records.analysis import Criteria
from foldshell.report import page as library
from foldshell.report.arrays import unpack_arrays
from foldshell.report.sections import describe_design
from foldshell.settings.design import Design
from record_cases import make_comparison, make_criterion, make_quantity
from report_cases import DESIGN, SETTINGS, read_data, write_files

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("chrome")


def run(folder, design=DESIGN, **options):
    """Call the script's main; return the page's text."""
    folder.mkdir(exist_ok=True)
    paths, pictures = write_files(folder, **options)
    page.main(paths, pictures, folder / "page.html", design=design, settings=SETTINGS)
    return (folder / "page.html").read_text(encoding="utf-8")


def test_page_holds_everything_that_is_said_of_the_design(tmp_path):
    """Verdict, criteria, cross-check, classes, history, picture; arrays that can be read back."""
    text = run(tmp_path, criteria=Criteria(utilization_panel_mean=make_criterion()))
    words = html.unescape(re.sub(r"<[^>]*>", " ", text.split("<script", maxsplit=1)[0]))
    for part in ("converged", "all criteria are met", "utilization, largest panel mean [-]",
                 "not within tolerance", "S2 work [kNm]", "+12.0 %", "history",
                 "planarity"):  # fmt: skip
        assert part in words or part in text
    assert "data:image/webp;base64," in text
    assert 'href="sheet.html"' in text.split("<main>", maxsplit=1)[0]
    facts, packed = read_data(text)
    arrays = unpack_arrays(facts["arrays"], packed)
    fields = {f"field_{field['name']}" for field in facts["fields"]} - {"field_displacement"}
    assert fields < set(arrays)
    assert arrays["moved"].shape[0] == len(facts["combinations"]) == 4


def test_page_says_that_a_person_changed_panels(tmp_path):
    """Beside the verdict: which workbook, how many panels."""
    assert "A person changed" not in run(tmp_path)
    assert "in the workbook of iteration 01 (3 panels)" in run(tmp_path, edited=3)


def test_page_asks_no_host(tmp_path):
    """No address but the files beside it; the policy forbids the rest."""
    text = run(tmp_path)
    assert "default-src 'none'" in text
    assert not re.search(r"(?:src|href)=\"(?:https?:)?//", text)
    assert "http" not in text.replace("http-equiv", "")


def test_hostile_texts_stay_texts(tmp_path):
    """A reason that closes the script is shown as it is."""
    evil = "</script><script>alert(1)</script>"
    text = run(tmp_path, design=DESIGN | {"tags": evil}, reason=evil)
    assert text.count("<script") == text.count("</script>") == 3
    assert "&lt;script&gt;alert(1)" in text


@pytest.mark.parametrize("pattern", ["miura", "smooth", "flat"])
def test_unstable_and_plain_designs_have_a_page(tmp_path, pattern):
    """No displacements, no classes, no criteria, one analysis: the page says so."""
    text = run(
        tmp_path, DESIGN | {"pattern": pattern}, folded=pattern != "flat", utilization=None,
        move=lambda x: np.nan * x, classes=False, history=False, verdict="unstable",
        reason="a mechanism", buckling_factor={"S1": None}, iteration=0,
        comparison=make_comparison(False, reason="nothing to compare"),
    )  # fmt: skip
    for part in ("unstable", "a mechanism", "No criteria", "nothing to compare", "1 analysis"):
        assert part in text
    facts, _ = read_data(text)
    assert [field["name"] for field in facts["fields"]] == ["thickness", "planarity"]


def test_page_gives_way_to_the_size_limit(tmp_path, monkeypatch):
    """First combinations are only to be looked at, then pictures go; what still is too large is
    refused."""
    full = run(tmp_path)
    monkeypatch.setattr(library, "SIZE_MAX", len(full.encode()) - 1)
    coarse = run(tmp_path)
    types = {array["name"]: array["type"] for array in read_data(coarse)[0]["arrays"]}
    assert types["moved"] == "uint8" and coarse.count("data:image/webp") == 2
    monkeypatch.setattr(library, "SIZE_MAX", len(coarse.encode()) - 1)
    assert run(tmp_path).count("data:image/webp") == 1
    monkeypatch.setattr(library, "SIZE_MAX", 1000)
    with pytest.raises(ValueError, match="1000 at most"):
        run(tmp_path)


def test_same_files_same_bytes(tmp_path):
    """Two runs write the same page."""
    assert run(tmp_path / "a") == run(tmp_path / "b")


def browse(page_path, *options):
    """Return what Chromium has made of a page."""
    command = [
        CHROMIUM, "--headless", "--no-sandbox", f"--user-data-dir={page_path.parent / 'browser'}",
        "--virtual-time-budget=20000", "--dump-dom", *options,
        f"{page_path.as_uri()}#field=utilization&deform=50&panel=7",
    ]  # fmt: skip
    return subprocess.run(command, capture_output=True, text=True, timeout=180, check=True).stdout


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
@pytest.mark.parametrize("width", [600, 1400])
def test_page_draws_in_a_browser(tmp_path, width):
    """The 3D view says it is ready; field, deformation and panel are those of the address."""
    run(tmp_path)
    software = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
    found = browse(tmp_path / "page.html", *software, f"--window-size={width},900")
    assert 'data-state="ready"' in found
    assert '<p id="quantity">utilization [-], largest of S1 to S2</p>' in found
    assert '<span id="factor">drawn × ' in found
    assert "panel 7 · zigzag 1 · strip 2" in found


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_page_without_webgl_says_so(tmp_path):
    """Tables and pictures stand where no 3D view can be made."""
    run(tmp_path)
    found = browse(tmp_path / "page.html", "--disable-3d-apis")
    assert 'data-state="no-view"' in found
    assert "this browser offers no WebGL 2" in found
    assert "all criteria are met" in found
    assert "data:image/webp;base64," in found


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
@pytest.mark.parametrize("webgl", [True, False])
def test_menus_are_there_only_with_the_view_that_they_belong_to(tmp_path, webgl):
    """With WebGL: menus, no still picture. Without: the picture in place of view and menus."""
    run(tmp_path)
    path = tmp_path / "page.html"
    probe = """<script>setTimeout(() => {
      for (const name of ["field", "view", "still", "no-view"])
        document.body.dataset[name.replace("-", "")] =
          document.getElementById(name).checkVisibility();
    }, 4000);</script>"""
    text = path.read_text(encoding="utf-8").replace("</body>", f"{probe}</body>")
    path.write_text(re.sub(r"script-src '[^']+'", "script-src 'unsafe-inline'", text))
    flags = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
    body = re.search(r"<body[^>]*>", browse(path, *(flags if webgl else ("--disable-3d-apis",))))[0]
    assert f'data-state="{"ready" if webgl else "no-view"}"' in body
    shown = {"field": webgl, "view": webgl, "still": not webgl, "noview": not webgl}
    for name, visible in shown.items():
        assert f'data-{name}="{str(visible).lower()}"' in body


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_hostile_texts_do_not_run_in_a_browser(tmp_path):
    """Markup in every text that a file can hold: the title stays, nothing is added to the page."""
    act = "document.title='owned'"
    evil = f'</script></title><img src=x onerror="{act}"><script>{act}</script>'
    run(
        tmp_path, DESIGN | {"tags": evil, "surface": evil}, reason=evil,
        comparison=make_comparison(False, {evil: make_quantity()}, reason=evil),
    )  # fmt: skip
    found = browse(tmp_path / "page.html", "--disable-3d-apis")
    assert "<title>case</title>" in found
    assert found.count("<script") == 3
    assert "&lt;img src=x onerror" in found
    assert '<img src="x"' not in found


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_single_combination_has_its_own_fields_arrows_and_section_forces(tmp_path):
    """The address chooses combination and panel: its words, reactions by edge, one row of section
    forces; the envelope has a row for each combination."""
    run(tmp_path)
    path, software = tmp_path / "page.html", ("--use-angle=swiftshader",)
    text = path.read_text(encoding="utf-8")
    found = browse(path, *software, "--enable-unsafe-swiftshader")
    assert found.count('<tr><td class="">') == 4
    facts, packed = read_data(text)
    arrays = unpack_arrays(facts["arrays"], packed)
    assert [one["name"] for one in facts["combinations"]] == ["S1", "S2", "D1", "D2"]
    assert facts["iterations"] == [0, 1]
    assert np.allclose(arrays["iteration_thickness"][0] - arrays["iteration_thickness"][1], 0.01,
                       atol=1e-5)  # fmt: skip
    path.write_text(text.replace("location.hash.slice(1)", '"combination=S2&loads&panel=7"'))
    # another script, so another fingerprint: the policy of the page would not let it run
    path.write_text(re.sub(r"script-src '[^']+'", "script-src 'unsafe-inline'", path.read_text()))
    found = browse(path, *software, "--enable-unsafe-swiftshader")
    assert "Reactions [kN]: first strip edge x" in found
    assert found.count('<tr><td class="">') == 1


@pytest.mark.parametrize(
    ("pattern", "words"),
    [("miura", "folded in mode elastic"), ("flat", "laid out, not folded"), ("smooth", "laid out")],
)
def test_what_was_not_folded_is_not_said_to_be(pattern, words):
    assert words in describe_design(Design(name="a", pattern=pattern))
