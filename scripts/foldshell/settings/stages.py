"""What each stage of a design depends on: plain values for Snakemake's `params`, and hashes."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from foldshell.files.whole import hash_data
from foldshell.settings.designs import Design
from foldshell.settings.options import Settings

_CRITERIA = [
    "sizing.measure",
    "sizing.least_thickness",
    "sizing.largest_thickness",
    "sizing.utilization_min",
    "sizing.utilization_max",
    "sizing.displacement_limit_span_over",
    "sizing.volume_change_max",
    "sizing.volume_change_max_relative",
    "sizing.iterations_max",
    "sizing.stop",
    "sizing.rule",
    "sizing.thinning_buckling_factor_min",
]
_ANALYSIS = [
    "analysis.second_order",
    "analysis.second_order_tolerance",
    "analysis.second_order_iterations_max",
    "analysis.solver",
    "analysis.imperfection",
]
_STRENGTH = [
    "material",
    "loads.superimposed_dead",
    "loads.live",
    "loads.wind",
    "loads.wind_fraction",
    "loads.area_basis",
    "combinations",
]
_BOUNDS = ["sizing.least_thickness", "sizing.largest_thickness"]
STAGES: dict[str, list[str]] = {
    "pattern": ["pattern"],
    "fold": ["pattern", "fold"],
    "mesh": ["analysis.subdivisions"],
    "start": ["sizing.start_thickness", *_BOUNDS],
    "analyse": [*_STRENGTH, *_ANALYSIS, *_CRITERIA],
    "resize": ["sizing"],
    "size": [*_STRENGTH, *_ANALYSIS, "sizing"],
    "crosscheck": [*_STRENGTH, "crosscheck"],
    "figures": ["figures"],
    "drawings": ["drawings"],
    "exports": ["exports"],
    "study": ["pattern", "fold", *_STRENGTH, "analysis", "sizing", "crosscheck"],
}

FINAL_STATE = ("shell/mesh.npz", "folded/folded.npz", "sizing/final.npz", "sizing/final.json")
"""The files in a design's folder that hold its final state, as figures over all designs read it."""


def stage_parameters(
    settings: Settings, stage: str, design: Design | None = None
) -> dict[str, dict[str, Any]]:
    """Return the plain values {group: {field: value}} that one stage depends on, and no others.

    As Snakemake `params` they make a rule run again only when a setting that it needs has
    changed. A whole group goes back to its class by `Material(**values["material"])`. A design
    with the tag `demo` gets the demo's subdivisions.
    """
    plain = asdict(settings)
    if design is not None:
        plain["analysis"]["subdivisions"] = choose_subdivisions(settings, design)
    chosen: dict[str, dict[str, Any]] = {}
    for name in STAGES[stage]:
        group, _, field = name.partition(".")
        values = {field: plain[group][field]} if field else plain[group]
        chosen.setdefault(group, {}).update(values)
    return chosen


def choose_subdivisions(settings: Settings, design: Design) -> int:
    """Return the refinement of a design's facets: a design tagged `demo` has its own."""
    demo = "demo" in design.tags
    return settings.analysis.subdivisions_demo if demo else settings.analysis.subdivisions


def settings_hash(values: Settings | Mapping[str, Any]) -> str:
    """Return 12 hexadecimal digits of the SHA-256 of settings that change results.

    `values` is either the whole settings (then the path of the table and the pictures do not
    count) or a stage's plain parameters.
    """
    plain = stage_parameters(values, "study") if isinstance(values, Settings) else values
    return hash_data(plain)[:12]
