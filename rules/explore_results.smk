# What follows a search: the best designs by the ordinary rules, their slopes, page and manifest.


rule confirm:
    input:
        selected=rules.explored.output.selected,
        library=code_inputs("confirm"),
    output:
        summary=f"{EXPLORED}/confirmed.csv",
    log:
        f"{RESULTS}/logs/confirm/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    threads: workflow.cores
    params:
        snakefile=f"{HOME}/Snakefile",
        folder=lambda wildcards: f"{EXPLORED}/confirmed",
        sizing=list_sizing(EXPLORATION, SETTINGS.sizing),
        config=parse_group(type(SETTINGS), config),
    message:
        f"exploration {EXPLORATION.name}: the best by the ordinary rules"
    script:
        "../scripts/confirm.py"


rule slopes:
    input:
        candidates=rules.explored.input.candidates,
        library=code_inputs("slopes"),
    output:
        json=f"{EXPLORED}/slopes.json",
    log:
        f"{RESULTS}/logs/slopes/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        **SEARCH,
    message:
        f"exploration {EXPLORATION.name}: what would help the best most"
    script:
        "../scripts/slopes.py"


rule explore_page:
    input:
        slopes=rules.slopes.output.json,
        candidates=rules.explored.input.candidates,
        table=rules.explored.output.table,
        confirmed=rules.confirm.output.summary,
        assets=assets(),
        library=code_inputs("explore_page"),
    output:
        page=f"{EXPLORED}/explore.html",
    log:
        f"{RESULTS}/logs/explore_page/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        exploration=SEARCH["exploration"],
    message:
        f"exploration {EXPLORATION.name}: page"
    script:
        "../scripts/explore_page.py"


rule explore_manifest:
    input:
        rules.explore_page.output,
        library=code_inputs("manifest"),
    output:
        manifest=f"{EXPLORED}/manifest.json",
    log:
        f"{RESULTS}/logs/explore_manifest/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        title=EXPLORATION.name,
        deciding_rules=["propose", "candidate"],
        code=str(HOME),
    message:
        f"exploration {EXPLORATION.name}: manifest"
    script:
        "../scripts/manifest.py"


rule explore:
    input:
        rules.explore_manifest.output,


include: "rivals.smk"
