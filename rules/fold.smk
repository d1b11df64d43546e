rule fold:
    message:
        "{wildcards.design}: folding onto the target surface"
    input:
        fold=rules.pattern.output.fold,
        surface=surface_file,
        content=surface_content,
        library=code_inputs("fold"),
    output:
        folded=f"{RESULTS}/{{design}}/folded/folded.npz",
        vtu=f"{RESULTS}/{{design}}/folded/folded.vtu",
        quality=f"{RESULTS}/{{design}}/folded/quality.json",
    params:
        **of_design("surface", "span_m", "height_m", "fold_mode"),
        settings=lambda wildcards: of_stage("fold")(wildcards)["fold"],
    priority: BEFORE_LOOP
    benchmark:
        timing("fold")
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/fold.py"


rule unfold:
    message:
        "{wildcards.design}: crease pattern of the folded sheet"
    input:
        pattern=rules.pattern.output.fold,
        folded=rules.fold.output.folded,
        library=code_inputs("unfold"),
    output:
        fold=f"{RESULTS}/{{design}}/pattern/developable_pattern.fold",
        dxf=f"{RESULTS}/{{design}}/pattern/developable_pattern.dxf",
        svg=f"{RESULTS}/{{design}}/pattern/developable_pattern.svg",
    params:
        **of_design("fold_mode"),
        drawings=lambda wildcards: of_stage("drawings")(wildcards)["drawings"],
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/unfold.py"


rule animate:
    message:
        "{wildcards.design}: animation of the {wildcards.pattern} pattern"
    input:
        fold=f"{RESULTS}/{{design}}/pattern/{{pattern}}_pattern.fold",
        library=code_inputs("animate"),
    output:
        gif=f"{RESULTS}/{{design}}/animation/{{pattern}}.gif",
        stills=directory(f"{RESULTS}/{{design}}/animation/{{pattern}}"),
    wildcard_constraints:
        pattern="crease|developable",
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/animate.py"


rule kinematics:
    message:
        "kinematics of the Miura sheet"
    input:
        library=code_inputs("kinematics"),
    output:
        table=f"{RESULTS}/kinematics.json",
        figure=f"{RESULTS}/kinematics.png",
        rules=f"{RESULTS}/kinematics_rules.csv",
        trajectories=f"{RESULTS}/kinematics_trajectories.png",
    params:
        sector_angle_deg=SECTOR_ANGLE_DEG,
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/kinematics.py"
