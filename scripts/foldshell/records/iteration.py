"""Both files of an analysis, and both of the grouped design."""

from pathlib import Path

from foldshell.records.analysis import AnalysisRecord, read_analysis, write_analysis
from foldshell.records.analysis_arrays import AnalysisArrays, ClassesArrays
from foldshell.records.arrays import read_typed_arrays, write_typed_arrays
from foldshell.records.classes import ClassesRecord
from foldshell.records.files import read_record, write_record


def read_iteration(
    json_path: str | Path, arrays_path: str | Path | None = None
) -> tuple[AnalysisRecord, AnalysisArrays]:
    """Read analysis.json and analysis.npz, which by default stands beside it.

    Raises `InputError` for a file that is missing or damaged.
    """
    arrays_path = arrays_path or Path(json_path).with_suffix(".npz")
    return read_analysis(json_path), read_typed_arrays(arrays_path, AnalysisArrays)


def write_iteration(
    json_path: str | Path, arrays_path: str | Path, record: AnalysisRecord, arrays: AnalysisArrays
) -> None:
    """Write analysis.npz, then analysis.json, which others wait for."""
    write_typed_arrays(arrays_path, arrays)
    write_analysis(json_path, record)


def read_classes(
    json_path: str | Path, arrays_path: str | Path
) -> tuple[ClassesRecord, ClassesArrays]:
    """Read classes.json and classes.npz; raises `InputError` as `read_iteration`."""
    return read_record(json_path, ClassesRecord), read_typed_arrays(arrays_path, ClassesArrays)


def write_classes(
    json_path: str | Path, arrays_path: str | Path, record: ClassesRecord, arrays: ClassesArrays
) -> None:
    """Write classes.npz, then classes.json."""
    write_typed_arrays(arrays_path, arrays)
    write_record(json_path, record)
