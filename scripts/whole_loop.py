"""Rule size of `loop: whole`: the thickness loop of a design in one job, by the same files."""

from collections.abc import Mapping, Sequence

from foldshell.engine.whole_loop import LoopPlan, run_whole_loop
from foldshell.files.errors import user_errors
from foldshell.settings.stage import Plain


def main(
    folder: str,
    mesh: str,
    code: Mapping[str, str],
    *,
    design: str,
    scripts: str,
    jobs: Mapping[str, Plain],
    folded: Sequence[str] = (),
) -> None:
    """Leave the same files in `folder` (sizing/) as the rules of the loop do, one by one.

    `code` are the lists of their library files, `jobs` their parameters, `scripts` the folder of
    their scripts; `folded` names folded.npz where panels are no grid.
    """
    run_whole_loop(LoopPlan(design, folder, mesh, code, jobs, tuple(folded)), scripts)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.output.final.rpartition("/")[0],  # noqa: F821
            snakemake.input.mesh,  # noqa: F821
            {name: snakemake.input[f"code_{name}"] for name in snakemake.params.jobs},  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
