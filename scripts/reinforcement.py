"""Rule reinforcement: the picture of the steel in each layer and direction."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.figures.reinforcement_figure import draw_reinforcement
from foldshell.files.whole import atomic_path
from foldshell.records.arrays import read_typed_arrays
from foldshell.records.engineering import EngineeringRecord
from foldshell.records.files import read_record
from foldshell.records.sheet_arrays import MeshArrays


def main(record: str | Path, mesh: str | Path, picture: str | Path) -> None:
    """Draw what engineering.json says of reinforcement on the facets of mesh.npz."""
    figure = draw_reinforcement(
        read_record(record, EngineeringRecord), read_typed_arrays(mesh, MeshArrays)
    )
    with atomic_path(picture) as temporary:
        figure.savefig(temporary, format="png", dpi=120, metadata={"Software": None})


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.record,  # noqa: F821
            snakemake.input.mesh,  # noqa: F821
            snakemake.output.picture,  # noqa: F821
        )
