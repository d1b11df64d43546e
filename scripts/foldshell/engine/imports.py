"""Which library files a script depends on, found by following its import statements.

Snakemake runs a rule again when its script changes, but not when a module that the script imports
does. Rules therefore have as an input a list of these files with their hashes. The list stands for
the files because Snakemake looks at, hashes and records every input of every job, and there are
some forty files a job and a thousand jobs.
"""

import ast
import functools
import hashlib
import re
from collections.abc import Iterable
from pathlib import Path

from foldshell.files.package_data import library_folder
from foldshell.files.whole import hash_file, write_text_if_changed

PACKAGE = "foldshell"
_STATEMENT = re.compile(
    r"^[ \t]*(from[ \t]+[\w.]+[ \t]+import[ \t]*(?:\([^)]*\)|[^\n(]+)|import[ \t]+[\w., \t]+)", re.M
)


def write_library_list(script: str | Path, root: str | Path, folder: str | Path) -> str:
    """Write `<folder>/<script>-<hash>.sha256`, one line per library file; return its path.

    The name tells the content, so that a changed library is another input, whatever its date.
    """
    paths = map(Path, library_files(script, root))
    named = sorted((str(path.relative_to(_root_of(path, Path(root)))), path) for path in paths)
    lines = [f"{_hash(path)}  {name}" for name, path in named]
    return _write_list(lines, folder, Path(script).stem)


def write_content_list(paths: Iterable[str | Path], folder: str | Path) -> str:
    """Write `<folder>/content-<hash>.sha256`, one line per file; return its path."""
    lines = [f"{hash_file(path)}  {path}" for path in paths]
    return _write_list(lines, folder, "content")


def _write_list(lines: Iterable[str], folder: str | Path, name: str) -> str:
    text = "".join(f"{line}\n" for line in lines)
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    target = Path(folder) / f"{name}-{digest}.sha256"
    write_text_if_changed(target, text)
    return str(target)


@functools.cache
def _hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def library_files(script: str | Path, root: str | Path) -> list[str]:
    """Return the files below `root` that a script imports, directly or not, sorted.

    Parameters
    ----------
    script : path of a Python file
    root : the folder from which its imports are resolved; the library's own lie elsewhere where it
        is installed, and are found there
    """
    root = Path(root)
    found: set[Path] = set()
    pending = list(_imported(Path(script), root))
    while pending:
        path = pending.pop()
        if path not in found:
            found.add(path)
            pending.extend(_imported(path, root))
    return sorted(str(path) for path in found)


def _root_of(path: Path, root: Path) -> Path:
    return root if path.is_relative_to(root) else library_folder()


@functools.cache
def _imported(path: Path, root: Path) -> tuple[Path, ...]:
    """Return the files below `root` that one file imports, packages' __init__ included."""
    names = sorted(_imported_names(path.read_text(encoding="utf-8")))
    files = (file for name in names for file in _resolve(name, root))
    return tuple(file for file in dict.fromkeys(files) if file != path)


def _imported_names(text: str) -> set[str]:
    """Return the dotted names that a Python text imports, anywhere.

    Only its import statements are parsed: to parse the whole library takes a second of each start.
    One that stands in a docstring counts too, which makes a rule run once more at worst.
    """
    names: set[str] = set()
    for statement in _STATEMENT.findall(text):
        try:
            nodes = ast.parse(statement).body
        except SyntaxError:  # words of a docstring
            continue
        for node in nodes:
            if isinstance(node, ast.Import):
                names.update(alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names.add(node.module)
                names.update(f"{node.module}.{alias.name}" for alias in node.names)
    return names


@functools.cache
def _resolve(name: str, root: Path) -> tuple[Path, ...]:
    """Return the module file of a dotted name and the __init__ files on the way to it."""
    parts = name.split(".")
    if parts[0] == PACKAGE and not (root / PACKAGE).is_dir():
        root = library_folder()
    package_files = [root.joinpath(*parts[:k], "__init__.py") for k in range(1, len(parts) + 1)]
    module = root.joinpath(*parts).with_suffix(".py")
    if not (module.exists() or root.joinpath(*parts, "__init__.py").exists()):
        return ()
    return tuple(file for file in [*package_files, module] if file.exists())
