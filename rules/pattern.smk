rule pattern:
    message:
        "{wildcards.design}: crease pattern"
    input:
        library=library("pattern"),
    output:
        fold=f"{RESULTS}/{{design}}/pattern/crease_pattern.fold",
    params:
        **of_design("pattern", "surface", "span_m", "height_m", "zigzag", "strip"),
        sector_angle_deg=SETTINGS.pattern.sector_angle * 180 / 3.141592653589793,
    conda:
        "../envs/foldshell.yaml"
    script:
        "../scripts/pattern.py"
