"""Everything that is checked before the first job: settings files, settings, designs."""

import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.extent import measure_extent
from foldshell.files.meshes.surface import read_surface
from foldshell.settings.check import Reader, parse_group
from foldshell.settings.config_file import read_config
from foldshell.settings.design import NONE, SURFACES, Design
from foldshell.settings.designs import check_defaults, read_designs
from foldshell.settings.load_sets import check_loads, find_load_sets, list_cases, note_idle_loads
from foldshell.settings.make import make_settings
from foldshell.settings.own import add_own
from foldshell.settings.study import LOAD_TABLE, Settings


def _print_note(text: str) -> None:
    sys.stderr.write(text + "\n")


def load_study(
    config: Mapping[str, object],
    files: Iterable[str | Path] = (),
    say: Callable[[str], None] = _print_note,
) -> tuple[Settings, list[Design]]:
    """Return the typed settings and the designs of a study.

    `files` are read strictly for what Snakemake's own YAML reading lets through (duplicate keys,
    octal numbers, `no` for False) and checked alone, so that the message names the file; `config`
    is what Snakemake merged from them and `--config`, where all is text at first. `say` is told
    each old word in a file once, with the new one, and what of a surface file was left out. Raises
    `InputError`.
    """
    source, notes = "configuration", []
    cases = list_cases(find_load_sets(config.get("load_table", LOAD_TABLE)))
    for file in files:
        found: list[str] = []
        Reader(str(file), notes=found, cases=cases).read_group(Settings, read_config(file))
        notes += [f"{file}: {note}" for note in found]
        source = f"{file} with --config"
    found = []
    settings = make_settings(parse_group(Settings, config), source, found)
    notes += [f"{source}: {note}" for note in found] if not notes else []
    check_defaults(settings, source)
    designs = read_designs(settings.designs, settings, notes)
    settings = add_own(settings, designs, config)
    check_loads(designs, settings, str(settings.designs), source)
    notes += note_idle_loads(settings, designs, source)
    designs = measure_surface_files(designs, str(settings.designs), notes)
    designs = measure_folded_files(designs, str(settings.designs))
    for note in dict.fromkeys(notes):
        say(note)
    return settings, designs


def measure_surface_files(designs: Iterable[Design], source: str, notes: list[str]) -> list[Design]:
    """Return the designs, those on a mesh file with the height that the file has, m.

    `notes` gathers what of a file was left out. Raises `InputError` for a mesh file that cannot be
    the target of its design. Each file is read once for each span, whatever the number of designs.
    """
    heights: dict[tuple, float] = {}
    found = []
    for design in designs:
        key = design.surface, design.span, design.file_unit, design.sides
        if design.surface not in (*SURFACES, NONE) and key not in heights:
            try:
                surface = read_surface(*key)
            except InputError as error:
                raise InputError(f"{source}: design {design.name!r}: surface: {error}") from None
            heights[key] = float(f"{np.ptp(surface.vertices[:, 2]):.12g}")
            notes += [f"{design.surface}: {note}" for note in surface.notes]
        found.append(replace(design, height=heights.get(key, design.height)))
    return found


def measure_folded_files(designs: Iterable[Design], source: str) -> list[Design]:
    """Return the designs, those of a folded sheet with span and height of the file where no cell
    gives them, m: the shorter side of its plan and its rise.

    Raises `InputError` for a file that cannot be read.
    """
    found = []
    for design in designs:
        if design.folded != NONE and not (design.span and design.height):
            try:
                size = measure_extent(design.folded, design.file_unit)
            except InputError as error:
                raise InputError(f"{source}: design {design.name!r}: folded: {error}") from None
            span, height = (float(f"{value:.12g}") for value in (size[:2].min(), size[2]))
            design = replace(design, span=design.span or span, height=design.height or height)
        found.append(design)
    return found
