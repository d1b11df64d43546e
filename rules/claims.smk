# The claims of the paper: judged by the study, the baselines and runs with other settings.

from foldshell.claims.sensitivity import VARIANTS


def layout_of(name):
    """Return counts of polylines and supports of a design."""
    return BY_NAME[name].zigzag, BY_NAME[name].strip, BY_NAME[name].support


def with_tags(*tags):
    """Return the designs with at least one of the tags, in the order of the table."""
    return [design for design in DESIGNS if set(tags) & set(design.tags)]


def flat_of(design):
    """Return the flat sheet of a folded design's own size and supports, None without one."""
    rows = {flat.name: flat.to_row() for flat in DESIGNS if flat.pattern == "flat"}
    own = {"design", "tags", "pattern"}
    wanted = {name: value for name, value in design.to_row().items() if name not in own}
    found = [name for name, row in rows.items() if wanted.items() <= row.items()]
    return found[0] if found else None


STUDIED = [d for d in with_tags("supports") if SETTINGS.study in d.tags]
JUDGED = {
    "sized": with_tags(SETTINGS.study, "baseline"),
    "folds": with_tags("fold_modes"),
    "runs": STUDIED,
    "flats": [d for d in STUDIED if d.pattern == "miura" and flat_of(d)],
}
SIZED = ["folded/folded.npz", "folded/quality.json", "shell/mesh.npz", "mesh_convergence.json"]
SIZED += ["sizing/00/analysis.json", "sizing/00/analysis.npz", "sizing/final.json"]
SIZED += ["sizing/final.npz", "crosscheck/comparison.json"]


rule sensitivity:
    message:
        "{wildcards.design}: sized with {wildcards.variant}"
    input:
        mesh=rules.mesh.output.mesh,
        library=code_inputs("sensitivity"),
    output:
        json=f"{RESULTS}/sensitivity/{{variant}}/{{design}}.json",
    wildcard_constraints:
        variant="|".join(VARIANTS),
    params:
        **of_design("span_m"),
        layout=lambda wildcards: layout_of(wildcards.design),
        settings=of_stage("size"),
    benchmark:
        timing("sensitivity", "-{variant}")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/sensitivity.py"


rule flat_equal:
    message:
        "{wildcards.design}: the flat sheet of the same volume"
    input:
        flat=lambda wildcards: f"{RESULTS}/{flat_of(BY_NAME[wildcards.design])}/folded/folded.npz",
        final=rules.size.output.final,
        library=code_inputs("flat_equal"),
    output:
        json=f"{RESULTS}/{{design}}/flat_equal.json",
    params:
        **of_design("span_m"),
        flat=lambda wildcards: flat_of(BY_NAME[wildcards.design]),
        layout=lambda wildcards: layout_of(wildcards.design),
        subdivisions=subdivisions,
        settings=of_stage("size"),
    benchmark:
        timing("flat_equal")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/flat_equal.py"


rule claims:
    message:
        "claims of the paper"
    input:
        sized=[f"{RESULTS}/{d.name}/{file}" for d in JUDGED["sized"] for file in SIZED],
        folds=[f"{RESULTS}/{d.name}/{file}" for d in JUDGED["folds"] for file in SIZED[:2]],
        flats=[f"{RESULTS}/{d.name}/flat_equal.json" for d in JUDGED["flats"]],
        runs=[
            f"{RESULTS}/sensitivity/{variant}/{design.name}.json"
            for variant in VARIANTS
            for design in JUDGED["runs"]
        ],
        kinematics=rules.kinematics.output.table,
        library=code_inputs("claims"),
    output:
        json=f"{RESULTS}/claims.json",
        page=f"{RESULTS}/claims.md",
        runs=f"{RESULTS}/sensitivity.csv",
    params:
        results=RESULTS,
        designs={name: [d.to_row() for d in designs] for name, designs in JUDGED.items()},
        variants=list(VARIANTS),
        settings=stage_parameters(SETTINGS, "study"),
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/claims.py"
