rule pattern:
    input:
        files=files_of_design,
        content=files_content,
        library=code_inputs("pattern"),
    output:
        fold=f"{RESULTS}/{{design}}/pattern/crease_pattern.fold",
        dxf=f"{RESULTS}/{{design}}/pattern/crease_pattern.dxf",
        svg=f"{RESULTS}/{{design}}/pattern/crease_pattern.svg",
    log:
        log_of("pattern"),
    benchmark:
        timing("pattern")
    priority: BEFORE_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        **of_design("pattern", "surface", "span_m", "height_m", "zigzag", "strip"),
        **of_design("rest_fold_angle_deg", "strip_grading", "folded", "file_unit"),
        **of_design("opening_angle_deg", "take_up"),
        sides=sides,
        sector_angle_deg=sector_angle_deg,
        settings=of_stage("drawings"),
    message:
        "{wildcards.design}: crease pattern"
    script:
        "../scripts/pattern.py"
