"""Rule export: one format of a design for other programs, and a record of what was written."""

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.exchange.formats import FORMATS
from foldshell.exchange.options import PACKAGES, load_library, make_options
from foldshell.exchange.read_model import read_export_model
from foldshell.files.whole import hash_file, write_json
from foldshell.settings.analysed import LOADED
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.design import Row
from foldshell.settings.exports import Drawings, Exports
from foldshell.settings.stage import Plain, read_stage


def main(
    inputs: Mapping[str, str | Path],
    record_path: str | Path,
    paths: Sequence[str | Path],
    *,
    format_name: str,
    design: Row,
    settings: Plain,
) -> None:
    """Write the files of a format, in the order of its entry in `FORMATS`, then the record.

    `inputs` by role: mesh, folded, final, report, classes, pattern, design_vtu; `settings` are
    those of stages crosscheck, drawings and exports.
    """
    form, given = FORMATS[format_name], read_stage(settings, *LOADED, Crosscheck, Drawings, Exports)
    for name in form.libraries:
        load_library(name)
    model = read_export_model(inputs, design, given)
    form.write(model, tuple(map(Path, paths)), make_options(given.drawings, given.exports, inputs))
    files = {Path(path).name: {"sha256": hash_file(path)} for path in paths}
    if form.hash_content:
        files[Path(paths[0]).name]["content_sha256"] = form.hash_content(Path(paths[0]))
    versions = {PACKAGES[name]: version(PACKAGES[name]) for name in form.libraries}
    facts = {"format": format_name, "design": model.design, "holds": form.holds}
    write_json(record_path, facts | {"opens": form.opens, "files": files, "libraries": versions})


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        record, *files = snakemake.output  # noqa: F821
        main(snakemake.input, record, files, **snakemake.params)  # noqa: F821
