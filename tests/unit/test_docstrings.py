"""Docstrings say what arrays are; functions, modules, scripts and rules keep their sizes."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FILES = sorted(path for path in (ROOT / "scripts").rglob("*.py") if path.parent.name != "data")
FUNCTION_LINES, FUNCTION_LINES_P90 = 40, 22
"""Of code: the docstring of a function, which may be as long as it needs, does not count."""
LENGTHS = {"scripts/*.py": 60, "scripts/*/**/*.py": 300, "rules/*.smk": 120, "Snakefile": 80}

_AXIS = r"(?:[\w.^*/+' \-]|\([\w+*/ \-]*\))+"
SHAPE = re.compile(rf"\({_AXIS},(?:{_AXIS},?)*\)")
"""(N, 3), (P,), (..., 2), (E, cells^2), (len(panels), P)."""
UNIT = re.compile(
    r"\[[^\]]*\]|\(-\)|\b(kN|kPa|MPa|rad|deg|m|mm|m2|m3|kNm)\b(?!')"
    r"|\b(unit|units|Unit|[Nn]umbers?|rows?|index|indices|ids|True|bool|uint8|dofs|Dof"
    r"|unknowns|Unknowns|Whether|share|ratio|relative|counts?|weights|mask)\b"
)
"""A unit, or a word that says why there is none."""
ARRAY = re.compile(r"\b(ndarray|NDArray|ArrayLike|FloatArray|IntArray)\b")


def list_public(tree):
    """Yield functions and methods that others may call."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            methods = [inner for inner in node.body if isinstance(inner, ast.FunctionDef)]
            yield from (inner for inner in methods if not inner.name.startswith("_"))


def list_annotations(function):
    """Return the annotations of a function's arguments and of what it returns, as text."""
    arguments = function.args
    every = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    found = [one.annotation for one in every if one.annotation] + [function.returns]
    return [ast.unparse(one) for one in found if one is not None]


def find_gaps(function):
    """Return what the docstring of a public function leaves out."""
    text = ast.get_docstring(function)
    if not text:
        return ["docstring"]
    arrays = [one for one in list_annotations(function) if ARRAY.search(one)]
    if not arrays:
        return []
    named = all("Mapping" in one or "dict" in one for one in arrays)
    if named and ".npz" in text:  # their axes and units stand in docs/records.md
        return []
    return [word for word, rule in (("shape", SHAPE), ("unit", UNIT)) if not rule.search(text)]


def count_lines(function):
    """Lines of a function without its docstring."""
    first = function.body[0]
    text = ast.get_docstring(function, clean=False) is not None
    return function.end_lineno - function.lineno + 1 - text * (first.end_lineno - first.lineno + 1)


def test_public_functions_name_shape_and_unit_of_their_arrays():
    gaps = [
        f"{path.relative_to(ROOT)}:{function.lineno} {function.name}: {', '.join(missing)}"
        for path in FILES
        for function in list_public(ast.parse(path.read_text(encoding="utf-8")))
        if (missing := find_gaps(function))
    ]
    assert not gaps, "docstrings without what they owe:\n" + "\n".join(gaps)


@pytest.mark.parametrize(
    ("text", "missing"),
    [
        ("Return x (N, 3) m.", []),
        ("Return x (P,) in kN/m.", []),
        ("Return x (len(panels), P) without unit.", []),
        ("Return x (N, 3).", ["unit"]),
        ("Return x, in m (as the table has it).", ["shape"]),
        ("Return the arrays of mesh.npz.", ["shape", "unit"]),
        ("", ["docstring"]),
    ],
)
def test_gaps_are_seen(text, missing):
    source = f'def f(x: np.ndarray) -> np.ndarray:\n    """{text}"""\n    return x'
    assert find_gaps(ast.parse(source).body[0]) == missing


def test_functions_are_short():
    """Nine in ten of all functions, tests left out, fit in 22 lines; none is above 40."""
    found = [
        (count_lines(node), f"{path.relative_to(ROOT)}:{node.lineno} {node.name}")
        for path in FILES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef)
    ]
    long = [place for lines, place in found if lines > FUNCTION_LINES]
    assert not long, "functions above 40 lines: " + "; ".join(long)
    lengths = sorted(lines for lines, _ in found)
    assert lengths[int(0.9 * len(lengths))] <= FUNCTION_LINES_P90


@pytest.mark.parametrize(("pattern", "most"), LENGTHS.items())
def test_files_are_short(pattern, most):
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for path in ROOT.glob(pattern)
    }
    assert lengths
    long = [f"{name} ({lines})" for name, lines in lengths.items() if lines > most]
    assert not long, f"above {most} lines: " + "; ".join(long)
