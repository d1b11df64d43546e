# Files for other programs, one job for each format of a design; not part of a study.

from foldshell.exchange.formats import FORMATS

EXPORTS = f"{RESULTS}/{{design}}/exports"


for FORMAT in FORMATS:

    rule:
        name:
            f"export_{FORMAT}"
        input:
            mesh=rules.mesh.output.mesh,
            folded=rules.fold.output.folded,
            final=rules.size.output.arrays,
            report=rules.size.output.final,
            classes=CLASSES["arrays"],
            pattern=rules.pattern.output.fold,
            design_vtu=rules.draw.output.vtu,
            checks=rules.check.output.record,
            files=files_of_design,
            content=files_content,
            library=code_inputs("export"),
        output:
            # What jobs wait for comes first: it is written last.
            f"{EXPORTS}/records/{FORMAT}.json",
            [f"{EXPORTS}/{file}" for file in FORMATS[FORMAT].files],
        log:
            log_of(f"export_{FORMAT}"),
        priority: AFTER_LOOP
        conda:
            "../envs/exports.yaml"
        params:
            format_name=FORMAT,
            design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
            settings=lambda wildcards: of_stage("crosscheck")(wildcards)
            | of_stage("drawings")(wildcards)
            | of_stage("exports")(wildcards),
        message:
            f"{{wildcards.design}}: export {FORMAT}"
        script:
            "../scripts/export.py"


rule export_index:
    input:
        records=[f"{EXPORTS}/records/{name}.json" for name in SETTINGS.exports.formats],
        library=code_inputs("export_index"),
    output:
        page=f"{EXPORTS}/index.html",
    log:
        log_of("export_index"),
    priority: AFTER_LOOP
    conda:
        "../envs/foldshell.yaml"
    message:
        "{wildcards.design}: list of exports"
    script:
        "../scripts/export_index.py"


rule export:
    input:
        lambda wildcards: [file for name in names_of_tag(SETTINGS.study) for file in exported(name)],
