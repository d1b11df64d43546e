# What the best of an exploration is held against: its base in the table and the smooth
# shell, sized for several buckling factors, by the paper's measure and for reinforced concrete.


rule rivals:
    input:
        candidates=rules.explored.input.candidates,
        library=code_inputs("rivals"),
    output:
        table=f"{EXPLORED}/rivals/rivals.tsv",
        about=f"{EXPLORED}/rivals/about.json",
        resized=f"{EXPLORED}/rivals/resized.csv",
    log:
        f"{RESULTS}/logs/rivals/{EXPLORATION.name}.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        **SEARCH,
    message:
        f"exploration {EXPLORATION.name}: the best beside the table and the smooth shell"
    script:
        "../scripts/rivals.py"


rule judged:
    input:
        table=rules.rivals.output.table,
        library=code_inputs("judged"),
    output:
        judged=f"{EXPLORED}/rivals/{{measure}}.csv",
    log:
        f"{RESULTS}/logs/judged/{EXPLORATION.name}-{{measure}}.log",
    wildcard_constraints:
        measure="|".join(MEASURES),
    conda:
        "../envs/foldshell.yaml"
    threads: workflow.cores
    params:
        snakefile=f"{HOME}/Snakefile",
        folder=lambda wildcards: f"{EXPLORED}/rivals/{wildcards.measure}",
        sizing=lambda wildcards: MEASURES[wildcards.measure],
        config=parse_group(type(SETTINGS), config),
    message:
        f"exploration {EXPLORATION.name}: the best and its rivals, {{wildcards.measure}}"
    script:
        "../scripts/judged.py"


rule beside:
    input:
        expand(rules.judged.output.judged, measure=MEASURES),
        rules.explore_manifest.output,
