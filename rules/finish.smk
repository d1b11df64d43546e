# What is done when all jobs have ended.

from foldshell.engine.copies import copy_study
from foldshell.settings.places import TOP


def finish_run():
    """Put copies of what the study made where a person looks first."""
    studies = RUN["studies"]
    if RUN["started"] and studies:
        tag = SETTINGS.study if SETTINGS.study in studies else studies[-1]
        copy_study(
            f"{RESULTS}/{STUDIES}/{tag}", TOP if Path(TOP) in Path(RESULTS).parents else RESULTS
        )


onsuccess:
    finish_run()


onerror:
    finish_run()
