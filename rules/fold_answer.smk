# What all explorations that have been run come to, beside Table 1 and the smooth shell.


rule fold_answer:
    input:
        tables=explored_tables,
        library=code_inputs("fold_answer"),
    output:
        page=f"{RESULTS}/explorations/function_follows_fold.md",
        picture=f"{RESULTS}/explorations/function_follows_fold.png",
    log:
        f"{RESULTS}/logs/fold_answer.log",
    conda:
        "../envs/foldshell.yaml"
    message:
        "what the fold buys, and what it costs"
    script:
        "../scripts/fold_answer.py"
