"""Reinforcement of concrete shells, and what concrete, steel and creases emit and cost; kPa, m."""

from foldshell.settings.field import Group, setting, settings_group

KINDS = ("bars", "central_mesh", "textile", "none")
USES = ("strut", "ratio", "shear", "fit")
EXPOSURES = ("X0", "XC1", "XC2", "XC3", "XC4", "XD1", "XD2", "XD3", "XS1", "XS2", "XS3")
CLASSES = ("S1", "S2", "S3", "S4", "S5", "S6")
_EC2 = "EN 1992-1-1"


@settings_group
class Textile(Group):
    """Grids of carbon, used where reinforcement.kind is textile.

    Assumptions, not a code: strengths of grids are those of their approvals and differ by more
    than a factor of two. They hold no fire and do not yield.
    """

    strength: float = setting(
        1000, unit="MPa", above=0, maximum=10000,
        meaning="Design strength. An assumption, of the order of design values in approvals for "
        "impregnated carbon grids; take that of the grid's own approval.",
    )  # fmt: skip
    youngs_modulus: float = setting(
        200, unit="GPa", above=0, maximum=1000,
        meaning="Young's modulus, an assumption as well (carbon yarn in a grid).",
    )  # fmt: skip
    cover: float = setting(
        10, unit="mm", above=0, maximum=200,
        meaning="Cover: bond and casting, no corrosion (10 mm of concrete are its custom).",
    )  # fmt: skip
    diameter: float = setting(
        2, unit="mm", above=0, maximum=50, meaning="Depth of the yarns of one direction."
    )
    density: float = setting(
        1800, unit="kg/m3", above=0, maximum=20000, meaning="Density of the grid."
    )


@settings_group
class Reinforcement(Group):
    """Reinforced concrete by EN 1992-1-1:2004, for the engineering verdict and sizing.measure
    reinforced."""

    kind: str = setting(
        "bars", choices=KINDS,
        meaning="Bars in two layers and, where these do not fit, one mesh in the middle; "
        "(central_mesh) that everywhere; textile; or none, plain concrete.",
    )  # fmt: skip
    fck: float = setting(
        25, unit="MPa", above=0, maximum=1000,
        meaning=f"Characteristic strength of concrete ({_EC2}, Table 3.1: 12 to 90 MPa).",
    )  # fmt: skip
    alpha_cc: float = setting(
        1.0, above=0, maximum=1, meaning=f"Of the design strength in compression ({_EC2}, 3.1.6)."
    )
    gamma_c: float = setting(
        1.5, minimum=1, maximum=3, meaning=f"Partial factor of concrete ({_EC2}, Table 2.1N)."
    )
    fyk: float = setting(
        500, unit="MPa", above=0, maximum=10000,
        meaning=f"Yield strength of bars ({_EC2}, 3.2.2 (3): 400 to 600; B500).",
    )  # fmt: skip
    gamma_s: float = setting(
        1.15, minimum=1, maximum=3, meaning=f"Partial factor of bars ({_EC2}, Table 2.1N)."
    )
    steel_modulus: float = setting(
        200, unit="GPa", above=0, maximum=1000, meaning=f"Young's modulus of bars ({_EC2}, 3.2.7)."
    )
    steel_density: float = setting(
        7850, unit="kg/m3", above=0, maximum=20000, meaning=f"Density of bars ({_EC2}, 3.2.7)."
    )
    cover: float = setting(
        15, unit="mm", above=0, maximum=200,
        meaning="Concrete over the outer bars. 15 mm is that of precast elements in dry rooms "
        f"(XC1, S4, no deviation; {_EC2}, 4.4.1); outdoors 30 to 40 mm.",
    )  # fmt: skip
    diameter: float = setting(6, unit="mm", above=0, maximum=50, meaning="Of the bars.")
    exposure: str = setting(
        "XC1", choices=EXPOSURES, meaning=f"What the concrete stands in ({_EC2}, Table 4.1)."
    )
    structural_class: str = setting(
        "S4", choices=CLASSES, meaning=f"For the cover ({_EC2}, Table 4.4N; S4 is 50 years)."
    )
    cover_deviation: float = setting(
        0, unit="mm", minimum=0, maximum=50,
        meaning=f"Allowance for the cover ({_EC2}, 4.4.1.3: 10 mm; 0 in precast works that measure "
        "covers and reject).",
    )  # fmt: skip
    layer_gap: float = setting(
        0, unit="mm", minimum=0, maximum=200,
        meaning=f"Clear distance that two layers keep ({_EC2}, 8.2 (2): 20 mm for bars that lap "
        "each other); 0 where they may touch.",
    )  # fmt: skip
    aggregate: float = setting(
        8, unit="mm", above=0, maximum=63,
        meaning=f"Largest grain, for the clear distance of bars ({_EC2}, 8.2 (2)).",
    )  # fmt: skip
    ratio_max: float = setting(
        0.04, above=0, maximum=0.2,
        meaning=f"Largest steel of one direction over the section ({_EC2}, 9.2.1.1 (3)).",
    )  # fmt: skip
    central_lever_ratio: float = setting(
        0.45, above=0, below=0.5,
        meaning="Lever over thickness of the blocks of concrete beside a central mesh: each takes "
        "a tenth of the sheet.",
    )  # fmt: skip
    diagonals: bool = setting(
        True,
        meaning="Strips along the diagonal inside a panel count among those beside its borders.",
    )
    shear_strip_width: float = setting(
        0.5,
        unit="m",
        above=0,
        maximum=100,
        meaning="Strips over which shear is averaged with its sign: narrower ones do not settle.",
    )
    cot_theta: float = setting(
        2.5, minimum=1, maximum=2.5, meaning=f"Of the struts of shear with links ({_EC2}, 6.2.3)."
    )
    links_from: float = setting(
        200,
        unit="mm",
        above=0,
        maximum=10000,
        meaning=f"Thickness from which shear may be carried by links ({_EC2}, 9.3.2 (1)).",
    )
    sizing_checks: tuple[str, ...] = setting(
        USES, choices=USES,
        meaning="What sizing.measure reinforced looks at, the largest counts: compression of "
        "struts, steel over ratio_max, shear beside folds, room for bars and covers.",
    )  # fmt: skip
    textile: Textile


@settings_group
class Co2(Group):
    """Greenhouse gases in kg of CO2 equivalent, of making the materials (A1 to A3). Sources as far
    as they could be looked up; a product's own declaration (EPD) is better than any of them."""

    concrete_kg_m3: float = setting(
        240, unit="kg/m3", minimum=0, maximum=5000,
        meaning="Of concrete: the middle of both ends.",
    )  # fmt: skip
    concrete_low_kg_m3: float = setting(
        195, unit="kg/m3", minimum=0, maximum=5000,
        meaning="Lower end: German mean of C25/30, 81 kg/t (Oekobaudat 2020, table of the IOER, "
        "ioer-isbe.de) at 2400 kg/m3. Slag cements are lower still.",
    )  # fmt: skip
    concrete_high_kg_m3: float = setting(
        286, unit="kg/m3", minimum=0, maximum=5000,
        meaning="Upper end: C25/30 of CEM I, 119 kg/t (ICE database V4.1, as others quote it) at "
        "2400 kg/m3. Fine grain in thin sheets takes more cement.",
    )  # fmt: skip
    steel_kg_kg: float = setting(
        1.2, unit="kg/kg", minimum=0, maximum=100,
        meaning="Of bars: a mean of both ends in 3 of 5 parts from scrap; not from a source.",
    )  # fmt: skip
    steel_low_kg_kg: float = setting(
        0.85, unit="kg/kg", minimum=0, maximum=100,
        meaning="Lower end: scrap in an electric furnace (EPD-012 of ASTM International, "
        "Commercial Metals Company: 0.850 t/t). Green power gives less.",
    )  # fmt: skip
    steel_high_kg_kg: float = setting(
        2.0, unit="kg/kg", minimum=0, maximum=100,
        meaning="Upper end: blast furnace, an order of size; world mean of structural steel 1.61 "
        "(ICE database V4.1, as others quote it).",
    )  # fmt: skip
    grid_kg_kg: float = setting(
        20, unit="kg/kg", minimum=0, maximum=100,
        meaning="Of carbon grids, where reinforcement.kind is textile: within the range below, "
        "impregnation not apart.",
    )  # fmt: skip
    grid_low_kg_kg: float = setting(
        13.0, unit="kg/kg", minimum=0, maximum=100,
        meaning="Lower end of carbon fibre by 24 scenarios (Prenzel et al., Polymers 16 (2024) "
        "12, doi 10.3390/polym16010012).",
    )  # fmt: skip
    grid_high_kg_kg: float = setting(
        34.1, unit="kg/kg", minimum=0, maximum=100, meaning="Upper end of the same."
    )
    crease_kg_m: float = setting(
        0, unit="kg/m", minimum=0, maximum=1000, meaning="Of a fold, per m; 0 leaves it out."
    )


@settings_group
class Prices(Group):
    """Prices in a currency of your own; 0, the default of all, leaves cost out."""

    concrete_m3: float = setting(
        0, unit="1/m3", minimum=0, maximum=1e6, meaning="Concrete in place, with its formwork."
    )
    steel_kg: float = setting(0, unit="1/kg", minimum=0, maximum=1e6, meaning="Bars in place.")
    grid_kg: float = setting(0, unit="1/kg", minimum=0, maximum=1e6, meaning="Grids in place.")
    crease_m: float = setting(0, unit="1/m", minimum=0, maximum=1e6, meaning="A fold, per m.")
    range_share: float = setting(
        0, minimum=0, maximum=1, meaning="Prices are uncertain by this part, up and down."
    )
    source: str = setting("not given", longest=120, meaning="Where the prices are from.")
