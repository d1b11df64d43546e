"""Folded shells, from crease pattern to sized and cross-checked structure; one stage a file in rules/.

`snakemake --cores 2` runs the study, `... demo` one small design, `... tag_<tag>` a part of the table.
"""

import os
import sys
from pathlib import Path

HOME = Path(str(workflow.current_basedir)).resolve()
sys.path.insert(0, str(HOME / "scripts"))

from foldshell.settings.config_file import read_config
from foldshell.engine.environment import ONE_THREAD, prepare_environment
from foldshell.engine.versions import check_snakemake
from foldshell.files.errors import user_errors
from foldshell.settings.load import load_study
from foldshell.files.edits import keep_all_edited

prepare_environment(os.environ)

with user_errors():
    check_snakemake()
    read_config("config/config.yaml")


configfile: "config/config.yaml"


with user_errors():
    SETTINGS, DESIGNS = load_study(config, workflow.configfiles)


RESULTS = "results"

for path in keep_all_edited(RESULTS):
    print(f"kept a copy of the edited workbook {path}", file=sys.stderr)


wildcard_constraints:
    design=r"[a-z0-9][a-z0-9_-]{0,63}",
    iteration=r"\d\d",
    tag=r"[a-z0-9][a-z0-9_-]{0,63}",


include: "rules/common.smk"


rule all:
    default_target: True
    input:
        study_files(SETTINGS.study),
        f"{RESULTS}/summary.csv",
        f"{RESULTS}/summary.xlsx",
        f"{RESULTS}/report.html",


include: "rules/pattern.smk"
include: "rules/fold.smk"
include: "rules/shell.smk"
include: "rules/sizing.smk"
include: "rules/final.smk"
include: "rules/crosscheck.smk"
include: "rules/study.smk"
include: "rules/deliver.smk"
include: "rules/manifest.smk"
include: "rules/figures.smk"
include: "rules/report.smk"
include: "rules/archive.smk"


for TAG in sorted({tag for design in DESIGNS for tag in design.tags}):

    rule:
        name:
            "demo" if TAG == "demo" else f"tag_{TAG}"
        input:
            study_files(TAG),
            f"{RESULTS}/tags/{TAG}/summary.csv",
            f"{RESULTS}/tags/{TAG}/summary.xlsx",
