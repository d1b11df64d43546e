# Results in an object storage: whether it answers, before a run and at its end, and the files that
# no rule declares, which go there and come from there with those of a job.

import atexit
import contextlib
import threading

from foldshell.engine.job import find_home
from foldshell.engine.storage import describe_silence, find_endpoint
from foldshell.engine.stored_files import EVERYTHING, ITERATIONS, OF_ITERATIONS, RECORDS
from foldshell.engine.stored_files import WHOLE_LOOP, open_stored, storage_errors
from foldshell.files.errors import InputError
from foldshell.files.job_record import list_outputs

STORED = setting_of("storage_settings", "default_storage_provider")


def silence():
    """Return a sentence where the storage does not answer."""
    where = setting_of("storage_settings", "default_storage_prefix") or STORED
    return describe_silence(find_endpoint(os.environ, sys.argv), where) if STORED == "s3" else ""


def say_silence():
    """Say in the last line of a run that the storage has gone away, below Snakemake's own words."""
    if said := silence():
        print(f"error: {said}", file=sys.stderr)


if STORED and not is_job():
    with user_errors():
        if SILENCE := silence():
            raise InputError(SILENCE)
    atexit.register(say_silence)


FETCHED = {
    "verify": ("", EVERYTHING),
    "archive_study": ("", EVERYTHING),
    "timings": ("benchmarks", EVERYTHING),
    "summary": ("", ITERATIONS),
}
"""Rules that read more of the folder of all results than they declare."""


@functools.cache
def stored_results():
    """Return the folder of all results in the storage, None without one."""
    if STORED != "s3":
        return None
    prefix = setting_of("storage_settings", "default_storage_prefix")
    return open_stored(prefix, RESULTS, place(), find_endpoint(os.environ, sys.argv), os.environ)


KNOWN_HERE = set()  # folders of designs and studies, by pattern of what has been fetched
ONE_BY_ONE = threading.Lock()


def fetch_beside(job, folder, name):
    """Fetch what a job may read and does not declare, that of a design or study once a run: of a
    loop what the pages and workbooks after it show, and what a loop in one job goes on from."""
    loop = job.rulename not in ("pattern", "fold", "mesh", "start", "analyse", "resize")
    pattern = WHOLE_LOOP if loop else RECORDS
    with ONE_BY_ONE, storage_errors(folder):
        if job.rulename in FETCHED:
            folder.fetch(*FETCHED[job.rulename])
        if name != "." and (name, pattern) not in KNOWN_HERE:
            folder.fetch(name, pattern)
            KNOWN_HERE.add((name, pattern))


@contextlib.contextmanager
def stored_beside(job):
    """Fetch the undeclared files that a job may read, run the block, store those that it leaves, and
    before the first of a job's outputs, which others wait for, all others."""
    folder = stored_results()
    if not folder:
        yield
        return
    outputs = [str(path) for path in job.output]
    home = find_home(outputs or [f"{place()}/-"], job.wildcards)
    name = str(home.relative_to(place()))
    pattern = WHOLE_LOOP if job.rulename == "size" and CHOICE == "whole" else RECORDS
    others = ()
    try:
        fetch_beside(job, folder, name)
        try:
            yield
            others = {path.relative_to(home).as_posix() for path in list_outputs(outputs[1:])}
        finally:
            if name != ".":
                with storage_errors(folder):
                    folder.store(name, pattern, others)
        if job.rulename == "size":
            with storage_errors(folder):
                folder.take_away(name, OF_ITERATIONS)
    except InputError as error:
        raise WorkflowError(str(error)) from None
