"""The thickness loop of one design in one job: the same steps, files and records as by rules."""

import runpy
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from foldshell.engine.job import describe_job, find_home, name_job
from foldshell.engine.task import Named, Task
from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER, hash_inputs, read_record, state_of
from foldshell.files.whole import read_json
from foldshell.records.edits import WORKBOOK, keep_edited
from foldshell.settings.field import Plain

ITERATIONS_MAX = 100


@dataclass(frozen=True)
class LoopPlan:
    """The jobs of a loop: design, its folder `sizing`, mesh.npz, by rule the list of its library
    files and its parameters, and folded.npz where panels are no grid."""

    design: str
    folder: str
    mesh: str
    code: Mapping[str, str]
    params: Mapping[str, Plain]
    folded: tuple[str, ...] = ()

    def start(self) -> Task:
        """Return the job that writes the first workbook."""
        files = Named(workbook=self._step(0, WORKBOOK), record=self._step(0, "written.json"))
        return self._task("start", Named(folded=self.folded), files)

    def analyse(self, number: int) -> Task:
        """Return the job of an analysis."""
        inputs = Named(
            mesh=self.mesh,
            workbook=self._step(number, WORKBOOK),
            previous=self._analysed(number - 1),
            folded=self.folded,
        )
        files = Named(
            json=self._step(number, "analysis.json"), arrays=self._step(number, "analysis.npz")
        )
        return self._task("analyse", inputs, files, number)

    def resize(self, number: int) -> Task:
        """Return the job that writes the workbook of an iteration from the analysis before it."""
        memory = [self._step(number - 1, "memory.npz")] if number > 1 else []
        inputs = Named(analysis=self._analysed(number - 1), memory=memory, folded=self.folded)
        files = Named(
            workbook=self._step(number, WORKBOOK),
            memory=self._step(number, "memory.npz"),
            record=self._step(number, "written.json"),
        )
        return self._task("resize", inputs, files, number)

    def group(self, last: int) -> Task:
        """Return the job that groups the thicknesses of the last analysis."""
        inputs = Named(mesh=self.mesh, **self._all_analyses(last))
        files = Named(json=f"{self.folder}/classes.json", arrays=f"{self.folder}/classes.npz")
        return self._task("group", inputs, files)

    def size(self, last: int) -> Task:
        """Return the job that gathers history and final state."""
        inputs = Named(mesh=self.mesh, **self._all_analyses(last), folded=self.folded)
        files = Named(
            final=f"{self.folder}/final.json",
            arrays=f"{self.folder}/final.npz",
            csv=f"{self.folder}/history.csv",
            history=f"{self.folder}/history.xlsx",
            panels=f"{self.folder}/iterations.npz",
        )
        return self._task("size", inputs, files)

    def _all_analyses(self, last: int) -> dict[str, list[str]]:
        numbers = range(last + 1)
        return {
            "analyses": [self._step(number, "analysis.json") for number in numbers],
            "analysis_arrays": [self._step(number, "analysis.npz") for number in numbers],
        }

    def _analysed(self, number: int) -> list[str]:
        kinds = ("json", "npz") if number >= 0 else ()
        return [self._step(number, f"analysis.{kind}") for kind in kinds]

    def _step(self, number: int, name: str) -> str:
        return f"{self.folder}/{number:02d}/{name}"

    def _task(self, rule: str, inputs: Named, files: Named, number: int | None = None) -> Task:
        wildcards = {"design": self.design}
        if number is not None:
            wildcards["iteration"] = f"{number:02d}"
        given = Named(**vars(inputs), library=self.code[rule])
        return Task(rule, Named(**wildcards), given, files, Named(**self.params[rule]))


def run_whole_loop(plan: LoopPlan, scripts: str | Path) -> None:
    """Run every job of the loop that is not done yet, up to the verdict, then gather.

    `scripts` is the folder of the rules' scripts. What an analysis or a workbook was made from is
    compared by content with its record, so that the loop goes on where it was stopped, and anew
    from where a person has edited a workbook.
    """
    make(plan.start(), scripts)
    for number in range(ITERATIONS_MAX):
        analysis = plan.analyse(number)
        make(analysis, scripts)
        if read_json(analysis.output.json)["verdict"] != "continue":
            break
        make(plan.resize(number + 1), scripts)
    make(plan.group(number), scripts)
    make(plan.size(number), scripts)


def make(task: Task, scripts: str | Path) -> None:
    """Run the script of a job as Snakemake would, unless it is done."""
    if is_done(task):
        return
    for path in task.output:
        keep_edited(path)
    runpy.run_path(str(Path(scripts, f"{task.rule}.py")), {"snakemake": task})


def is_done(task: Task) -> bool:
    """Tell whether a job has left its outputs, from what it would be made of now.

    A workbook counts also where a person has edited it: what follows is made of that.
    """
    home = find_home(list(task.output), dict(task.wildcards.items()))
    name = name_job(task.rule, dict(task.wildcards.items()), home)
    try:
        record = read_record(home / FOLDER / f"{name}.json")
    except InputError:
        return False
    if not all(Path(path).is_file() for path in task.output):
        return False
    now = describe_job(task, hash_inputs(task.input))
    made_of = ("params_sha256", "code_sha256", "inputs", "external")
    same = all(getattr(now, key) == getattr(record, key) for key in made_of)
    return same and all(
        path.endswith(WORKBOOK) or state_of(home / path) == state
        for path, state in record.outputs.items()
    )
