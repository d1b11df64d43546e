"""A roof whose search has ended, written by hand: 100 m3 of the table, 50 found, 60 smooth."""

from foldshell.files.whole import write_json
from foldshell.records.rivals import JudgedRow, ResizedRow
from foldshell.records.table import write_rows

HEADER = (
    "candidate", "pattern", "zigzag", "strip", "volume_m3", "area_m2", "panels", "crease_length_m",
    "buckling_factor_min", "plan_coverage", "edge_strain_max", "planarity_max", "depth_m", "state",
    "feasible",
)  # fmt: skip
ROWS = (
    ("00-00", "miura", 15, 16, 100.0, 1400, 210, 900, 5.0, 0.98, 0.02, 0.03, 2.0, "sized", False),
    ("00-01", "smooth", 15, 16, 60.0, 900, 210, 0, 4.0, 1.0, "", 0.0, 0.0, "sized", False),
    ("00-02", "miura", 8, 32, 110.0, 1500, 90, 900, 5.0, 0.98, 0.02, 0.03, 2.0, "sized", False),
    ("01-00", "miura", 9, 16, 50.0, 1240, 120, 500, 6.0, 0.95, 0.02, 0.03, 0.7, "sized", True),
    ("01-01", "miura", 9, 17, 55.0, 1000, 130, 520, 9.0, 0.95, 0.02, 0.03, 0.7, "sized", True),
    ("01-02", "miura", 9, 18, 56.0, 1000, 80, 540, 8.0, 0.95, 0.02, 0.03, 0.7, "sized", True),
    ("01-03", "miura", 9, 19, 40.0, 1000, 150, 560, 2.0, 0.95, 0.02, 0.03, 0.7, "sized", False),
    ("01-04", "miura", 9, 20, "", "", "", "", "", "", "", "", "", "crumpled", False),
)  # fmt: skip
ABOUT = {
    "exploration": {
        "name": "roof",
        "base": {"surface": "arch", "support": "strip", "span_m": 28.0, "height_m": 10.0,
                 "fold_mode": "elastic"},
        "variables": [["rest_fold_angle_deg", 30.0, 62.0, False, []]],
        "aims": ["volume_m3"],
        "limits": {"plan_coverage_min": 0.946, "edge_strain_max": 0.05, "depth_min_m": 0.5,
                   "depth_max_m": 4.0, "buckling_factor_min": 4.0},
        "search": {"rule": "dead_band", "subdivisions": 2, "method": "sobol", "seed": 3},
    },
    "bounds": [["rest_fold_angle_deg", 30.0]],
    "least_thickness_m": 0.04,
}  # fmt: skip
VOLUMES = {"found": (50.0, 52.0, 80.0), "table": (98.0, 99.0, 101.0), "smooth": (58.0, 66.0, 70.0)}
NAMES = {"found": "01-00", "table": "00-00", "smooth": "00-01"}


def make_judged(kind, volume, **changed):
    """Return a shell by the ordinary rules."""
    given = {
        "design": f"roof-{NAMES[kind]}", "kind": kind, "state": "converged", "volume_m3": volume,
        "volume_per_area_m": 0.0401, "buckling_factor_min": 6.0, "mesh_subdivisions": 4,
        "displacement_vertical_max_m": 0.05, "mesh_error": 0.02, "crosscheck": "pass",
        "engineering": "fails", "failed": "reinforced_fit, reinforced_shear",
        "stability": 5.0, "stability_due": 6.0, "displacement_long_term_m": 0.1,
        "displacement_due_m": 0.117, "shear_share": 0.25, "steel_kg_m2": 20.0,
        "steel_kg": 400 * volume, "co2_kg": 500 * volume, "co2_low_kg": 400 * volume,
        "co2_high_kg": 600 * volume,
    }  # fmt: skip
    return JudgedRow(**(given | changed))


def write_roof(home):
    """Write explore.tsv and what stands beside it; return the path of the table."""
    (home / "rivals").mkdir(parents=True)
    lines = ["\t".join(map(str, row)) for row in (HEADER, *ROWS)]
    (home / "explore.tsv").write_text("\n".join(lines) + "\n")
    (home / "selected.tsv").write_text("design\ttags\nroof-01-00\tfound\nroof-01-01\tfound\n")
    resized = [
        ResizedRow(candidate=NAMES[kind], kind=kind, factor_due=factor, volume_m3=volume,
                   state="sized", buckling_factor_min=factor, iterations=9)
        for kind, volumes in VOLUMES.items()
        for factor, volume in zip((4.0, 6.0, 12.0), volumes, strict=True)
    ]  # fmt: skip
    write_rows(home / "rivals/resized.csv", ResizedRow, resized)
    for measure, more in (("paper", 1.0), ("reinforced", 2.0)):
        rows = [make_judged(kind, more * volumes[0]) for kind, volumes in VOLUMES.items()]
        write_rows(home / f"rivals/{measure}.csv", JudgedRow, rows)
    write_json(home / "rivals/about.json", ABOUT)
    return home / "explore.tsv"
