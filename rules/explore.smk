# The search of the pattern; no part of `all`. A plan that does not change: how many designs a round
# has is a setting, so every name is known before any job starts.


include: "explore_inputs.smk"


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
        f"exploration {EXPLORATION.name}: designs of round {{wildcards.round}}"
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
        f"exploration {EXPLORATION.name}: {{wildcards.round}}-{{wildcards.place}}"
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
        f"exploration {EXPLORATION.name}: tables"
    script:
        "../scripts/explored.py"


include: "explore_results.smk"
