"""Rule kinematics: what a Miura sheet can do, and how the paper's geometric rules fold it."""

import math
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.kinematics.figure import draw_kinematics
from foldshell.kinematics.geometric_rules import tabulate_differences
from foldshell.kinematics.study import SWEEPS, Sweeps, study_sheets, sweep_surfaces, tabulate_ratios
from foldshell.kinematics.trajectory_figure import draw_trajectories
from foldshell.records.files import write_record
from foldshell.records.kinematics import KinematicsRecord, RuleDifference
from foldshell.records.table import write_rows


def main(
    table_path: str | Path,
    rules_path: str | Path,
    figure_path: str | Path,
    trajectories_path: str | Path,
    *,
    sector_angle_deg: float,
    densities: tuple[tuple[int, int], ...] = ((7, 8), (9, 10), (11, 12)),
    sweeps: Sweeps = SWEEPS,
) -> None:
    """Write the table of everything, the rules' differences to the closed form, two pictures.

    `ratios`: Poisson's ratios; `sheets`: mechanisms, isometry residuals and soft modes by
    density; `force_ratios`: the sweep of force strengths of claim C3; `geometric_rules`: Fig. 1
    of the paper against the closed form.
    """
    gamma = math.radians(sector_angle_deg)
    differences = tabulate_differences(gamma)
    table = KinematicsRecord(
        sector_angle_deg=sector_angle_deg,
        ratios=tabulate_ratios(gamma),
        sheets=study_sheets(gamma, densities),
        force_ratios=sweep_surfaces(gamma, sweeps),
        geometric_rules=tuple(differences),
    )
    draw_kinematics(figure_path, table)
    draw_trajectories(trajectories_path, gamma, differences)
    write_rows(rules_path, RuleDifference, differences)
    write_record(table_path, table)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.table,  # noqa: F821
            snakemake.output.rules,  # noqa: F821
            snakemake.output.figure,  # noqa: F821
            snakemake.output.trajectories,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
