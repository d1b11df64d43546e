"""The cross-check must not share a line with what it checks."""

import ast
from pathlib import Path

SCRIPTS = Path(__file__).parents[3] / "scripts"
ALLOWED = {"crosscheck", "numpy", "scipy", "xlsxwriter", "openseespy", "shapely"}


def find_imports(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            found.add(node.module.split(".")[0])
        elif isinstance(node, ast.Call) and "import" in ast.unparse(node.func):
            found.add(f"a call of {ast.unparse(node.func)}")
    return found


def allowed_in_entry(path: Path) -> set[str]:
    """Return the library where an entry script imports nothing of it but the record of its job, in
    the block that Snakemake runs: that notes hashes of files and hands no number on."""
    text = path.read_text(encoding="utf-8")
    head, _, block = text.partition('if "snakemake" in globals():')
    lines = [line.strip() for line in block.splitlines() if "foldshell" in line]
    only = all(line.startswith("from foldshell.engine.job import run_job") for line in lines)
    return {"foldshell"} if lines and only and "foldshell" not in head else set()


def test_cross_check_imports_nothing_of_the_library():
    import sys

    entries = [SCRIPTS / "compare.py", SCRIPTS / "crosscheck_opensees.py"]
    files = [*entries, *sorted((SCRIPTS / "crosscheck").rglob("*.py"))]
    assert len(files) > 10
    for path in files:
        foreign = find_imports(path) - allowed_in_entry(path) - ALLOWED
        foreign -= set(sys.stdlib_module_names)
        assert not foreign, f"{path.name} imports {foreign}"


def test_the_walk_sees_an_import_of_the_library(tmp_path):
    path = tmp_path / "slip.py"
    path.write_text("def f():\n    from foldshell.loads import cases as loads\n    return loads\n")
    assert "foldshell" in find_imports(path)
    path.write_text("import importlib\nimportlib.import_module('fold' + 'shell')\n")
    assert find_imports(path) - {"importlib"}
