"""A folder for a study of one's own."""

import re
import shutil
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.package_data import is_installed, workflow_folder

TAG = "mine"
DESIGNS = f"""\
# One row per design, with one tab between two cells. Columns that are left out, such as pattern
# or fold_mode, take the values of the group defaults: of config.yaml; see config/README.md.
design\tsurface\tspan_m\theight_m\tzigzag\tstrip\tsupport\ttags
first-dome\tparaboloid\t8\t2\t9\t8\tall\t{TAG}
"""
SNAKEFILE = """\
# The workflow of foldshell; designs and settings of this study are in config/.
{imports}

include: {place}


rule study:
    input:
        rules.all.input,
"""
README = """\
# A study of folded shells

- `config/designs.tsv` holds the designs, one row per design; `config/config.yaml` all settings, at
  their defaults; `config/README.md` says what each one means.
- `foldshell run` makes the study (the same is `snakemake --cores 2`), `foldshell progress` says how
  far it is, `foldshell verify` whether the results are still what was made, `foldshell look
  first-dome` opens the page of a design.
- Results are in `results/`. Start again whenever you like: only what a change concerns is made
  anew.
"""


COPIED = (
    "config/config.yaml",
    "config/README.md",
    "config/loads.tsv",
    "profiles/default/config.yaml",
)
"""Files of the workflow that a new study begins with."""


def make_study_folder(folder: str | Path) -> Path:
    """Write a table, a config, a README and a Snakefile that includes the workflow's own.

    Raises `InputError` for a folder that holds something already.
    """
    folder = Path(folder)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(f"{folder}: is there already: a new or an empty folder is allowed")
    source = workflow_folder()
    for name in COPIED:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / name, folder / name)
    config = folder / "config/config.yaml"
    text = re.sub(r"(?m)^study: .*$", f"study: {TAG}", config.read_text(encoding="utf-8"))
    config.write_text(text, encoding="utf-8")
    (folder / "config/designs.tsv").write_text(DESIGNS, encoding="utf-8")
    (folder / "README.md").write_text(README, encoding="utf-8")
    (folder / "Snakefile").write_text(write_snakefile(), encoding="utf-8")
    return folder


def write_snakefile() -> str:
    """Return the text of a Snakefile: it asks an installed library where the workflow is, and names
    that of a checkout."""
    if is_installed():
        return SNAKEFILE.format(imports="from foldshell import snakefile\n", place="snakefile()")
    return SNAKEFILE.format(imports="", place=repr(str(workflow_folder() / "Snakefile")))
