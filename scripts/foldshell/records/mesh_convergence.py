"""mesh_convergence.json and primary.json: a state on the mesh in use and on a reference mesh."""

from dataclasses import dataclass

from foldshell.records.entry import COUNT, entry

Pair = tuple[float, float]
Vectors = tuple[tuple[float, float, float], tuple[float, float, float]]
BOTH = "on the mesh in use and on the reference mesh"


@dataclass(frozen=True, kw_only=True)
class ReferenceMesh:
    """What the reference mesh changes in the mesh in use."""

    order: int | None = entry("its element order", COUNT, left_out=True)
    subdivisions: int | None = entry("its subdivisions", COUNT, left_out=True)
    panel_parts: int | None = entry(
        "quads along the side of a smooth panel, on the surface itself", COUNT, left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class MeshQuantities:
    """Quantities of one combination, each on both meshes."""

    displacement_down_max_m: Pair = entry(f"largest downward displacement, {BOTH}", "m")
    displacement_max_m: Pair = entry(f"largest displacement, {BOTH}", "m")
    work_knm: Pair = entry(f"work of the loads, twice the energy, {BOTH}", "kNm")
    utilization_p99: Pair = entry(f"utilization that 99 % of the area keeps, {BOTH}", "-")
    utilization_panel_mean_max: Pair = entry(f"largest mean utilization of a panel, {BOTH}", "-")
    reaction_sum_kn: Vectors = entry(f"sum of the reactions, {BOTH}", "kN")
    support_reactions_kn: dict[str, Vectors] = entry(
        f"reactions of each supported edge, {BOTH}", "kN"
    )
    load_sum_kn: Vectors = entry(f"sum of the loads, {BOTH}", "kN")


@dataclass(frozen=True, kw_only=True)
class CombinationStudy(MeshQuantities):
    """Quantities of first order, the buckling factor, and those of second order."""

    buckling_factor: Pair | None = entry(f"buckling factor, {BOTH}", "-", left_out=True)
    second_order: MeshQuantities | None = entry(
        "the same to second order, where the structure does not buckle", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class LaidRecord:
    """What lies in a sheet, for a code that designs its steel itself."""

    level_m: float = entry("from a face to the middle of crossing bars", "m")
    two_layers_from_m: float | None = entry(
        "thickness from which there are two layers; null for one mesh everywhere", "m"
    )
    central_lever_ratio: float = entry("lever of one mesh over the thickness", "-")
    yield_kpa: float = entry("design strength of the reinforcement", "kPa")
    crush_kpa: float = entry("design strength of the concrete", "kPa")
    density_kg_m3: float = entry("density of the reinforcement", "kg/m3")
    strip_m: float = entry("width of strips for steel and struts", "m")
    shear_strip_m: float = entry("width of strips for shear", "m")
    diagonals: bool = entry("whether strips along diagonals inside panels count")


@dataclass(frozen=True, kw_only=True)
class ReinforcementStudy:
    """Reinforcement of the compared strength combinations together, of first order."""

    combinations: tuple[str, ...] = entry("combinations that the steel is designed for")
    laid: LaidRecord = entry("what lies in the sheet")
    quantities: dict[str, Pair] = entry(
        "steel_kg_m2 (without least steel), steel_max_kn_m (largest of one layer and direction), "
        "moment_max_knm_m and shear_max_kn_m (largest mean of a facet or strip), shear_over_share "
        "(panels above v_Rd,c) and use_* (largest shares of what is allowed), each on both meshes"
    )


@dataclass(frozen=True, kw_only=True)
class MeshStudy:
    """The contents of primary.json, which the independent code compares with."""

    subdivisions: tuple[int, int] = entry(
        "subdivisions in use, and those that the reference mesh counts for", COUNT
    )
    reference: ReferenceMesh = entry("how the reference mesh differs")
    combinations: dict[str, CombinationStudy] = entry("quantities by combination")
    reason: str | None = entry("why a mechanism has none", left_out=True)
    reinforcement: ReinforcementStudy | None = entry(
        "steel, struts, moments and shear; left out where nothing is reinforced", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class ThirdMesh:
    """What a third mesh says of the order at which values settle; on one design of each family."""

    mesh: ReferenceMesh = entry("how it differs from the mesh in use")
    subdivisions: float = entry("subdivisions that it counts for", "-")
    values: dict[str, dict[str, float]] = entry("quantities of first order by combination", "-")
    observed_order: dict[str, dict[str, float | None]] = entry(
        "order that fits the three meshes; null where the values turn back or jump", "-"
    )
    not_asymptotic: bool = entry(
        "whether some value turns back, or nears its limit slower than the element size, by more "
        "than 1 %: its mesh error means little"
    )
    doubtful: tuple[str, ...] = entry("which, with values from coarse to fine")


@dataclass(frozen=True, kw_only=True)
class MeshConvergenceRecord:
    """The contents of mesh_convergence.json."""

    mesh_error: float | None = entry(
        "largest relative error on the mesh in use, buckling factors left out",
        "-", form="percent", shown="%",
    )  # fmt: skip
    buckling_mesh_error: float | None = entry(
        "largest relative error of a buckling factor on the mesh in use",
        "-",
        form="percent",
        shown="%",
    )
    subdivisions: int = entry("subdivisions of the mesh in use", COUNT)
    errors: dict[str, dict[str, float]] = entry(
        "relative error of each quantity by combination", "-"
    )
    study: MeshStudy = entry("the values that the errors are made of")
    reinforcement_errors: dict[str, float] | None = entry(
        "relative error of each quantity of the reinforcement; apart, since shear settles later",
        "-", left_out=True,
    )  # fmt: skip
    third: ThirdMesh | None = entry("a third mesh, on one design of each family", left_out=True)
