"""A full disk is one sentence that names the file, whatever library was writing."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[3] / "scripts"
LIMIT = 2000
"""Bytes that a file may have; the limit stands for a disk without space."""

WRITERS = {
    "a.json": "from foldshell.files.whole import write_json; write_json(path, list(range(9999)))",
    "a.npz": "import numpy as np; from foldshell.files.whole import write_arrays; "
    "write_arrays(path, {'a': np.zeros(9999)})",
    "a.xlsx": "from foldshell.workbook.styles import create_workbook\n"
    "with create_workbook(path, 'x') as (book, _):\n"
    "    sheet = book.add_worksheet()\n"
    "    for row in range(999): sheet.write(row, 0, f'{row * 7919 % 1009}')",
    "a.txt": "from foldshell.files.whole import atomic_path\n"
    "with atomic_path(path) as name:\n    name.write_text('text' * 9999)",
    "a.vtu": "import meshio, numpy as np; from foldshell.files.whole import atomic_path\n"
    "with atomic_path(path) as name:\n"
    "    cells = [('vertex', np.zeros((1, 1), int))]\n"
    "    meshio.write(name, meshio.Mesh(np.random.rand(999, 3), cells), file_format='vtu')",
    "a.png": "import numpy as np; from PIL import Image; from foldshell.files.whole import "
    "atomic_path\nwith atomic_path(path) as name:\n"
    "    Image.fromarray((np.random.rand(99, 99) * 255).astype('uint8')).save(name)",
}


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))


@pytest.mark.parametrize("name", WRITERS)
def test_the_file_is_named_and_nothing_is_left(tmp_path, name):
    body = "\n    ".join(WRITERS[name].splitlines())
    code = "from foldshell.files.errors import user_errors\n"
    code += f"path = {str(tmp_path / name)!r}\nwith user_errors():\n    {body}\n"
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        preexec_fn=limit_files,
        env=os.environ | {"PYTHONPATH": str(SCRIPTS), "PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert done.returncode == 1
    assert done.stderr.strip().splitlines()[-1].startswith(f"error: {tmp_path / name}: ")
    assert "free some space and start again" in done.stderr and "Traceback" not in done.stderr
    assert not list(tmp_path.iterdir())


def test_a_lack_of_memory_is_a_sentence(capsys):
    from foldshell.files.errors import user_errors

    with pytest.raises(SystemExit), user_errors():
        raise MemoryError
    assert "memory ran short" in capsys.readouterr().err


def test_a_pipe_as_a_table_is_refused_at_once(tmp_path):
    """To open it would wait for somebody who writes."""
    from foldshell.files.errors import InputError
    from foldshell.settings.designs import read_designs
    from foldshell.settings.make import make_settings, read_settings

    os.mkfifo(tmp_path / "designs.tsv")
    with pytest.raises(InputError, match="not a plain file"):
        read_designs(tmp_path / "designs.tsv", make_settings({}))
    with pytest.raises(InputError, match="not a plain file"):
        read_settings(tmp_path / "designs.tsv")
