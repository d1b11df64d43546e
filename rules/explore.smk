# The search of the pattern; no part of `all`. A plan that does not change: how many designs a round
# has is a setting, so every name is known before any job starts.

from foldshell.settings.design import Design
from foldshell.settings.exploration import read_exploration
from foldshell.settings.study import NO_EXPLORATION
from foldshell.explore.names import list_references, name_candidate


def read_searched():
    """Return the exploration of the settings and the rows of its round 0."""
    found = read_exploration(SETTINGS.exploration, SETTINGS.defaults)
    return found, list_references(found, DESIGNS)


with user_errors():
    EXPLORATION, REFERENCES = read_searched()

EXPLORED = f"{RESULTS}/explorations/{EXPLORATION.name}"
ROUNDS = EXPLORATION.search.rounds + 1
SEARCH = {
    "exploration": EXPLORATION.to_plain(),
    "settings": stage_parameters(
        SETTINGS, "study", Design.from_row({"design": "base", "tags": "", **EXPLORATION.base})
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


wildcard_constraints:
    round=r"\d\d",
    place=r"\d\d+",


rule propose:
    input:
        earlier=earlier,
        library=code_inputs("propose"),
    output:
        table=f"{EXPLORED}/rounds/{{round}}/candidates.tsv",
        screened=f"{EXPLORED}/rounds/{{round}}/screened.json",
    log:
        f"{RESULTS}/logs/propose/{EXPLORATION.name}-{{round}}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        **SEARCH,
        references=lambda wildcards: [] if int(wildcards.round) else REFERENCES,
    message:
        "exploration " + EXPLORATION.name + ": designs of round {wildcards.round}"
    script:
        "../scripts/propose.py"


rule candidate:
    input:
        table=f"{EXPLORED}/rounds/{{round}}/candidates.tsv",
        library=code_inputs("candidate"),
    output:
        json=f"{EXPLORED}/candidates/{{round}}-{{place}}/candidate.json",
    log:
        f"{RESULTS}/logs/candidate/{EXPLORATION.name}-{{round}}-{{place}}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        **SEARCH,
    message:
        "exploration " + EXPLORATION.name + ": {wildcards.round}-{wildcards.place}"
    script:
        "../scripts/candidate.py"


rule explored:
    input:
        candidates=[file for number in range(ROUNDS + 1) for file in candidates_of(number)],
        library=code_inputs("explored"),
    output:
        table=f"{EXPLORED}/explore.tsv",
        workbook=f"{EXPLORED}/explore.xlsx",
        csv=f"{EXPLORED}/design_explorer.csv",
        selected=f"{EXPLORED}/selected.tsv",
    log:
        f"{RESULTS}/logs/explored/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        exploration=SEARCH["exploration"],
    message:
        "exploration " + EXPLORATION.name + ": tables"
    script:
        "../scripts/explored.py"


include: "explore_results.smk"
