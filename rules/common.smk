# What the rules of all stages share: designs by name, parameters of a stage, library files.

import functools
import json
import math

from snakemake.exceptions import IncompleteCheckpointException

from foldshell.study.designs import SURFACES, select_designs
from foldshell.study.imports import write_library_list
from foldshell.study.stages import choose_subdivisions, settings_hash, stage_parameters

BY_NAME = {design.name: design for design in DESIGNS}
SECTOR_ANGLE_DEG = round(math.degrees(SETTINGS.pattern.sector_angle), 10)
PICTURES = ["thickness", "classes", "utilization", "displacement", "planarity"]
PICTURES += ["strain", "force_lines", "isolines", "buckling"]
LOOP = f"{RESULTS}/{{design}}/sizing"
STEP = f"{LOOP}/{{iteration}}"
# Relative in the project's own folder, so that a moved project does not run anew.
SCRIPTS = "scripts" if Path.cwd() == Path(workflow.basedir) else f"{workflow.basedir}/scripts"


def library(script):
    """Return the list of the library files that a rule's script imports, as an input of it."""
    return write_library_list(f"{SCRIPTS}/{script}.py", SCRIPTS, ".snakemake/library")


def assets(*names):
    """Return files of the pages, as inputs of a rule: they are read, not imported."""
    return [f"{SCRIPTS}/foldshell/report/{name}" for name in names]


def of_design(*columns):
    """Return a function of the wildcards that gives columns of designs.tsv as parameters."""
    return {
        column: (lambda wildcards, column=column: BY_NAME[wildcards.design].to_row()[column])
        for column in columns
    }


def edge_beam(wildcards):
    """Return depth and thickness (m) of a design's edge beam, 0 for none."""
    design = BY_NAME[wildcards.design]
    return [design.edge_beam_depth, design.edge_beam_thickness]


def of_stage(stage):
    """Return a function of the wildcards that gives the plain settings of a stage."""
    known = functools.cache(lambda name: stage_parameters(SETTINGS, stage, BY_NAME[name]))
    return lambda wildcards: known(wildcards.design)


def surface_file(wildcards):
    """Return the mesh file that is a design's target surface, if it is one."""
    surface = BY_NAME[wildcards.design].surface
    return [] if surface in SURFACES else [surface]


def before(name):
    """Return a function of the wildcards: a file of the iteration before, none for the first."""

    def find(wildcards):
        number = int(wildcards.iteration) - 1
        folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
        return [f"{folder}/{file}" for file in name] if number >= 0 else []

    return find


def memory_before_last(wildcards):
    """Return what the sizing rule remembers of the step before the one it takes now."""
    number = int(wildcards.iteration) - 1
    folder = f"{RESULTS}/{wildcards.design}/sizing/{number:02d}"
    return [f"{folder}/memory.npz"] if number > 0 else []


def iterations(wildcards):
    """Return every analysis.json up to the first whose verdict ends the loop.

    A file that cannot be read ends the list; `size` says what is wrong with it. An analysis that
    is still to be made is returned as what it is waited for. Leaving that to Snakemake, which
    does the same with the exception, makes it look at all loops twice after each analysis.
    """
    files = []
    for number in range(100):
        try:
            step = checkpoints.analyse.get(design=wildcards.design, iteration=f"{number:02d}")
        except IncompleteCheckpointException as missing:
            return [missing.targetfile]
        files.append(step.output.json)
        try:
            going_on = json.loads(Path(files[-1]).read_text())["verdict"] == "continue"
        except (OSError, ValueError, KeyError, TypeError):
            going_on = False
        if not going_on:
            break
    return files


def subdivisions(wildcards):
    """Return the subdivisions of a facet edge."""
    return choose_subdivisions(SETTINGS, BY_NAME[wildcards.design])


def settings_hash_of(stage):
    """Return a function of the wildcards that gives the hash of a stage's settings."""
    return lambda wildcards: settings_hash(of_stage(stage)(wildcards))


def names_of_tag(tag):
    """Return the names of the designs with a tag."""
    with user_errors():
        return [design.name for design in select_designs(DESIGNS, tag, SETTINGS.designs)]


def study_files(tag):
    """Return what is made of every design with a tag."""
    files = ["design.xlsx", "design.vtu", "crosscheck/comparison.json", "page.html"]
    files += [f"figures/{name}.png" for name in PICTURES]
    true_pattern = [f"pattern/true_pattern.{kind}" for kind in ("fold", "dxf", "svg")]
    return [
        f"{RESULTS}/{name}/{file}"
        for name in names_of_tag(tag)
        for file in files + true_pattern * (BY_NAME[name].fold_mode in ("exact", "rigid"))
    ]
