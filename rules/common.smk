# What the rules of all stages share: designs by name, parameters of a stage, library files.

import functools
import math

from foldshell.settings.designs import select_designs
from foldshell.engine.imports import write_content_list
from foldshell.files.package_data import library_folder
from foldshell.settings.stages import choose_subdivisions, hash_decisions, stage_parameters

BY_NAME = {design.name: design for design in DESIGNS}
SECTOR_ANGLE_DEG = round(math.degrees(SETTINGS.pattern.sector_angle), 10)
# Priorities. Before any analysis: a design that cannot be folded is seen at once, and Snakemake's
# greedy scheduler, which takes large inputs first, finds all first analyses ready and leaves no long
# loop for the end. After the last one: Snakemake looks at all jobs that are left after each
# analysis, so few of them should be.
BEFORE_LOOP, AFTER_LOOP = 1, 2
PICTURES = ["thickness", "classes", "utilization", "displacement", "planarity"]
PICTURES += ["strain", "principal_stress_lines", "isolines", "buckling", "loads"]
LOOP = f"{RESULTS}/{{design}}/sizing"
STEP = f"{LOOP}/{{iteration}}"
# Relative in the project's own folder, so that a moved project does not run anew.
SCRIPTS = "scripts" if Path.cwd() == HOME else f"{HOME}/scripts"
PAGES = "scripts/foldshell/report" if Path.cwd() == HOME else f"{library_folder()}/foldshell/report"


def of_design(*columns):
    """Return a function of the wildcards that gives columns of designs.tsv as parameters."""
    return {
        column: (lambda wildcards, column=column: BY_NAME[wildcards.design].to_row()[column])
        for column in columns
    }


def sides(wildcards):
    """Return the sides (m) of a design's rectangular plan along x and y, none of a square."""
    design = BY_NAME[wildcards.design]
    return list(design.sides) if design.span_x else []


def outline(wildcards):
    """Return the columns outline and openings of a design."""
    design = BY_NAME[wildcards.design]
    return [design.outline, design.openings]


def holding(wildcards):
    """Return the supports of a design: a word, or the rows of the set that it names."""
    return BY_NAME[wildcards.design].holding


def sector_angle_deg(wildcards):
    """Return a design's sector angle, that of the settings where its row has none."""
    return BY_NAME[wildcards.design].sector_angle_deg or SECTOR_ANGLE_DEG


def edge_beam(wildcards):
    """Return depth and thickness (m) of a design's edge beam, 0 for none."""
    design = BY_NAME[wildcards.design]
    return [design.edge_beam_depth, design.edge_beam_thickness]


def of_stage(stage):
    """Return a function of the wildcards that gives the plain settings of a stage."""
    known = functools.cache(lambda name: stage_parameters(SETTINGS, stage, BY_NAME[name]))
    return lambda wildcards: known(wildcards.design)


def files_of_design(wildcards):
    """Return the files that a design is made of; Snakemake would take a brace in the name of one
    for a wildcard."""
    files = BY_NAME[wildcards.design].files
    return [local(name) for name in files if not set("{}") & set(name)]


def files_content(wildcards):
    """Return a file whose name tells the content of the design's files, as an input beside them:
    the content decides whether a rule runs again, not the date."""
    return CONTENTS.get(wildcards.design, [])


def panels_of_file(wildcards):
    """Return the folded sheet of a design whose panels are no grid, which lists them."""
    design = BY_NAME[wildcards.design]
    return [] if design.on_grid else [f"{RESULTS}/{design.name}/folded/folded.npz"]


def subdivisions(wildcards):
    """Return the subdivisions of a facet edge."""
    return choose_subdivisions(SETTINGS, BY_NAME[wildcards.design])


@functools.cache
def hash_of_design(name):
    """Return the hash of all that decides a design before any thickness is edited."""
    return hash_decisions(SETTINGS, BY_NAME[name])


def decisions(wildcards):
    """Return the same for the design of a job."""
    return hash_of_design(wildcards.design)


def names_of_tag(tag):
    """Return the names of the designs with a tag."""
    with user_errors():
        names = [design.name for design in select_designs(DESIGNS, tag, SETTINGS.designs)]
    return check_memory(names)


include: "loop.smk"
include: "server.smk"
include: "engine.smk"
include: "library.smk"
include: "needs.smk"
include: "storage.smk"
include: "inputs.smk"
include: "study_inputs.smk"
