"""The data descriptor of an archive: what is what, units, licence, how to check and rerun."""

from foldshell.archive.content import Study
from foldshell.records.catalogue import FILES
from foldshell.settings.archive import Archive

PAGE = """# Study {tag}

{count} designs of folded shell structures: crease patterns, folded sheets, thicknesses found by a
loop of analyses, the final state checked by a second finite-element code.

| place | what it holds |
|---|---|
| `code/` | source of the workflow, commit {commit}, with the lock file of all packages |
| `config/` | the settings of this run (`config.yaml`) and its tables |
| `given/` | files that designs name, such as target surfaces, where the commit does not hold them |
| `results/<design>/` | files of a design; `manifest.json` has their hashes, `jobs/` who made them |
| `results/studies/{tag}/` | what is said over all designs |
| `results/schemas/` | JSON Schemas of the result files, each key with unit and meaning |
| `machine.json` | processor, memory, system and packages of the machine that made the results |
| `ro-crate-metadata.json` | provenance: each job, and each edit of a workbook by a person |
{difference}
Result {result}: the SHA-256 of all that decided it. {fields}

Lengths are in m, forces in kN, stresses in kPa where a header does not say otherwise; z is up,
tension is positive, vertical displacement positive downward. Licence of data and code: MIT, see
`code/LICENSE`; cite as in `code/CITATION.cff`.

## Check it

`python code/scripts/verify.py ARCHIVE` with the packages of the lock file: hashes, schemas, sums
that must close. With `--recompute DESIGN` one design is computed anew and compared digit by digit.

## Run it again

`python code/scripts/verify.py ARCHIVE --rerun FOLDER` runs the whole study in a new folder, lays
in the workbooks that a person had edited, and compares its summary with the archived one. By hand,
in this folder, from nothing:

```
cd code
cp -r ../given/. . 2>/dev/null
python3.11 -m venv .venv && .venv/bin/pip install --require-hashes -r envs/requirements.lock
.venv/bin/snakemake --cores 2 --configfile ../config/config.yaml \\
  --config designs=../config/{table} results=results
```

## Files

| file | what it holds |
|---|---|
{files}
"""


def describe_archive(
    study: Study, commit: str, result_sha256: str, options: Archive, table: str
) -> str:
    """Return README.md of an archive; `table` names the table of designs in `config/`."""
    rows = "\n".join(f"| `results/{file.path}` | {file.meaning} |" for file in FILES)
    patch = "| `difference.patch` | how the files differed from that commit |\n"
    return PAGE.format(
        tag=study.tag,
        count=len(study.designs),
        commit=commit,
        result=result_sha256,
        table=table,
        files=rows,
        difference=patch if options.dirty == "diff" else "",
        fields="Fields of all iterations are in it."
        if options.fields
        else "Fields (.npz, .vtu) are left out but for shape, mesh and thicknesses.",
    )
