rule mesh:
    message:
        "{wildcards.design}: shell mesh and supports"
    input:
        folded=rules.fold.output.folded,
        library=code_inputs("mesh"),
    output:
        mesh=f"{RESULTS}/{{design}}/shell/mesh.npz",
        vtu=f"{RESULTS}/{{design}}/shell/mesh.vtu",
    params:
        **of_design("support"),
        edge_beam=edge_beam,
        subdivisions=subdivisions,
    priority: BEFORE_LOOP
    benchmark:
        timing("mesh")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/mesh.py"
