# The only file that knows private names of Snakemake, for what its interfaces do not reach. A run goes
# on without a name that is gone and says so in one line; a test fails.

import inspect
import time
from subprocess import CalledProcessError

import snakemake.benchmark
import snakemake.script
from snakemake.exceptions import IncompleteCheckpointException, WorkflowError

from foldshell.engine.fork_client import AVAILABLE, ForkServer, NoForkServer
from foldshell.engine.job_end import describe_end, show_log
from foldshell.engine.name_check import NameCheck
from foldshell.engine.preload import MODULES, POOLS
from foldshell.settings.places import claim_results

SERVERS, PRIVATE = [], NameCheck()  # the fork server, once the first job may start
SCRIPT_FIELDS = "conda_env container_img env_modules shadow_dir rulename wildcards log bench_record"
RECORD_FIELDS = "running_time cpu_time cpu_usage max_rss data_collected"


def is_target(*names):
    """Tell whether one of the rules is asked for by name on the command line."""
    known = PRIVATE.has(workflow.dag_settings, "dag_settings", "targets")
    return known and bool(set(names) & set(map(str, workflow.dag_settings.targets)))


def runs_here():
    """Tell whether jobs run on this machine, and not by a cluster's executor."""
    return not PRIVATE.has(workflow, "workflow", "local_exec") or workflow.local_exec


def main_snakefile():
    """Return the Snakefile that Snakemake was started with."""
    PRIVATE.has(workflow, "workflow", "main_snakefile")
    return getattr(workflow, "main_snakefile", f"{workflow.basedir}/Snakefile")


def find_analysis(**wildcards):
    """Return the analysis.json of an iteration, and whether Snakemake knows that it is made."""
    try:
        return checkpoints.analyse.get(**wildcards).output.json, True
    except IncompleteCheckpointException as missing:
        return str(missing.targetfile), False


def run_anew(script, fname, edit):
    """Start Python anew for a script; what it prints goes to its log and to the terminal."""
    execute = script._execute_cmd
    if script.log and not edit:
        script._execute_cmd = lambda command, **fields: execute(
            f"( {command} ) 2>&1 | tee {{log:q}} >&2", log=str(script.log[0]), **fields
        )
    START_PYTHON(script, fname, edit)


def run_in_fork(script, fname):
    """Run a script in a fork, if it can be, and return how that ended: None if it cannot."""
    elsewhere = script.conda_env or script.container_img or script.env_modules or script.shadow_dir
    if elsewhere or not SERVERS:
        return None
    log = str(script.log[0]) if script.log else ""
    affinity, start = script.wildcards.get("design", ""), time.time()
    try:
        job = SERVERS[0].start(fname, POOLS.get(script.rulename, ""), affinity, log)
    except NoForkServer:
        return None
    end, record = job.wait(), script.bench_record
    show_log(log)
    if record is not None:
        record.running_time, record.cpu_time = time.time() - start, end.cpu_seconds
        record.cpu_usage, record.max_rss = 100 * end.cpu_seconds, end.rss_mb
        record.data_collected = True
    return end.code


def execute_script(self, fname, edit=False):
    """Run a rule's script: in a fork, or as Snakemake would."""
    try:
        code = None if edit else run_in_fork(self, fname)
        if code is None:
            return run_anew(self, fname, edit)
        if code:
            raise CalledProcessError(code, f"{sys.executable} {fname}")
    except CalledProcessError as error:
        if sentence := describe_end(self.rulename, dict(self.wildcards.items()), error.returncode):
            raise WorkflowError(sentence) from None
        raise


SCRIPT = getattr(snakemake.script, "PythonScript", object)
RECORD = getattr(snakemake.benchmark, "BenchmarkRecord", object)
START_PYTHON = getattr(SCRIPT, "execute_script", None)
if (
    PRIVATE.has(SCRIPT, "PythonScript", "execute_script _execute_cmd")
    & PRIVATE.has(inspect.signature(SCRIPT.__init__).parameters, "PythonScript", SCRIPT_FIELDS)
    & PRIVATE.has(RECORD(), "BenchmarkRecord", RECORD_FIELDS)
):
    SCRIPT.execute_script = execute_script


onstart:
    RUN["started"] = True
    claim_results(RESULTS, SETTINGS.designs)
    if runs_here():
        dag, scheduler = workflow.dag, workflow.scheduler
        # The limit of 100 starts a second takes half a core after some hundred jobs.
        if PRIVATE.has(scheduler, "scheduler", "job_rate_limiter"):
            scheduler.job_rate_limiter = None
        # Jobs that are up to date at the start stay so: to ask them anew takes longer than a job.
        done = PRIVATE.has(scheduler, "scheduler", "finished_jobs")
        if PRIVATE.has(dag, "dag", "_finished _needrun _len") and done:
            current = {job for job in dag.jobs if not dag.needrun(job)}
            dag._finished.update(current)
            scheduler.finished_jobs += len(current)
            dag._len = len(dag._finished | dag._needrun)
        if SETTINGS.jobs.fork and AVAILABLE:
            SERVERS.append(ForkServer(SCRIPTS, MODULES, os.environ | ONE_THREAD))
    sys.stderr.write(PRIVATE.describe())
