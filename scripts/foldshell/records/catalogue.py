"""Every result file with its record."""

from dataclasses import dataclass

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import (
    AnalysisArrays,
    ClassesArrays,
    IterationsArrays,
    StepMemory,
)
from foldshell.records.claims import ClaimRecord
from foldshell.records.classes import ClassesRecord
from foldshell.records.comparison import ComparisonRecord
from foldshell.records.engineering import EngineeringArrays, EngineeringRecord
from foldshell.records.history import HistoryRow
from foldshell.records.kinematics import KinematicsRecord
from foldshell.records.measures import FlatEqualRecord, SensitivityRow, VariantRecord
from foldshell.records.mesh_convergence import MeshConvergenceRecord, MeshStudy
from foldshell.records.quality import QualityRecord
from foldshell.records.reinforced_claims import ReinforcedClaim, ReinforcedRecord
from foldshell.records.sheet_arrays import FoldedArrays, MeshArrays
from foldshell.records.summary import SummaryRow
from foldshell.records.timings import TimingRow
from foldshell.records.written import WrittenRecord


@dataclass(frozen=True)
class ResultFile:
    """A file below results/, its record, and what one record is of; `name` names its schema."""

    name: str
    path: str
    kind: type
    meaning: str
    many: bool = False


DESIGN = "<design>"
LOOP = f"{DESIGN}/sizing"
FILES = (
    ResultFile("quality", f"{DESIGN}/folded/quality.json", QualityRecord,
               "what folding the sheet came to"),
    ResultFile("analysis", f"{LOOP}/NN/analysis.json", AnalysisRecord,
               "one analysis of the sizing loop"),
    ResultFile("written", f"{LOOP}/NN/written.json", WrittenRecord,
               "what the workflow wrote into thickness.xlsx"),
    ResultFile("final", f"{LOOP}/final.json", AnalysisRecord, "the last analysis of the loop"),
    ResultFile("history", f"{LOOP}/history.csv", HistoryRow, "one row per iteration", True),
    ResultFile("classes", f"{LOOP}/classes.json", ClassesRecord,
               "the design in a few thickness classes"),
    ResultFile("mesh_convergence", f"{DESIGN}/mesh_convergence.json", MeshConvergenceRecord,
               "how far the mesh in use is from its limit"),
    ResultFile("primary", f"{DESIGN}/crosscheck/primary.json", MeshStudy,
               "what the independent code compares with"),
    ResultFile("comparison", f"{DESIGN}/crosscheck/comparison.json", ComparisonRecord,
               "both codes side by side; written by the independent code"),
    ResultFile("engineering", f"{DESIGN}/checks/engineering.json", EngineeringRecord,
               "the engineering verdict on the final state"),
    ResultFile("flat_equal", f"{DESIGN}/flat_equal.json", FlatEqualRecord,
               "the flat sheet with the same volume"),
    ResultFile("variant", "sensitivity/<variant>/<design>.json", VariantRecord,
               "a loop in memory under another setting"),
    ResultFile("kinematics", "kinematics.json", KinematicsRecord, "what a Miura sheet can do"),
    ResultFile("summary", "summary.csv", SummaryRow, "one row per design", True),
    ResultFile("claims", "claims.json", ClaimRecord, "one entry per claim", True),
    ResultFile("reinforced", "sensitivity/reinforced/<design>.json", ReinforcedRecord,
               "a loop in memory that sizes a design as reinforced concrete"),
    ResultFile("claims_reinforced", "claims_reinforced.json", ReinforcedClaim,
               "one entry per claim, on designs that stand as reinforced concrete", True),
    ResultFile("sensitivity", "sensitivity.csv", SensitivityRow,
               "one row per design and variant", True),
    ResultFile("timings", "timings.csv", TimingRow, "one row per rule, the longest first", True),
)  # fmt: skip
ARRAYS = (
    ResultFile("folded", f"{DESIGN}/folded/folded.npz", FoldedArrays, "the folded sheet"),
    ResultFile("mesh", f"{DESIGN}/shell/mesh.npz", MeshArrays, "the shell mesh and its supports"),
    ResultFile("analysis", f"{LOOP}/NN/analysis.npz, {LOOP}/final.npz", AnalysisArrays,
               "arrays of an analysis"),
    ResultFile("memory", f"{LOOP}/NN/memory.npz", StepMemory, "what a step leaves to the next"),
    ResultFile("iterations", f"{LOOP}/iterations.npz", IterationsArrays,
               "panels in each iteration"),
    ResultFile("classes", f"{LOOP}/classes.npz", ClassesArrays, "arrays of the grouped design"),
    ResultFile("engineering", f"{DESIGN}/checks/engineering.npz", EngineeringArrays,
               "forces and reactions under the combinations of the engineering verdict"),
)  # fmt: skip
