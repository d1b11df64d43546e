# What all explorations that have been run come to, beside Table 1 and the smooth shell. Its page
# and pictures are copied to docs/, its table of designs to config/, by hand.


rule fold_answer:
    input:
        tables=explored_tables,
        beside=explored_beside,
        library=code_inputs("fold_answer"),
    output:
        page=f"{RESULTS}/explorations/function_follows_fold.md",
        found=f"{RESULTS}/explorations/found.tsv",
        pictures=[
            f"{RESULTS}/explorations/images/fold_answer_{name}.png"
            for name in ("factors", "panels")
        ],
    log:
        f"{RESULTS}/logs/fold_answer.log",
    conda:
        "../envs/foldshell.yaml"
    params:
        summary=table_summary(),
        listed=sorted(path.stem for path in Path("config/explorations").glob("*.yaml")),
    message:
        "what the fold buys, and what it costs"
    script:
        "../scripts/fold_answer.py"
