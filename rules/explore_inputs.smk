# The exploration of the settings: its rounds, and what each of them reads.

from foldshell.settings.design import Design
from foldshell.settings.exploration import list_sizing
from foldshell.settings.exploration_check import settle_exploration
from foldshell.settings.exploration_file import read_exploration
from foldshell.settings.stages import search_parameters
from foldshell.settings.study import NO_EXPLORATION
from foldshell.explore.alike import size_alike
from foldshell.explore.names import list_references, name_candidate


def read_searched():
    """Return the exploration of the settings and the rows of its round 0."""
    found = read_exploration(SETTINGS.exploration, SETTINGS.defaults)
    found = settle_exploration(found, SETTINGS, SETTINGS.exploration)
    return found, list_references(found, DESIGNS)


with user_errors():
    EXPLORATION, REFERENCES = read_searched()

EXPLORED = f"{RESULTS}/explorations/{EXPLORATION.name}"
ROUNDS = EXPLORATION.search.rounds + 1
SEARCH = {
    "exploration": EXPLORATION.to_plain(),
    "settings": search_parameters(
        SETTINGS, Design.from_row({"design": "base", "tags": "", **EXPLORATION.base})
    ),
}


def candidates_of(number):
    """Return the candidate.json of a round."""
    count = EXPLORATION.count_batch(number) if number else len(REFERENCES)
    names = [name_candidate(number, place) for place in range(count)]
    return [f"{EXPLORED}/candidates/{name}/candidate.json" for name in names]


def earlier(wildcards):
    """Return those of all rounds before one."""
    return [file for number in range(int(wildcards.round)) for file in candidates_of(number)]


# By what rivals are sized: the paper's measure by the rule that keeps a factor, and with steel.
MEASURES = {
    "paper": size_alike(EXPLORATION.limits.buckling_factor_min),
    "reinforced": read_config(f"{HOME}/config/reinforced.yaml")["sizing"],
}
