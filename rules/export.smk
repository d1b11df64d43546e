# Files for other programs, one job for each format of a design; not part of a study.

from foldshell.exchange.formats import FORMATS, name_files

EXPORTS = f"{RESULTS}/{{design}}/exports"


def exported(design):
    """Return the files of all formats that are asked for, of a design."""
    names = SETTINGS.exports.formats
    files = [file for name in names for file in name_files(name, design)]
    records = [f"records/{name}.json" for name in names]
    return [f"{RESULTS}/{design}/exports/{file}" for file in files + records]


for FORMAT in FORMATS:

    rule:
        name:
            f"export_{FORMAT}"
        message:
            f"{{wildcards.design}}: export {FORMAT}"
        input:
            mesh=rules.mesh.output.mesh,
            folded=rules.fold.output.folded,
            final=rules.size.output.arrays,
            report=rules.size.output.final,
            classes=rules.group.output.arrays,
            pattern=rules.pattern.output.fold,
            design_vtu=rules.draw.output.vtu,
            surface=surface_file,
            library=code_inputs("export"),
        output:
            **{f"file{k}": f"{EXPORTS}/{f}" for k, f in enumerate(FORMATS[FORMAT].files)},
            record=f"{EXPORTS}/records/{FORMAT}.json",
        params:
            format_name=FORMAT,
            design=lambda wildcards: BY_NAME[wildcards.design].to_row(),
            settings=lambda wildcards: of_stage("crosscheck")(wildcards)
            | of_stage("drawings")(wildcards)
            | of_stage("exports")(wildcards),
        priority: AFTER_LOOP
        conda:
            "../envs/exports.yaml"
        script:
            "../scripts/export.py"


rule export:
    input:
        [file for name in names_of_tag(SETTINGS.study) for file in exported(name)],
