rule fold:
    input:
        fold=rules.pattern.output.fold,
        files=files_of_design,
        content=files_content,
        library=code_inputs("fold"),
    output:
        folded=f"{RESULTS}/{{design}}/folded/folded.npz",
        vtu=f"{RESULTS}/{{design}}/folded/folded.vtu",
        quality=f"{RESULTS}/{{design}}/folded/quality.json",
    log:
        log_of("fold"),
    benchmark:
        timing("fold")
    priority: BEFORE_LOOP
    conda:
        "../envs/foldshell.yaml"
    resources:
        **needs_of("fold"),
    params:
        **of_design("surface", "span_m", "height_m", "fold_mode", "file_unit"),
        sides=sides,
        outline=outline,
        settings=of_stage("fold"),
    message:
        "{wildcards.design}: folding onto the target surface"
    script:
        "../scripts/fold.py"


rule unfold:
    input:
        pattern=rules.pattern.output.fold,
        folded=rules.fold.output.folded,
        library=code_inputs("unfold"),
    output:
        fold=f"{RESULTS}/{{design}}/pattern/developable_pattern.fold",
        dxf=f"{RESULTS}/{{design}}/pattern/developable_pattern.dxf",
        svg=f"{RESULTS}/{{design}}/pattern/developable_pattern.svg",
    log:
        log_of("unfold"),
    conda:
        "../envs/foldshell.yaml"
    params:
        **of_design("fold_mode"),
        settings=of_stage("drawings"),
    message:
        "{wildcards.design}: crease pattern of the folded sheet"
    script:
        "../scripts/unfold.py"


rule animate:
    input:
        fold=f"{RESULTS}/{{design}}/pattern/{{pattern}}_pattern.fold",
        library=code_inputs("animate"),
    output:
        gif=f"{RESULTS}/{{design}}/animation/{{pattern}}.gif",
        stills=directory(f"{RESULTS}/{{design}}/animation/{{pattern}}"),
    log:
        log_of("animate", "-{pattern}"),
    wildcard_constraints:
        pattern="crease|developable",
    conda:
        "../envs/foldshell.yaml"
    message:
        "{wildcards.design}: animation of the {wildcards.pattern} pattern"
    script:
        "../scripts/animate.py"


rule kinematics:
    input:
        library=code_inputs("kinematics"),
    output:
        table=f"{RESULTS}/kinematics.json",
        figure=f"{RESULTS}/kinematics.png",
        rules=f"{RESULTS}/kinematics_rules.csv",
        trajectories=f"{RESULTS}/kinematics_trajectories.png",
    log:
        study_log("kinematics"),
    conda:
        "../envs/foldshell.yaml"
    params:
        sector_angle_deg=SECTOR_ANGLE_DEG,
    message:
        "kinematics of the Miura sheet"
    script:
        "../scripts/kinematics.py"
