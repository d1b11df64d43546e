# What a run does when it begins and when its jobs have ended.

import contextlib

from snakemake.logging import logger

from foldshell.engine.cluster_end import describe_cluster_ends
from foldshell.engine.copies import copy_study
from foldshell.engine.environment import check_deployment
from foldshell.engine.interrupt import stop_once
from foldshell.engine.job_end import show_log
from foldshell.engine.live_view import LiveView, describe_results
from foldshell.files.package_data import is_installed
from foldshell.settings.places import TOP, claim_results

DEPLOYMENT = {way.name.lower() for way in setting_of("deployment_settings", "deployment_method")}

with user_errors():
    check_deployment(DEPLOYMENT, is_installed())

if not is_job():
    write_json(LISTS_FILE, LISTS)

VIEWS = []  # on a terminal: the lines that stay


def begin_run():
    """Write down whose results these are; on a terminal, show the run in a few lines."""
    RUN["started"] = True
    stop_once()
    claim_results(RESULTS, SETTINGS.designs)
    if handler := terminal_handler():
        print(f"results: {Path(RESULTS).resolve()}", file=sys.stderr)
        names = dict.fromkeys(name for tag in RUN["studies"] for name in names_of_tag(tag))
        VIEWS.append(LiveView(RESULTS, names, workflow.cores, handler.format, handler.stream))
        handler.addFilter(is_shown)
        logger.addHandler(VIEWS[0])


def is_shown(record):
    """Let Snakemake's own lines through where there is no view."""
    return not VIEWS


def show_job(log, failed):
    """Print what a job has said, which stands in its log too; on a terminal only if it failed."""
    if VIEWS and failed:
        VIEWS[0].print_above(Path(log).read_text(encoding="utf-8", errors="replace"))
    elif not VIEWS:
        show_log(log)


def finish_run():
    """Put copies of what the study made where a person looks first; say what came out."""
    for view in VIEWS:
        logger.removeHandler(view)
        view.close()
    studies = RUN["studies"]
    on_terminal = bool(VIEWS)
    VIEWS.clear()
    if not (RUN["started"] and studies):
        return
    tag = SETTINGS.study if SETTINGS.study in studies else studies[-1]
    study = f"{RESULTS}/{STUDIES}/{tag}"
    copy_study(study, TOP if Path(TOP) in Path(RESULTS).parents else RESULTS)
    if on_terminal:
        print(describe_results(RESULTS, names_of_tag(tag), study), file=sys.stderr)


onsuccess:
    finish_run()


def read_log(path):
    """Return what stands in a log, nothing without one."""
    with contextlib.suppress(OSError):
        return Path(path).read_text(encoding="utf-8", errors="replace")
    return ""


onerror:
    finish_run()
    logs = [log] if isinstance(log, str) else log
    for sentence in describe_cluster_ends("\n".join(map(read_log, logs)), read_log):
        print(sentence, file=sys.stderr)
