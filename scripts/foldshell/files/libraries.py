"""Libraries that the workflow itself does without."""

import importlib
from types import ModuleType

from foldshell.files.errors import InputError
from foldshell.files.package_data import is_installed

LISTS = ("exports", "archive", "sheets", "explore", "cluster", "storage", "bench")
"""Optional lists: envs/<list>.in says what is in them, envs/<list>.lock versions and hashes."""


def need_library(module: str, group: str) -> ModuleType:
    """Import a module of an optional list; raises `InputError` with what to type if it is missing.

    A library that is there and fails to load is missing too: the sentence repeats its words.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        absent = isinstance(error, ModuleNotFoundError) and error.name == module.partition(".")[0]
        reason = "is not installed" if absent else f"cannot be loaded ({error})"
        raise InputError(f"{module}: {reason}: type {describe_install(group)}") from None


def describe_install(group: str) -> str:
    """Return the command that installs an optional list."""
    if is_installed():
        return f"python -m pip install 'foldshell[{group}]'"
    return f"python -m pip install --require-hashes -r envs/{group}.lock"
