"""Folded shells, from crease pattern to sized and cross-checked structure; one stage a file in rules/.

`snakemake --cores 2` runs the study, `... demo` one small design, `... tag_<tag>` a part of the table.
"""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(str(workflow.current_basedir)).resolve() / "scripts"))

from foldshell.settings.config_file import read_config
from foldshell.engine.environment import ONE_THREAD, prepare_environment
from foldshell.engine.plain_path import find_plain_path
from foldshell.engine.versions import check_snakemake
from foldshell.files.errors import user_errors
from foldshell.settings.load_study import load_study
from foldshell.settings.places import STUDIES, check_results, choose_results

prepare_environment(os.environ)
HOME = find_plain_path(str(workflow.current_basedir))
RULES = f"{HOME}/rules"

# True where another workflow has this one as a module, with a configuration of its own.
IS_MODULE = Path(str(workflow.basedir)).resolve() != Path(str(HOME)).resolve()

with user_errors():
    check_snakemake()
    if not IS_MODULE:
        read_config("config/config.yaml")


configfile: "config/config.yaml"


with user_errors():
    SETTINGS, DESIGNS = load_study(config, () if IS_MODULE else workflow.configfiles)
    RESULTS = choose_results(SETTINGS)
    check_results(RESULTS, SETTINGS.designs)

STUDY = f"{RESULTS}/{STUDIES}/{SETTINGS.study}"


wildcard_constraints:
    design=r"[a-z0-9][a-z0-9_-]{0,63}",
    iteration=r"\d\d",
    tag=r"[a-z0-9][a-z0-9_-]{0,63}",


include: f"{RULES}/common.smk"


rule all:
    default_target: True
    input:
        lambda wildcards: study_files(SETTINGS.study),
        f"{STUDY}/report.html",
        f"{STUDY}/manifest.json",
        f"{STUDY}/timings.csv",


STAGES = ["pattern", "fold", "shell", "ways", "crosscheck", "checks", "study", "deliver"]
for STAGE in [*STAGES, "manifest", "figures", "report", "sheets", "archive", "export", "run"]:

    include: f"{RULES}/{STAGE}.smk"


include: f"{RULES}/{'no_exploration' if SETTINGS.exploration == 'none' else 'explore'}.smk"
include: f"{RULES}/fold_answer.smk"
include: f"{RULES}/one_process.smk"


for TAG in sorted({tag for design in DESIGNS for tag in design.tags}):

    rule:
        name:
            "demo" if TAG == "demo" else f"tag_{TAG}"
        input:
            lambda wildcards, tag=TAG: study_files(tag),
