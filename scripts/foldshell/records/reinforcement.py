"""What engineering.json says of the reinforcement of a design."""

from dataclasses import dataclass

from foldshell.records.entry import COUNT, entry


@dataclass(frozen=True, kw_only=True)
class BarsRecord:
    """Bars of one layer and direction in one class of thickness."""

    thickness_m: float = entry("thickness of the class", "m")
    panels: int = entry("panels of the class with this layer", COUNT)
    layer: str = entry("bottom, top, or middle where there is one mesh")
    direction: str = entry("x along the first border of a panel, y across it")
    diameter_mm: float = entry("diameter", "mm")
    spacing_mm: float | None = entry("spacing; null for a grid that is bought as needed", "mm")
    area_cm2_m: float = entry("steel that this gives", "cm2/m")
    mass_kg: float = entry("mass in all panels of the class", "kg")
    use: float = entry("largest need in the class over what is given", "-")


@dataclass(frozen=True, kw_only=True)
class ReinforcementRecord:
    """Steel and concrete of a design; the key `reinforcement` of engineering.json."""

    kind: str = entry("bars, central_mesh or textile")
    steel_kg_m2: float = entry("reinforcement with least steel over the area of the sheet", "kg/m2")
    steel_kg_m3: float = entry("the same over the volume of concrete", "kg/m3")
    steel_needed_kg_m2: float = entry("without least steel", "kg/m2")
    steel_kg: float = entry("mass of reinforcement", "kg")
    steel_bars_kg: float = entry("mass by the bars of the schedule, one set for each class", "kg")
    concrete_m3: float = entry("volume of concrete", "m3")
    creases_m: float = entry("length of folds between panels", "m")
    two_layers_share: float = entry("panels in which two layers of bars fit", "-")
    governing_share: dict[str, float] = entry("panels in which each check is used most", "-")
    over_one_share: dict[str, float] = entry("panels in which each check is not met", "-")
    co2_kg: float = entry("greenhouse gases of making concrete, steel and folds", "kg")
    co2_low_kg: float = entry("the same at the lower end of the factors", "kg")
    co2_high_kg: float = entry("the same at the upper end of the factors", "kg")
    cost: float | None = entry("cost by the prices of the settings; null without any")
    cost_low: float | None = entry("lower end of the cost")
    cost_high: float | None = entry("upper end of the cost")
    bars: tuple[BarsRecord, ...] = entry("schedule of bars by class of thickness")
