# The claims on shells that stand: every design sized anew as reinforced concrete, in memory.

from foldshell.claims.reinforced_gather import FOLDER
from foldshell.settings.design import NONE
from foldshell.settings.own import read_own

# By the checks that settle with the mesh, and on half the subdivisions of the study: what that
# changes is measured, and enters the uncertainty.
OWN = "config/reinforced_settled.yaml"
COARSER = 2
with user_errors():
    STANDING = SETTINGS.own.get(OWN) or read_own(f"{HOME}/{OWN}", config, "claims_reinforced")
MADE_TO_STAND = [
    d for d in JUDGED["sized"] if d.pattern != "flat" and d.on_grid and d.settings == NONE
]


rule reinforced_state:
    input:
        folded=rules.fold.output.folded,
        mesh_convergence=rules.mesh_convergence.output.study,
        flat=flat_sheet,
        library=code_inputs("reinforced_state"),
    output:
        json=f"{RESULTS}/{FOLDER}/{{design}}.json",
    log:
        log_of("reinforced_state"),
    benchmark:
        timing("reinforced_state")
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("analyse", 2 * STANDING.sizing.iterations_max),
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        own=OWN,
        flat=lambda wildcards: flat_of(BY_NAME[wildcards.design]),
        support=holding,
        subdivisions=lambda wildcards: max(1, subdivisions(wildcards) // COARSER),
        settings=lambda wildcards: {
            **stage_parameters(STANDING, "size", BY_NAME[wildcards.design]),
            **stage_parameters(STANDING, "checks", BY_NAME[wildcards.design]),
        },
    message:
        "{wildcards.design}: sized as reinforced concrete"
    script:
        "../scripts/reinforced_state.py"


rule claims_reinforced:
    input:
        sized=[f"{RESULTS}/{d.name}/{file}" for d in MADE_TO_STAND for file in SIZED],
        flats=[f"{RESULTS}/{d.name}/flat_equal.json" for d in JUDGED["flats"]],
        states=[f"{RESULTS}/{FOLDER}/{d.name}.json" for d in MADE_TO_STAND],
        library=code_inputs("claims_reinforced"),
    output:
        json=f"{STUDY}/claims_reinforced.json",
        page=f"{STUDY}/claims_reinforced.md",
    log:
        study_log("claims_reinforced"),
    conda:
        "../envs/foldshell.yaml"
    params:
        results=results_folder,
        designs=[d.to_row() for d in MADE_TO_STAND],
        flats=[d.to_row() for d in JUDGED["flats"]],
        own=OWN,
        factor_due=STANDING.sizing.buckling_factor_min,
        settings=stage_parameters(SETTINGS, "study"),
    message:
        "claims of the paper on shells that stand"
    script:
        "../scripts/claims_reinforced.py"
