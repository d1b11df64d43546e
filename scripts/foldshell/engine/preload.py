"""What the fork server imports before it is asked for a script, and which forks stay."""

# fmt: off
MODULES = [
    "snakemake.script", "pattern", "fold", "mesh", "start", "analyse", "resize", "xlsxwriter",
    "foldshell.shell.warm_up", "cvxopt.amd", "group", "size", "neutral_model",
    "mesh_convergence", "compare", "crosscheck.verdict", "crosscheck.workbook", "draw",
    "meshio", "check", "reinforcement", "design_workbook", "page", "sheet",
    "foldshell.report.warm_up", "vtkmodules.vtkRenderingOpenGL2", "vtkmodules.util.numpy_support",
    "ezdxf", "sensitivity", "flat_equal", "summary", "timings", "report_pages", "report",
    "all_designs",
    "study_figures", "manifest",
    "matplotlib.backends.backend_agg", "matplotlib.backends.backend_svg",
]
# fmt: on
"""In the order in which they are needed: scripts, and what they import only where they use it."""

_SHELL = "pattern", "fold", "mesh", "start", "analyse", "resize", "group", "size"
POOLS = dict.fromkeys(_SHELL, "shell") | {"draw": "pictures"}
"""Rules whose process stays for the next job of a pool. Jobs of a design follow each other: the
next analysis finds the mesh's operators, the order of elimination and memory there, a quarter of
its time, and a short job memory that is its own already. Pictures find the renderer set up."""
