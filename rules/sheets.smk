# Calculation sheets: of each design, and of the study.


rule sheet:
    input:
        mesh=rules.mesh.output.mesh,
        folded=rules.fold.output.folded,
        arrays=rules.size.output.arrays,
        final=rules.size.output.final,
        mesh_convergence=rules.mesh_convergence.output.study,
        comparison=rules.compare.output.comparison,
        engineering=rules.check.output.record,
        utilization=rules.draw.output.utilization,
        library=code_inputs("sheet"),
        assets=assets(),
    output:
        html=f"{RESULTS}/{{design}}/sheet.html",
        data=f"{RESULTS}/{{design}}/sheet.json",
    log:
        log_of("sheet"),
    benchmark:
        timing("sheet")
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    params:
        design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
        settings=of_stage("size"),
    message:
        "{wildcards.design}: calculation sheet"
    script:
        "../scripts/sheet.py"


rule sheet_pdf:
    input:
        data=rules.sheet.output.data,
        picture=rules.draw.output.utilization,
        library=code_inputs("sheet_pdf"),
        assets=assets(),
    output:
        pdf=f"{RESULTS}/{{design}}/sheet.pdf",
    log:
        log_of("sheet_pdf"),
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    message:
        "{wildcards.design}: calculation sheet as PDF"
    script:
        "../scripts/sheet_pdf.py"


rule summary_pdf:
    input:
        summary=f"{STUDY}/summary.csv",
        tiles=rules.all_designs.output.tiles,
        sheet=rules.all_designs.output.all_thickness,
        designs=report_designs,
        library=code_inputs("summary_pdf"),
        assets=assets(),
    output:
        pdf=f"{STUDY}/summary.pdf",
    log:
        study_log("summary_pdf"),
    conda:
        "../envs/foldshell.yaml"
    params:
        study=SETTINGS.study,
        results=results_folder,
    message:
        "summary of the study as PDF"
    script:
        "../scripts/summary_pdf.py"


rule sheets:
    input:
        rules.summary_pdf.output.pdf,
        sheets_of_study,
