# Results in an object storage: whether it answers, before a run and at its end.

import atexit

from foldshell.engine.storage import describe_silence, find_endpoint
from foldshell.files.errors import InputError

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
