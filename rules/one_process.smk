# What a cluster is asked for as one job runs in one process. As it is, the executor of Slurm's job
# steps starts a Snakemake of its own for each rule of a group, which takes longer than most scripts.

if is_job() and PRIVATE.has(workflow, "workflow", "localrules rules"):
    workflow.localrules(*(one.name for one in workflow.rules))
