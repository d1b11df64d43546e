# Figures over all designs.


include: "report_files.smk"


rule study_figures:
    input:
        summary=f"{STUDY}/summary.csv",
        designs=final_states,
        library=code_inputs("study_figures"),
    output:
        **charts(CHARTS),
    log:
        study_log("study_figures"),
    benchmark:
        study_timing("study_figures")
    conda:
        "../envs/foldshell.yaml"
    params:
        results=results_folder,
        settings=stage_parameters(SETTINGS, "size"),
    message:
        "charts over all designs"
    script:
        "../scripts/study_figures.py"


use rule study_figures as panel_figures with:
    output:
        **charts(PANEL_CHARTS),
    log:
        study_log("panel_figures"),
    benchmark:
        study_timing("panel_figures")
    message:
        "charts of the panels of all designs"


rule all_designs:
    input:
        summary=f"{STUDY}/summary.csv",
        designs=final_states,
        library=code_inputs("all_designs"),
    output:
        **{name: figure(name) for name in SHEETS},
        tiles=f"{STUDY}/figures/tiles.json",
    log:
        study_log("all_designs"),
    benchmark:
        study_timing("all_designs")
    conda:
        "../envs/foldshell.yaml"
    params:
        results=results_folder,
        settings=stage_parameters(SETTINGS, "size"),
    message:
        "all designs on one page"
    script:
        "../scripts/all_designs.py"
