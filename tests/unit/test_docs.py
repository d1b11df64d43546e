"""Docs: every link and path is there, the map is that of the tree, Python examples run."""

import re
import runpy
from pathlib import Path

import pytest

from foldshell.settings.check import iterate_settings
from foldshell.settings.study import Settings

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"`((?:scripts|rules|tests|config|docs|envs)/[\w./*-]*\w/?)[^`]*`")
SETTING = re.compile(r"`([a-z_]+(?:\.[a-z_0-9]+)+)(?::[^`]*)?`")
FILES = (".py", ".json", ".xlsx", ".csv", ".tsv", ".npz", ".md", ".fold", ".vtu", ".svg")
ROOMS = {path.parent.name for path in (ROOT / "scripts/foldshell").glob("*/__init__.py")}
MODULE = re.compile(rf"`((?:{'|'.join(sorted(ROOMS))})/\w+\.(?:py|js|css))`")


def anchors(page):
    """Names that links into a page may end in, as GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", words.lower()).replace(" ", "-") for words in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in LINK.findall(page.read_text(encoding="utf-8")):
        if re.match(r"https?:", target):
            continue
        name, _, anchor = target.partition("#")
        path = (page.parent / name).resolve() if name else page
        assert path.exists(), f"{page.name}: {target}: no such file"
        assert not anchor or anchor in anchors(path), f"{page.name}: {target}: no such heading"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_paths_in_the_text_are_there(page):
    text = page.read_text(encoding="utf-8")
    named = [(ROOT, path) for path in PATH.findall(text)]
    named += [(ROOT / "scripts/foldshell", path) for path in MODULE.findall(text)]
    for folder, path in named:
        if "results/" not in path:
            assert list(folder.glob(path.rstrip("/"))), f"{page.name}: {path}: no such file"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_settings_named_in_the_text_are_there(page):
    """`group.key`, also with a value behind it, is a key of config.yaml; file names are none."""
    known = {place for place, _ in iterate_settings(Settings)}
    for place in set(known):
        parts = place.split(".")
        known |= {".".join(parts[:count]) for count in range(1, len(parts))}
    for name in SETTING.findall(page.read_text(encoding="utf-8")):
        if name.split(".")[0] in {place.split(".")[0] for place in known}:
            typed = any(place.startswith(f"{name}_") for place in known)  # without its unit
            found = name in known or typed or name.endswith(FILES)
            assert found, f"{page.name}: {name}: no such setting"


def test_the_map_is_that_of_the_tree(monkeypatch):
    """Picture and table of rooms; every rule that it draws has its script."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    made = runpy.run_path(str(ROOT / "docs/draw_map.py"))
    rooms = made["list_rooms"]()
    renew = "run PYTHONPATH=tests python docs/draw_map.py"
    assert {name for name, _ in rooms} == ROOMS and all(text for _, text in rooms)
    assert made["draw_map"](rooms) == made["PICTURE"].read_text(encoding="utf-8"), renew
    assert made["write_table"](rooms) in made["PAGE"].read_text(encoding="utf-8"), renew
    for step in (*made["RUN"], *made["AFTER"], *made["STUDY"]):
        assert (ROOT / f"scripts/{step.rule}.py").exists(), step.rule


def test_the_readme_and_the_map_say_where_to_add_what():
    """A newcomer finds each in the first place one looks."""
    words = "target surface|load case|check of the model|strength criterion|criterion of the loop|"
    words += "export|column of the summary|figure|claim|solver"
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    page = (ROOT / "docs/map.md").read_text(encoding="utf-8")
    for word in words.split("|"):
        assert re.search(rf"^\| {word}[a-z ]* \| .*`", readme, re.M), word
        assert re.search(rf"^\| an? \*\*{word}", page, re.M), word


EXAMPLES = [page for page in PAGES if "```python" in page.read_text(encoding="utf-8")]


@pytest.mark.parametrize("page", EXAMPLES, ids=lambda page: page.name)
def test_python_examples_run(page, tmp_path, monkeypatch):
    """In their order, in one session, as a reader would type them."""
    monkeypatch.chdir(tmp_path)
    session = {}
    for example in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
        exec(example, session)


def test_citation_codemeta_and_package_agree():
    """One name, version and licence, whatever file a catalogue reads."""
    import json
    import tomllib

    import yaml

    package = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    meta = json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))
    assert package["version"] == str(citation["version"]) == meta["version"]
    assert citation["license"] == "MIT" and meta["license"].endswith("/MIT")
    assert meta["name"] == package["name"] == citation["title"].partition(":")[0]
    paper = citation["references"][0]["doi"]
    assert meta["referencePublication"]["identifier"].endswith(paper)
