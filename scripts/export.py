"""Rule export: one format of a design for other programs, and a record of what was written."""

import time
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

from foldshell.exchange.formats import FORMATS
from foldshell.exchange.options import PACKAGES, ExportOptions, load_library
from foldshell.exchange.read_model import read_export_model
from foldshell.files.errors import user_errors
from foldshell.files.whole import hash_file, write_json


def main(
    inputs: Mapping[str, str | Path],
    paths: Sequence[str | Path],
    record_path: str | Path,
    *,
    format_name: str,
    design: Mapping[str, Any],
    settings: Mapping[str, Any],
) -> None:
    """Write the files of a format, in the order of its entry in `FORMATS`, then the record.

    `inputs` by role: mesh, folded, final, report, classes, pattern, design_vtu; `settings` are
    those of stages crosscheck, drawings and exports.
    """
    began, form = time.process_time(), FORMATS[format_name]
    for name in form.libraries:
        load_library(name)
    model = read_export_model(inputs, design, settings)
    options = ExportOptions(
        **settings["drawings"],
        **{key: value for key, value in settings["exports"].items() if key != "formats"},
        sources={role: Path(inputs[role]) for role in ("pattern", "design_vtu")},
    )
    form.write(model, tuple(map(Path, paths)), options)
    files = {Path(path).name: {"sha256": hash_file(path)} for path in paths}
    if form.hash_content:
        files[Path(paths[0]).name]["content_sha256"] = form.hash_content(Path(paths[0]))
    versions = {PACKAGES[name]: version(PACKAGES[name]) for name in form.libraries}
    facts = {"format": format_name, "design": model.design, "holds": form.holds}
    facts |= {"opens": form.opens, "files": files, "libraries": versions}
    write_json(record_path, facts | {"cpu_seconds": time.process_time() - began})


if "snakemake" in globals():
    with user_errors():
        files = dict(snakemake.output.items())  # noqa: F821
        record = files.pop("record")
        main(
            snakemake.input,  # noqa: F821
            list(files.values()),
            record,
            **snakemake.params,  # noqa: F821
        )
