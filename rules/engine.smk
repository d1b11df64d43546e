# The only file that knows private names of Snakemake. Without one a run goes on and says so.

import inspect
import logging
from subprocess import CalledProcessError

from snakemake import benchmark as benchmarks, script as scripts
from snakemake.exceptions import WorkflowError

from foldshell.engine.few_jobs import look_at_few
from foldshell.engine.job_end import describe_end
from foldshell.engine.name_check import NameCheck

PRIVATE = NameCheck()
SCRIPT_FIELDS = "conda_env container_img env_modules shadow_dir rulename wildcards log bench_record"
RECORD_FIELDS = "running_time cpu_time cpu_usage max_rss data_collected"
KNOWN = PRIVATE.has(workflow, "workflow", "main_snakefile")
MAIN_SNAKEFILE = workflow.main_snakefile if KNOWN else f"{workflow.basedir}/Snakefile"


def terminal_handler():
    """Return the handler by which Snakemake writes to a terminal, None where lines are due."""
    known = PRIVATE.has(logging._handlers, "logging", "DefaultStreamHandler")
    handler = logging._handlers.get("DefaultStreamHandler")
    asked = setting_of("output_settings", "verbose") or setting_of("output_settings", "quiet")
    return handler if known and handler.stream.isatty() and not asked else None


def setting_of(group, name):
    """Return a setting of this run, an empty list where Snakemake has none of that name."""
    settings = getattr(workflow, group, None)
    return getattr(settings, name) if PRIVATE.has(settings, group, name) else []


def is_target(*names):
    """Tell whether one of the rules is asked for by name on the command line."""
    return bool(set(names) & set(map(str, setting_of("dag_settings", "targets"))))


def runs_here():
    """Tell whether jobs run on this machine; at first only by what clusters have, numbers of jobs."""
    known = PRIVATE.has(workflow, "workflow", "executor_plugin local_exec")
    elsewhere = bool(setting_of("resource_settings", "nodes"))
    return workflow.local_exec if known and workflow.executor_plugin else not elsewhere


def is_job():
    """Tell whether this process runs jobs that another Snakemake has started."""
    return PRIVATE.has(workflow, "workflow", "is_main_process") and not workflow.is_main_process


def run_anew(job, fname, edit):
    """Start Python anew for a script, which prints to its log and to the terminal."""
    execute, log = job._execute_cmd, str(job.log[0]) if job.log and not edit else os.devnull
    job._execute_cmd = lambda command, **fields: execute(
        f"( {command} ) 2>&1 | tee {{log:q}} >&2", log=log, **fields
    )
    START_PYTHON(job, fname, edit)


def run_in_fork(job, fname):
    """Run a script in a fork, if it can be, and return how that ended: None if it cannot."""
    server = find_server()
    if job.conda_env or job.container_img or job.env_modules or job.shadow_dir or not server:
        return None
    log, pool = str(job.log[0]) if job.log else "", POOLS.get(job.rulename, "")
    if not (end := server.run(fname, pool, job.wildcards.get("design", ""), log)):
        return None
    show_job(log, bool(end.code))
    if job.bench_record:
        vars(job.bench_record).update(zip(RECORD_FIELDS.split(), end.describe()))
    return end.code


def execute_script(self, fname, edit=False):
    """Run a rule's script: in a fork, or as Snakemake would."""
    try:
        with stored_beside(self):
            code = None if edit else run_in_fork(self, fname)
            if code is None:
                return run_anew(self, fname, edit)
            if code:
                raise CalledProcessError(code, f"{sys.executable} {fname}")
    except CalledProcessError as error:
        sentence = describe_end(self.rulename, dict(self.wildcards.items()), error.returncode)
        raise WorkflowError(sentence) if sentence else error


SCRIPT = getattr(scripts, "PythonScript", object)
RECORD = getattr(benchmarks, "BenchmarkRecord", object)
START_PYTHON = getattr(SCRIPT, "execute_script", None)
KNOWN = PRIVATE.has(SCRIPT, "PythonScript", "execute_script _execute_cmd")
KNOWN &= PRIVATE.has(inspect.signature(SCRIPT.__init__).parameters, "PythonScript", SCRIPT_FIELDS)
if PRIVATE.has(RECORD(), "BenchmarkRecord", RECORD_FIELDS) and KNOWN:
    SCRIPT.execute_script = execute_script


def mend_scheduler(dag, scheduler):
    """Leave out what takes Snakemake long and leads to nothing."""
    known = PRIVATE.has(scheduler, "scheduler", "open_jobs remaining_jobs")
    if known and setting_of("scheduling_settings", "scheduler") == "greedy":
        look_at_few(scheduler, "open_jobs", "remaining_jobs", rank_of, count_few())
    # The limit of 100 starts a second takes half a core after some hundred jobs.
    if ok := PRIVATE.has(scheduler, "scheduler", "job_rate_limiter global_resources finished_jobs"):
        scheduler.job_rate_limiter = None
        for known in (scheduler.global_resources, scheduler.resources) * bool(MEMORY[0]):
            known.setdefault("mem_mb", MEMORY[0])
    # Jobs that are up to date at the start stay so: to ask them anew takes longer than a job.
    if PRIVATE.has(dag, "dag", "_finished _needrun _len") and ok:
        current = {job for job in dag.jobs if not dag.needrun(job)}
        dag._finished.update(current)
        scheduler.finished_jobs += len(current)
        dag._len = len(dag._finished | dag._needrun)


onstart:
    begin_run()
    mend_scheduler(workflow.dag, workflow.scheduler)
    start_server(MODULES)
    sys.stderr.write(PRIVATE.describe())
