# The thickness loop as one job for each design: the same files as by the rules of sizing.smk and
# final.smk, which it stands for. For clusters, large tables and searches.

from foldshell.records.edits import is_edited


def given(values):
    """Return a function of the wildcards: parameters, those that are functions called."""
    return lambda wildcards: {
        job: {name: v(wildcards) if callable(v) else v for name, v in params.items()}
        for job, params in values.items()
    }


@functools.cache
def list_edited(design):
    """Write the list of the workbooks of a design that a person has edited; return it as an input:
    its name tells their content, so that a loop runs again when one is edited or put back; its date
    does so where a machine knows no former run."""
    folder = Path(f"{place()}/{design}/sizing")
    edited = [path for path in sorted(folder.glob("[0-9][0-9]/thickness.xlsx")) if is_edited(path)]
    path = write_content_list(edited, LIBRARY)
    return local(path) if edited else listed(path)


# Written before Snakemake looks at what there is, which it does while it asks for inputs.
listed(write_content_list([], LIBRARY))
if not is_job():
    for loop in Path(place()).glob("*/sizing"):
        list_edited(loop.parent.name)


rule size:
    input:
        **{f"code_{name}": code_inputs(name) for name in LOOP_PARAMS},
        mesh=rules.mesh.output.mesh,
        folded=panels_of_file,
        edits=lambda wildcards: list_edited(wildcards.design),
        library=code_inputs("whole_loop"),
    output:
        **FINAL,
        classes=CLASSES["json"],
        class_arrays=CLASSES["arrays"],
    log:
        log_of("size"),
    benchmark:
        timing("size")
    conda:
        "../envs/foldshell.yaml"
    threads: threads_of
    resources:
        **needs_of("analyse", SETTINGS.sizing.iterations_max),
    params:
        scripts=SCRIPTS,
        jobs=given(LOOP_PARAMS),
    message:
        "{wildcards.design}: whole thickness loop"
    script:
        "../scripts/whole_loop.py"
