# What leaves the pipeline: pictures.


rule draw:
    message:
        "{wildcards.design}: pictures"
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        final=rules.size.output.arrays,
        library=library("draw"),
    output:
        done=f"{RESULTS}/{{design}}/figures/done.json",
    params:
        settings=lambda wildcards: of_stage("figures")(wildcards)["figures"],
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/draw.py"
