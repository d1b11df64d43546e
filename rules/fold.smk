rule fold:
    message:
        "{wildcards.design}: folding onto the target surface"
    input:
        fold=rules.pattern.output.fold,
        library=library("fold"),
    output:
        folded=f"{RESULTS}/{{design}}/folded/folded.npz",
        vtu=f"{RESULTS}/{{design}}/folded/folded.vtu",
        quality=f"{RESULTS}/{{design}}/folded/quality.json",
    params:
        **of_design("surface", "span_m", "height_m", "fold_mode"),
        settings=lambda wildcards: of_stage("fold")(wildcards)["fold"],
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/fold.py"
