"""What the calculation sheet of a design is made of, read from its files."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.records.analysis import read_analysis
from foldshell.records.comparison import read_comparison
from foldshell.records.files import read_record
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.report.checks import read_checks
from foldshell.report.engineering import read_verdict
from foldshell.report.sheet import SheetFiles
from foldshell.results.design_view import DesignView, view_design
from foldshell.results.reactions import find_reactions
from foldshell.results.state import read_state
from foldshell.settings.design import Design
from foldshell.settings.stage import StageSettings


def read_sheet(
    paths: Mapping[str, str | Path], design: Design, settings: StageSettings
) -> tuple[SheetFiles, DesignView]:
    """Return the contents of the sheet and the view of the design's final state.

    `paths` are mesh, folded, arrays (npz), final, comparison and mesh_convergence (json).
    """
    state_paths = [paths[key] for key in ("mesh", "folded", "arrays", "final")]
    state = read_state(design.name, *state_paths, settings.combinations)
    final = read_analysis(paths["final"])
    convergence = read_record(paths["mesh_convergence"], MeshConvergenceRecord)
    checks = read_checks(final, paths)
    view = view_design(state, settings, design.span, design.pattern)
    comparison, reactions = read_comparison(paths["comparison"]), find_reactions(view, settings)
    engineering = read_verdict(paths.get("engineering"))
    files = SheetFiles(design, final, comparison, convergence, checks, reactions, engineering)
    return files, view
