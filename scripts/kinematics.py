"""Rule kinematics: what a Miura sheet can do, as numbers for claims C1, C2, C3 and C14."""

import math
from pathlib import Path

from foldshell.files.errors import user_errors
from foldshell.files.whole import write_json
from foldshell.folding.settings import FoldSettings
from foldshell.kinematics.figure import draw_kinematics
from foldshell.kinematics.study import study_force_ratios, study_sheet, tabulate_ratios


def main(
    table_path: str | Path,
    *,
    sector_angle_deg: float = 60.0,
    densities: tuple[tuple[int, int], ...] = ((7, 8), (9, 10), (11, 12)),
    span_m: float = 28.0,
    height_m: float = 10.0,
    attractions: tuple[float, ...] = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0),
    panel_force_ratios: tuple[float, ...] = (1e-4, 1e-2, 1.0, 100.0),
    explicit_attractions: tuple[float, ...] = (0.01, 1.0, 100.0),
    explicit_panel_force_ratios: tuple[float, ...] = (1e-2, 1.0),
    figure_path: str | Path | None = None,
) -> None:
    """Write kinematics.json and, with `figure_path`, a picture of it.

    `ratios`: Poisson's ratios; `sheets`: mechanisms, isometry residuals and soft modes by
    density; `force_ratios`: the sweep of force strengths of claim C3, with fewer of them by the
    explicit engine, which is stopped after 500 iterations.
    """
    gamma = math.radians(sector_angle_deg)
    implicit = attractions, panel_force_ratios, FoldSettings()
    explicit = FoldSettings(engine="averaged_projections", max_iterations=10)
    sweeps = implicit, (explicit_attractions, explicit_panel_force_ratios, explicit)
    table = {
        "sector_angle_deg": sector_angle_deg,
        "ratios": tabulate_ratios(gamma),
        "sheets": [study_sheet(gamma, *density) for density in densities],
        "force_ratios": [
            row for sweep in sweeps for row in study_force_ratios(span_m, height_m, gamma, *sweep)
        ],
    }
    if figure_path:
        draw_kinematics(figure_path, table)
    write_json(table_path, table)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.output.table,  # noqa: F821
            figure_path=snakemake.output.get("figure"),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
