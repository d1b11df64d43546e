"""Snakemake's own processor time for a study of many designs, whose jobs only touch their files."""

import ast
import csv
import json
import subprocess
import sys
from pathlib import Path

WORKFLOW = Path(__file__).parents[1] / "workflow"
sys.path.insert(0, str(WORKFLOW))

from study_runner import HEADER, REPOSITORY, copy_code, make_study  # noqa: E402

STUB = '''"""Touch the outputs of a job; an analysis says whether the loop goes on."""
import json, pathlib
for name in snakemake.output:
    path = pathlib.Path(str(name))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
verdict = "continue"
if snakemake.rule == "analyse" and int(snakemake.wildcards.iteration) + 1 >= {iterations}:
    verdict = "converged"
if snakemake.rule == "analyse":
    path = pathlib.Path(str(snakemake.output.json))
    path.write_text(json.dumps({{"verdict": verdict}}))
'''
MEASURED = """
import json, resource, sys, time
from snakemake.cli import main
begun = time.time()
code = 1
try:
    main(sys.argv[2:])
except SystemExit as end:
    code = end.code or 0
used = resource.getrusage(resource.RUSAGE_SELF)
record = {"code": code, "cpu_s": used.ru_utime + used.ru_stime, "wall_s": time.time() - begun,
          "rss_mb": used.ru_maxrss / 1024}
open(sys.argv[1], "w").write(json.dumps(record))
"""


def make_stub_code(folder: Path, iterations: int) -> Path:
    """Copy the workflow with scripts that only touch their outputs; return the folder.

    Each loop has so many analyses.
    """
    code = copy_code(folder)
    stub = STUB.format(iterations=iterations)
    for script in (code / "scripts").glob("*.py"):
        body = ast.parse(script.read_text()).body
        imports = [ast.unparse(node) for node in body if isinstance(node, ast.ImportFrom)]
        unused = "".join(f"    {line}\n" for line in imports)
        script.write_text(f"{stub}def of_the_script():\n    pass\n{unused}")
    return code


def make_stub_study(folder: Path, count: int, settings: dict | None = None) -> Path:
    """Write config/ of a study of `count` small designs; return the folder."""
    rows = "".join(f"s{number:04d}\tparaboloid\t5\t2\t9\t8\tall\ttiny\n" for number in range(count))
    return make_study(folder, rows, settings)


def measure(code: Path, folder: Path, *arguments: str) -> dict[str, float]:
    """Run Snakemake in a folder; return its own processor and wall time (s), memory (MB), code."""
    record = folder / "measured.json"
    log = folder / "run.log"
    program = [sys.executable, "-c", MEASURED, str(record), "-s", str(code / "Snakefile")]
    profile = ["--workflow-profile", str(code / "profiles/default"), "--cores", "2"]
    with log.open("w") as stream:
        subprocess.run(
            [*program, *profile, *arguments], cwd=folder, stdout=stream, stderr=stream, check=True
        )
    return json.loads(record.read_text())


def job_seconds(results: Path) -> tuple[int, float]:
    """Return the number of benchmarks of jobs under a folder of results, and their processor
    time (s)."""
    total, count = 0.0, 0
    for path in results.glob("benchmarks/*/*.tsv"):
        with path.open() as stream:
            row = next(csv.DictReader(stream, delimiter="\t"))
        total, count = total + float(row["cpu_time"]), count + 1
    return count, total


__all__ = ["HEADER", "REPOSITORY", "job_seconds", "make_stub_code", "make_stub_study", "measure"]
