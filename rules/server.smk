# The process that imports the libraries once and runs scripts in forks.

from foldshell.engine.fork_client import AVAILABLE, ForkServer
from foldshell.engine.preload import MODULES, POOLS

SERVERS = []  # the one, once the first job may start


def start_server(modules):
    """Start the process whose forks run scripts, where there is one: not beside a cluster. In a job
    of a cluster no fork waits for another script: what it holds counts as memory of the job."""
    here = runs_here()
    if SETTINGS.jobs.fork and AVAILABLE and (here or is_job()):
        kept = (MEMORY[1], setting_of("resource_settings", "cores") or None) if here else (0, 0)
        SERVERS.append(ForkServer(SCRIPTS, modules, os.environ | ONE_THREAD, *kept))


def find_server():
    """Return the server, None without one. A job of a cluster with several scripts starts its own,
    which imports what they have in common once."""
    rules_here = {job.rule.name for job in workflow.dag.jobs} if is_job() and not SERVERS else ()
    if len(rules_here) > 1:
        start_server(sorted(set(MODULES).intersection(rules_here)))
    return SERVERS[0] if SERVERS else None
