"""The frame in which a rule's script runs: errors in one line, and a record of the job."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from foldshell.files.errors import user_errors
from foldshell.files.job_record import JobRecord, hash_inputs, list_outputs, state_of, write_record
from foldshell.files.threads import use_threads
from foldshell.files.whole import SECONDS, hash_data, hash_file, held_back

LISTS = ".snakemake/library/"
"""Where lists of hashes stand that Snakemake takes for inputs."""
STORED = ".snakemake/storage/"
"""Below what Snakemake keeps local copies of a storage."""
GATHERED = ("studies", "explorations")
"""Folders whose folders gather what is about several designs."""
CODE = "library"
"""The name of the input that lists the library files of a rule with their hashes."""


@contextmanager
def run_job(task: Any) -> Iterator[None]:
    """Run the block as the job `task` (the global `snakemake` of a script), then record it.

    Inputs are hashed before the block, outputs after it: what is recorded is what the job read and
    wrote. The first output is what others wait for: it comes into place last, after the record. An
    error that a person can act on becomes one line and leaves no record. Large work in the block
    uses the threads of the job.
    """
    if hasattr(task, "threads"):
        use_threads(task.threads)
    awaited = str(task.output[0])
    with user_errors(), held_back(awaited) as content:
        inputs = hash_inputs(task.input)
        yield
        record = describe_job(task, inputs, {awaited: content()})
        write_record(find_home(list(map(str, task.output)), dict(task.wildcards.items())), record)


def describe_job(
    task: Any, inputs: Mapping[str, str], waiting: Mapping[str, Path] | None = None
) -> JobRecord:
    """Return the record of a job that has ended; `inputs` {path: SHA-256} as it began, `waiting`
    where the content of an output is that is not in its place yet."""
    waiting = waiting or {}
    wildcards = {name: str(value) for name, value in task.wildcards.items()}
    home = find_home(list(map(str, task.output)), wildcards)
    code = str(task.input.get(CODE, ""))
    own, external = {}, {}
    for path, digest in inputs.items():
        if not path.startswith(LISTS):
            inside = Path(path).is_relative_to(home)
            (own if inside else external)[_relative(path, home) if inside else path] = digest
    outputs = {
        _relative(path, home): state_of(waiting.get(str(path), path))
        for path in list_outputs(task.output)
        if Path(path).name != SECONDS
    }
    return JobRecord(
        name=name_job(task.rule, wildcards, home),
        rule=task.rule,
        wildcards=wildcards,
        outputs=outputs,
        inputs=own,
        external={_shorten(path, home): digest for path, digest in external.items()},
        params_sha256=hash_data(_plain({key: value for key, value in task.params.items()}, home)),
        code_sha256=hash_file(code) if code else "",
    )


def name_job(rule: str, wildcards: Mapping[str, str], home: Path) -> str:
    """Return the name of a job within its folder: the rule, and wildcards but the folder's name."""
    more = [value for value in wildcards.values() if value != home.name]
    return "-".join([rule, *more])


def find_home(outputs: list[str], wildcards: Mapping[str, str]) -> Path:
    """Return the folder of the design or study that a job's outputs belong to.

    It is the one with the name of the design; else the one below `studies` or `explorations`; else
    that of the first output.
    """
    first = Path(outputs[0])
    design = wildcards.get("design")
    for folder in first.parents:
        if folder.name == design or folder.parent.name in GATHERED:
            return folder
    return first.parent


def _relative(path: str | Path, home: Path) -> str:
    return Path(path).relative_to(home).as_posix()


def _shorten(path: str, home: Path) -> str:
    """Return a path without what tells of the machine: relative to the project, else its name."""
    known = _placeless(str(Path(_unstored(path, home)).absolute()))
    return Path(path).name if Path(known).is_absolute() else known


def _unstored(path: str, home: Path) -> str:
    """Return the path of a local copy of a storage as it is without one, others as they are."""
    top = home.parent.parent if home.parent.name in GATHERED else home.parent
    if not path.startswith(STORED) or not Path(path).is_relative_to(top):
        return path
    return Path(top.name, Path(path).relative_to(top)).as_posix()


def _placeless(text: str) -> str:
    """Return a path in the folder of the run relative to it, any other text as it is: a study that
    runs in another folder has the same records."""
    here = str(Path.cwd())
    inside = text == here or text.startswith(here + "/")
    return Path(text).relative_to(here).as_posix() if inside else text


def _plain(value: Any, home: Path) -> Any:
    """Return parameters as plain data, to be hashed: named lists of Snakemake become lists."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item, home) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item, home) for item in value]
    if isinstance(value, str):
        return _placeless(_unstored(value, home))
    return value if isinstance(value, int | float | bool | None) else str(value)
