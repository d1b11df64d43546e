# Inputs: what of the library, and of the files beside it, a rule's script is made of.

from snakemake.io import sourcecache_entry

from foldshell.engine.imports import write_library_list
from foldshell.files.whole import read_json, write_json

LIBRARY = ".snakemake/library"
LISTS_FILE = f"{LIBRARY}/lists.json"
LISTS = {}  # of library files, by script


def listed(path):
    """Return a list of files as an input: a file of this machine, whatever prefix or storage results
    have. Its name tells its content; the date says nothing, so that a machine where results in a
    storage are met for the first time need not make them anew. Where machines share no files each
    has its own: a job with a `local` input would run where Snakemake does, and so would its group.
    """
    if not setting_of("storage_settings", "default_storage_provider"):
        return local(path)
    os.utime(path, (0, 0))
    shared = {str(kind) for kind in setting_of("storage_settings", "shared_fs_usage")}
    return local(path) if "input-output" in shared else sourcecache_entry(path, path)


def code_inputs(script):
    """Return the list of the library files that a rule's script imports, as an input of it. A job
    elsewhere takes what its run has found: that takes half of the time to read the rules."""
    if script not in LISTS and is_job() and Path(LISTS_FILE).is_file():
        LISTS.update(read_json(LISTS_FILE))
    if script not in LISTS:
        path = f"{SCRIPTS}/{script}.py"
        LISTS[script] = write_library_list(path, SCRIPTS, LIBRARY)
    return listed(LISTS[script])


def assets():
    """Return the list of templates, styles and scripts of the pages, as an input of a rule: they
    are read, not imported."""
    files = [path for path in Path(PAGES).rglob("*") if path.is_file()]
    data = sorted(path for path in files if path.suffix not in (".py", ".pyc"))
    return listed(write_content_list(data, LIBRARY))


# Written before Snakemake looks at what there is.
CONTENTS = {d.name: [listed(write_content_list(d.files, LIBRARY))] for d in DESIGNS if d.files}
