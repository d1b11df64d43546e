"""How far the quantities of a state are from those that a finer mesh would give."""

from collections.abc import Mapping

from foldshell.records.mesh_convergence import MeshConvergenceRecord, MeshStudy

ORDER = 2.0
"""Rate at which the error is taken to fall from the mesh in use to the reference mesh."""

QUANTITIES = (
    "displacement_down_max_m",
    "displacement_max_m",
    "work_knm",
    "utilization_p99",
    "utilization_panel_mean_max",
)

FACTOR = "buckling_factor"
"""Its mesh error is reported apart: modes inside slender panels settle later than all else."""


def extrapolate(coarse: float, fine: float, ratio: float, order: float = ORDER) -> float:
    """Return the Richardson limit fine + (fine - coarse) / (ratio^order - 1)."""
    return fine + (fine - coarse) / (ratio**order - 1)


def make_record(study: MeshStudy) -> MeshConvergenceRecord:
    """Return the contents of mesh_convergence.json."""
    errors = estimate_errors(study)
    return MeshConvergenceRecord(
        **find_largest_errors(errors),
        subdivisions=study.subdivisions[0],
        errors=errors,
        study=study,
        reinforcement_errors=estimate_reinforcement_errors(study),
    )


def estimate_errors(study: MeshStudy) -> dict[str, dict[str, float]]:
    """Return the relative error of each quantity on the mesh in use, {combination: {quantity}}."""
    coarse, fine = study.subdivisions
    found: dict[str, dict[str, float]] = {}
    for name, values in study.combinations.items():
        pairs = {quantity: getattr(values, quantity) for quantity in (*QUANTITIES, FACTOR)}
        found[name] = {
            quantity: _relative(pair[0], extrapolate(*pair, fine / coarse))
            for quantity, pair in pairs.items()
            if pair is not None
        }
    return found


def estimate_reinforcement_errors(study: MeshStudy) -> dict[str, float] | None:
    """Return the relative error of each quantity of the reinforcement, None without any."""
    if study.reinforcement is None:
        return None
    coarse, fine = study.subdivisions
    return {
        name: _relative(pair[0], extrapolate(*pair, fine / coarse))
        for name, pair in study.reinforcement.quantities.items()
    }


def find_largest_errors(errors: Mapping[str, Mapping[str, float]]) -> dict[str, float | None]:
    """Return `mesh_error`, the largest but for buckling, and `buckling_mesh_error`."""
    found = [(name == FACTOR, error) for one in errors.values() for name, error in one.items()]
    return {
        key: max((error for buckles, error in found if buckles == wanted), default=None)
        for key, wanted in (("mesh_error", False), ("buckling_mesh_error", True))
    }


def _relative(value: float, limit: float) -> float:
    return abs(value - limit) / abs(limit) if limit else 0.0
