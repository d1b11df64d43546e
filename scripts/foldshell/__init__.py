"""Folded shell structures: pattern, folding, shell analysis, sizing, and their files.

`from foldshell import ...` gives the names below; docs/library.md shows them at work. Each is
imported when it is asked for, so that `import foldshell` costs nothing.
"""

import importlib

_HOMES = {
    "InputError": "foldshell.files.errors",
    "make_settings": "foldshell.settings.make",
    "make_target": "foldshell.folding.targets",
    "make_sheet": "foldshell.library",
    "fold_sheet": "foldshell.library",
    "mesh_shell": "foldshell.library",
    "analyse_shell": "foldshell.library",
    "size_shell": "foldshell.library",
    "write_workbook": "foldshell.library",
    "write_pattern": "foldshell.library",
    "read_panels": "foldshell.pattern.read_panels",
    "snakefile": "foldshell.library",
}

__all__ = list(_HOMES)


def __getattr__(name: str):
    """Import a name of the front door (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'foldshell' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    """Return the names of the front door beside the module's own."""
    return sorted([*globals(), *__all__])
