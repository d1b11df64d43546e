rule mesh:
    input:
        folded=rules.fold.output.folded,
        library=code_inputs("mesh"),
    output:
        mesh=f"{RESULTS}/{{design}}/shell/mesh.npz",
        vtu=f"{RESULTS}/{{design}}/shell/mesh.vtu",
    log:
        log_of("mesh"),
    benchmark:
        timing("mesh")
    priority: BEFORE_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("mesh"),
    params:
        support=holding,
        edge_beam=edge_beam,
        subdivisions=subdivisions,
    message:
        "{wildcards.design}: shell mesh and supports"
    script:
        "../scripts/mesh.py"
