"""The command `foldshell`: a study of one's own, run, watched, verified and looked at."""

import argparse
import os
import subprocess
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.environment import choose_cache
from foldshell.engine.new_study import make_study_folder
from foldshell.files.errors import InputError, user_errors
from foldshell.files.package_data import library_folder, workflow_folder

_HELP = {
    "new": "make a folder for a study: table, config, README, Snakefile",
    "run": "run the study of this folder: foldshell run [TARGET or option of snakemake ...]",
    "progress": "say how far a run is",
    "verify": "say whether the results are still what was made, or an archive what was put in",
    "archive": "pack the study of this folder into one file: foldshell archive [option ...]",
    "explore": "search the pattern by a file of config/explorations: foldshell explore FILE [...]",
    "look": "open the page of a design, or print where it is",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the command line says; return the exit code."""
    parser = argparse.ArgumentParser(prog="foldshell", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    parts = {name: commands.add_parser(name, help=text) for name, text in _HELP.items()}
    parts["new"].add_argument("folder")
    parts["explore"].add_argument("file")
    parts["look"].add_argument("design")
    parts["look"].add_argument("--results", default="results")
    given, more = parser.parse_known_args(arguments)
    if more and given.command in ("new", "look"):
        parser.error(f"unknown arguments: {' '.join(more)}")
    with user_errors():
        if given.command == "new":
            print(f"{make_study_folder(given.folder)}: made; go there and type: foldshell run")
            return 0
        if given.command == "look":
            return look_at(given.design, Path(given.results))
        if given.command == "explore":
            if not Path(given.file).is_file():
                raise InputError(f"{given.file}: no such file of an exploration")
            more = ["explore", *more, "--config", f"exploration={given.file}"]
            return run_program("run", more)
        return run_program(given.command, more)


def run_program(name: str, arguments: Sequence[str]) -> int:
    """Run Snakemake, or one of the scripts beside the rules, in this folder."""
    program = [sys.executable, str(workflow_folder() / f"scripts/{name}.py")]
    if name in ("run", "archive"):
        if not Path("Snakefile").is_file():
            raise InputError("Snakefile: there is none here: make a study by foldshell new FOLDER")
        program = [sys.executable, "-m", "snakemake", *(["archive"] if name == "archive" else [])]
        if not any(word.startswith(("-c", "--cores", "-j", "--jobs")) for word in arguments):
            program += ["--cores", str(count_cores())]
    path = [str(library_folder()), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = dict(os.environ) | {"PYTHONPATH": os.pathsep.join(path)}
    choose_cache(environment, ".snakemake/cache")
    try:
        return subprocess.call([*program, *arguments], env=environment)
    except KeyboardInterrupt:
        return 130


def count_cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def look_at(design: str, results: Path) -> int:
    """Open the page of a design in a browser where there is a display, and say where it is."""
    pages = [path for path in results.glob("**/page.html") if path.parent.name == design]
    if not pages:
        known = sorted(path.parent.name for path in results.glob("**/page.html"))
        hint = f", pages are there of {', '.join(known)}" if known else ": run the study first"
        raise InputError(f"{results}: no page of a design {design!r}{hint}")
    for page in pages:
        print(page)
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or sys.platform != "linux":
        webbrowser.open(pages[0].resolve().as_uri())
    return 0


if __name__ == "__main__":
    sys.exit(main())
