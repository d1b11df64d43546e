# How the jobs of this machine are started: in forks of a process that has imported the libraries.

from subprocess import CalledProcessError

from snakemake.script import PythonScript

from forks.client import AVAILABLE, ForkServer, NoForkServer

FORKED = ["pattern", "fold", "mesh", "start", "analyse", "resize", "group", "size"]
FORKED += ["neutral_model", "refine", "crosscheck", "draw", "page", "sensitivity", "flat_equal"]
LOADED = ["snakemake.script", *FORKED, "xlsxwriter", "meshio", "ezdxf"]
LOADED += ["foldshell.shell.ready", "cvxopt.amd", "crosscheck.verdict", "crosscheck.workbook"]
LOADED += ["vtkmodules.vtkRenderingOpenGL2", "vtkmodules.util.numpy_support"]


def run_in_forks(server):
    """Let Snakemake start each script in a fork, and note what it used for `benchmark:`."""
    run_anew = PythonScript.execute_script

    def execute_script(self, fname, edit=False):
        elsewhere = self.conda_env or self.container_img or self.env_modules or self.shadow_dir
        try:
            job = None if edit or elsewhere else server.start(fname)
        except NoForkServer:
            job = None
        if job is None:
            return run_anew(self, fname, edit)
        start = time.time()
        end = job.wait()
        if self.bench_record is not None:
            seconds = time.time() - start
            self.bench_record.running_time, self.bench_record.cpu_time = seconds, end.cpu_seconds
            self.bench_record.cpu_usage = 100 * end.cpu_seconds
            self.bench_record.max_rss, self.bench_record.data_collected = end.rss_mb, True
        if end.code:
            raise CalledProcessError(end.code, f"{sys.executable} {fname}")

    PythonScript.execute_script = execute_script


onstart:
    RUN["started"] = True
    if workflow.local_exec:
        # To keep to 100 job starts a second, Snakemake 9 wakes its scheduler every second once more
        # for each job that has ended: after some hundred jobs that takes half a core. Jobs of this
        # machine need no such limit.
        if hasattr(workflow.scheduler, "job_rate_limiter"):
            workflow.scheduler.job_rate_limiter = None
        # After each analysis Snakemake asks anew of every job that it did not run itself whether it
        # must run: beside a finished study that takes longer than the analysis. What is up to date
        # before the first job starts stays so.
        if hasattr(workflow.dag, "_finished") and hasattr(workflow.scheduler, "finished_jobs"):
            current = {job for job in workflow.dag.jobs if not workflow.dag.needrun(job)}
            workflow.dag._finished.update(current)
            workflow.scheduler.finished_jobs += len(current)
        if SETTINGS.jobs.fork and AVAILABLE:
            run_in_forks(ForkServer(SCRIPTS, LOADED, os.environ | ONE_THREAD))
