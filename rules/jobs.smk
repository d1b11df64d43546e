# How the jobs of this machine are started: in forks of a process that has imported the libraries.

from subprocess import CalledProcessError

from snakemake.script import PythonScript

from foldshell.engine.fork_client import AVAILABLE, ForkServer, NoForkServer

# In the order in which they are needed: scripts, and what they import only where they use it.
LOADED = ["snakemake.script", "pattern", "fold", "mesh", "start", "analyse", "resize", "xlsxwriter"]
LOADED += ["foldshell.shell.ready", "cvxopt.amd", "group", "size", "neutral_model", "mesh_convergence"]
LOADED += ["compare", "crosscheck.verdict", "crosscheck.workbook", "draw", "meshio", "page"]
LOADED += ["vtkmodules.vtkRenderingOpenGL2", "vtkmodules.util.numpy_support", "ezdxf"]
LOADED += ["sensitivity", "flat_equal", "summary", "timings", "report_pages", "all_designs"]
LOADED += ["study_figures", "manifest", "matplotlib.backends.backend_agg", "matplotlib.backends.backend_svg"]
# Rules whose process stays for the next job of a kind ("shell", "pictures"). Analyses of a design follow each other: the
# next one finds the mesh's operators, the order of elimination and memory there, a quarter of its
# time. Pictures find the renderer set up.
KEPT = {"analyse": "shell", "group": "shell", "draw": "pictures"}


def run_in_forks(server):
    """Let Snakemake start each script in a fork, and note what it used for `benchmark:`."""
    run_anew = PythonScript.execute_script

    def execute_script(self, fname, edit=False):
        elsewhere = self.conda_env or self.container_img or self.env_modules or self.shadow_dir
        try:
            kind = KEPT.get(self.rulename, "")
            topic = self.wildcards.get("design", "")
            job = None if edit or elsewhere else server.start(fname, kind, topic)
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
        # before the first job starts stays so. Progress counts it as done.
        if hasattr(workflow.dag, "_finished") and hasattr(workflow.scheduler, "finished_jobs"):
            current = {job for job in workflow.dag.jobs if not workflow.dag.needrun(job)}
            workflow.dag._finished.update(current)
            workflow.scheduler.finished_jobs += len(current)
            workflow.dag._len = len(workflow.dag._finished | workflow.dag._needrun)
        if SETTINGS.jobs.fork and AVAILABLE:
            run_in_forks(ForkServer(SCRIPTS, LOADED, os.environ | ONE_THREAD))
