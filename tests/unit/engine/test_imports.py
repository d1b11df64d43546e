"""The library files of a script are all that it imports, at any depth, and nothing else."""

import ast
from pathlib import Path

from foldshell.engine import imports
from foldshell.engine.imports import library_files, write_library_list

SCRIPTS = Path(__file__).parents[3] / "scripts"


def write(root: Path, name: str, text: str = "") -> Path:
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_imports_are_followed_two_deep(tmp_path):
    write(tmp_path, "lib/__init__.py")
    write(tmp_path, "lib/a.py", "from lib.b import thing\nimport numpy\n")
    write(tmp_path, "lib/b.py", "def thing():\n    from lib import c\n")
    write(tmp_path, "lib/c.py")
    write(tmp_path, "lib/unused.py")
    script = write(tmp_path, "run.py", "from lib.a import x\n")
    names = [Path(file).name for file in library_files(script, tmp_path)]
    assert names == ["__init__.py", "a.py", "b.py", "c.py"]


def test_every_import_of_the_project_is_found():
    """As by parsing each file whole."""
    for path in sorted(SCRIPTS.rglob("*.py")):
        text, whole = path.read_text(encoding="utf-8"), set()
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                whole |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                whole |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        assert whole <= imports._imported_names(text), path


def test_the_list_changes_with_the_library_and_only_then(tmp_path):
    write(tmp_path, "lib/__init__.py")
    module = write(tmp_path, "lib/a.py", "x = 1\n")
    script = write(tmp_path, "run.py", "from lib.a import x\n")

    def listed():
        imports._hash.cache_clear()
        target = Path(write_library_list(script, tmp_path, tmp_path / "lists"))
        return target.read_text(), target.name

    first = listed()
    assert [line.split()[1] for line in first[0].splitlines()] == ["lib/__init__.py", "lib/a.py"]
    assert listed() == first
    module.write_text("x = 2\n")
    second = listed()
    assert second[0] != first[0] and second[1] != first[1]


def test_every_entry_script_depends_on_what_it_loads():
    """The analysis depends on the element, not on pictures; nothing heavy enters the loop."""
    files = library_files(SCRIPTS / "analyse.py", SCRIPTS)
    names = {str(Path(file).relative_to(SCRIPTS)) for file in files}
    assert "foldshell/shell/element.py" in names
    assert not any("figures" in name or "folding" in name for name in names)


def test_analyse_and_resize_do_not_load_heavy_packages():
    """pandas, pyvista, matplotlib and meshio cost up to half a second per job."""
    import subprocess
    import sys

    for script in ("analyse", "resize"):
        code = (
            f"import sys; sys.path.insert(0, {str(SCRIPTS)!r}); import {script}; "
            "print([m for m in ('pandas', 'pyvista', 'matplotlib', 'meshio', 'vtk') "
            "if m in sys.modules])"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert done.stdout.strip() == "[]", done.stderr
