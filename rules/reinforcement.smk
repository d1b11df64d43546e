# The picture of the steel in each layer and direction of the final state.


rule reinforcement:
    input:
        record=rules.check.output.record,
        mesh=rules.mesh.output.mesh,
        library=code_inputs("reinforcement"),
    output:
        picture=f"{RESULTS}/{{design}}/figures/reinforcement.png",
    log:
        log_of("reinforcement"),
    benchmark:
        timing("reinforcement")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    message:
        "{wildcards.design}: picture of reinforcement"
    script:
        "../scripts/reinforcement.py"
