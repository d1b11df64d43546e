# Which way the thickness loop runs: a job for each step, or one for each design.

from snakemake.exceptions import IncompleteCheckpointException

from foldshell.records.edits import keep_all_edited

STEPS_MAX = 60
"""Designs up to which the rules of the loop run one by one: Snakemake's own time grows with the
square of the designs then."""
CHOSEN = "FOLDSHELL_LOOP"


def choose_loop():
    """Return how loops run, `steps` or `whole`; jobs elsewhere take what their run has chosen."""
    if SETTINGS.loop != "auto":
        return SETTINGS.loop
    if CHOSEN not in os.environ:
        count = len(with_tags(SETTINGS.study))
        os.environ[CHOSEN] = "steps" if count <= STEPS_MAX and runs_here() else "whole"
        if os.environ[CHOSEN] == "whole":
            print(f"loop: whole, one job for each of {count} designs", file=sys.stderr)
    return os.environ[CHOSEN]


MADE = {}  # analysis.json by design and iteration


def find_analysis(design, iteration):
    """Return the analysis.json of an iteration where Snakemake knows that it is made, else None. It
    compares with all outputs that it knows each time, and none of them is ever forgotten."""
    if (design, iteration) not in MADE:
        try:
            found = checkpoints.analyse.get(design=design, iteration=iteration)
        except IncompleteCheckpointException:
            return None
        MADE[design, iteration] = found.output.json
    return MADE[design, iteration]


@functools.cache
def read_verdict(path, _changed):
    """Return the verdict of an analysis as it stands since some time."""
    return read_json(path)["verdict"]


CHOICE = choose_loop()

# Jobs elsewhere have the environment that is named here.
if CHOSEN in os.environ:

    envvars:
        CHOSEN,


if not is_job():
    for path in keep_all_edited(place()):
        print(f"kept a copy of the edited workbook {path}", file=sys.stderr)

if CHOICE == "whole":

    include: "whole.smk"

else:

    include: "sizing.smk"
    include: "final.smk"
