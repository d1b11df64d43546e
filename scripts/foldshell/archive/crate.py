"""The RO-Crate of a study: files, workflow, one action for each job and for each edit by a person.

Profiles: RO-Crate 1.1, Workflow RO-Crate 1.0, Process, Workflow and Provenance Run Crate 0.5
(Leo et al. 2024, Recording provenance of workflow runs with RO-Crate, PLoS ONE 19:e0309210).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rocrate.model.contextentity import ContextEntity
from rocrate.model.entity import Entity
from rocrate.rocrate import ROCrate

from foldshell.archive.edits import Edit
from foldshell.files.job_record import JobRecord

BASE = "https://w3id.org/ro/wfrun"
PROFILES = {
    f"{BASE}/process/0.5": "Process Run Crate",
    f"{BASE}/workflow/0.5": "Workflow Run Crate",
    f"{BASE}/provenance/0.5": "Provenance Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
LICENCE = "https://spdx.org/licenses/MIT"
MEDIA = {
    ".json": "application/json", ".csv": "text/csv", ".tsv": "text/tab-separated-values",
    ".xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    ".png": "image/png", ".svg": "image/svg+xml", ".html": "text/html", ".md": "text/markdown",
    ".fold": "application/json", ".dxf": "image/vnd.dxf", ".vtu": "application/xml",
    ".npz": "application/zip", ".yaml": "application/yaml", ".pdf": "application/pdf",
}  # fmt: skip


@dataclass(frozen=True)
class CrateContent:
    """What the metadata says: title, date (ISO), commit, version of Snakemake, places of all files
    with size (bytes), records of jobs and edits by the folder of their results."""

    title: str
    description: str
    date: str
    commit: str
    snakemake: str
    files: Mapping[str, int]
    records: Mapping[str, list[JobRecord]] = field(default_factory=dict)
    edits: Mapping[str, list[Edit]] = field(default_factory=dict)


def make_metadata(content: CrateContent) -> dict:
    """Return the contents of ro-crate-metadata.json."""
    crate = ROCrate(version="1.1")
    crate.name, crate.description = content.title, content.description
    root = crate.root_dataset
    root["datePublished"] = content.date
    root["license"] = _add(crate, LICENCE, "CreativeWork", name="MIT License", identifier=LICENCE)
    root["conformsTo"] = [
        _add(crate, url, "CreativeWork", name=name, version=url.rpartition("/")[2])
        for url, name in PROFILES.items()
    ]
    kinds = _kinds(content)
    files = {
        place: _add_file(crate, place, size, kinds.get(place, ["File"]))
        for place, size in content.files.items()
    }
    workflow = _add_workflow(crate, content, files)
    root["mainEntity"] = workflow
    steps = _add_steps(crate, workflow, content, files)
    actions = [
        _add_job(crate, home, record, steps, files)
        for home, records in content.records.items()
        for record in records
    ]
    edits = [
        _add_edit(crate, home, edit, files)
        for home, found in content.edits.items()
        for edit in found
    ]
    run = _add_run(crate, content, workflow, files)
    _add_engine(crate, content, run, actions)
    root["mentions"] = [run, *(action for action, _ in actions), *edits]
    return crate.metadata.generate()


def _add(crate: ROCrate, key: str, kind: str | list[str], **values: object) -> Entity:
    return crate.add(ContextEntity(crate, key, properties={"@type": kind, **values}))


def _kinds(content: CrateContent) -> dict[str, list[str]]:
    """Return the types of the files that are more than files: the workflow and its tools."""
    code = ["File", "SoftwareSourceCode"]
    rules = {record.rule for records in content.records.values() for record in records}
    tools = {f"code/scripts/{rule}.py": [*code, "SoftwareApplication"] for rule in rules}
    return {**tools, "code/Snakefile": [*code, "ComputationalWorkflow", "HowTo"]}


def _add_file(crate: ROCrate, place: str, size: int, kind: list[str]) -> Entity:
    values = {"@type": kind, "name": Path(place).name, "contentSize": str(size)}
    media = MEDIA.get(Path(place).suffix)
    return crate.add_file(dest_path=place, properties=values | _some("encodingFormat", media))


def _some(key: str, value: object) -> dict[str, object]:
    return {key: value} if value else {}


def _add_workflow(crate: ROCrate, content: CrateContent, files: Mapping[str, Entity]) -> Entity:
    language = _add(
        crate, "https://w3id.org/workflowhub/workflow-ro-crate#snakemake", "ComputerLanguage",
        name="Snakemake", alternateName="Snakemake", identifier={"@id": "https://doi.org/10.1093/bioinformatics/bts480"},
        url={"@id": "https://snakemake.readthedocs.io"}, version=content.snakemake,
    )  # fmt: skip
    workflow = files["code/Snakefile"]
    workflow["name"] = "foldshell"
    workflow["version"] = content.commit
    workflow["programmingLanguage"] = language
    workflow["input"] = [
        _add(crate, f"#parameter-{name}", "FormalParameter", name=name, additionalType="File",
             valueRequired=True, conformsTo={"@id": FORMAL})
        for name in ("settings", "designs")
    ]  # fmt: skip
    workflow["output"] = [
        _add(crate, "#parameter-summary", "FormalParameter", name="summary", additionalType="File",
             conformsTo={"@id": FORMAL})
    ]  # fmt: skip
    return workflow


FORMAL = "https://bioschemas.org/profiles/FormalParameter/1.0-RELEASE"


def _add_steps(
    crate: ROCrate, workflow: Entity, content: CrateContent, files: Mapping[str, Entity]
) -> dict[str, tuple[Entity, Entity]]:
    """Add a tool and a step of the workflow for every rule that ran; return both by rule."""
    rules = sorted({r.rule for records in content.records.values() for r in records})
    steps = {}
    for position, rule in enumerate(rules):
        tool = files.get(f"code/scripts/{rule}.py")
        if tool is None:
            tool = _add(crate, f"#tool-{rule}", "SoftwareApplication", name=rule)
        step = _add(crate, f"#step-{rule}", "HowToStep", name=rule, position=str(position))
        step["workExample"] = tool
        steps[rule] = step, tool
    workflow["step"] = [step for step, _ in steps.values()]
    workflow["hasPart"] = [tool for _, tool in steps.values()]
    return steps


def _add_job(
    crate: ROCrate,
    home: str,
    record: JobRecord,
    steps: Mapping[str, tuple[Entity, Entity]],
    files: Mapping[str, Entity],
) -> tuple[Entity, Entity]:
    """Add the action of a job; return it with the step that it carried out."""
    step, tool = steps[record.rule]
    action = _add(
        crate, f"#job-{home}-{record.name}", "CreateAction", name=f"{home}: {record.name}",
        actionStatus="http://schema.org/CompletedActionStatus",
    )  # fmt: skip
    action["instrument"] = tool
    inputs = [f"results/{home}/{path}" for path in record.inputs]
    action["object"] = _known(files, [*inputs, *record.external])
    action["result"] = _known(files, [f"results/{home}/{path}" for path in record.outputs])
    return action, step


def _known(files: Mapping[str, Entity], places: Iterable[str]) -> list[Entity]:
    return [files[place] for place in places if place in files]


def _add_edit(crate: ROCrate, home: str, edit: Edit, files: Mapping[str, Entity]) -> Entity:
    """Add what a person did to a workbook: from which bytes to which, and in which cells."""
    program = _add(crate, "#spreadsheet", "SoftwareApplication", name="a spreadsheet program")
    person = _add(crate, "#person", "Person", name="a person, not named")
    place = f"results/{home}/{edit.file or edit.path}"
    action = _add(
        crate, f"#edit-{home}-{edit.path}", "UpdateAction",
        name=f"{home}: {edit.path} edited by hand, read by {edit.reader}",
        description=edit.describe(), actionStatus="http://schema.org/CompletedActionStatus",
    )  # fmt: skip
    action["instrument"], action["agent"] = program, person
    before = _add(
        crate, f"#before-{home}-{edit.path}", "CreativeWork",
        name=f"{edit.path} as it was written", identifier=f"sha256:{edit.written_sha256}",
    )  # fmt: skip
    action["object"], action["result"] = [before], _known(files, [place])
    if edit.cells:
        action["additionalProperty"] = [
            _add(
                crate, f"#cell-{home}-{edit.path}-{cell.panel}", "PropertyValue",
                name=cell.place, value=cell.after, unitText="m",
                description=f"thickness of panel {cell.panel}, {cell.before!r} m before",
            )
            for cell in edit.cells
        ]  # fmt: skip
    return action


def _add_run(
    crate: ROCrate, content: CrateContent, workflow: Entity, files: Mapping[str, Entity]
) -> Entity:
    """Add the run of the whole workflow: from settings and table to the summary."""
    run = _add(
        crate, "#run", "CreateAction", name=content.title, endTime=content.date,
        actionStatus="http://schema.org/CompletedActionStatus",
    )  # fmt: skip
    run["instrument"] = workflow
    given = [place for place in files if place.startswith("config/")]
    run["object"] = _known(files, given)
    run["result"] = [entity for place, entity in files.items() if place.endswith("/summary.csv")]
    for place, name in (("config/config.yaml", "settings"), ("config/designs.tsv", "designs")):
        if place in files:
            files[place]["exampleOfWork"] = {"@id": f"#parameter-{name}"}
    for entity in run["result"]:
        entity["exampleOfWork"] = {"@id": "#parameter-summary"}
    return run


def _add_engine(
    crate: ROCrate, content: CrateContent, run: Entity, actions: Iterable[tuple[Entity, Entity]]
) -> None:
    """Add Snakemake, which organised the jobs, and its control of each."""
    engine = _add(
        crate, "#engine", "SoftwareApplication", name="Snakemake",
        softwareVersion=content.snakemake, url="https://snakemake.readthedocs.io",
    )  # fmt: skip
    controls = []
    for action, step in actions:
        control = _add(crate, f"#control-{action.id[1:]}", "ControlAction",
                       name=f"run of {action['name']}")  # fmt: skip
        control["instrument"], control["object"] = step, action
        controls.append(control)
    organize = _add(crate, "#organize", "OrganizeAction", name="Snakemake organises the jobs")
    organize["instrument"], organize["object"], organize["result"] = engine, controls, run
