"""The page of claims: what stands in its tables."""

from dataclasses import replace

import pytest

from claims_case import make_design_result
from foldshell.claims.design_result import (
    QUANTITIES,
    Comparer,
    describe_quantity,
    find_unit,
)
from foldshell.claims.kinematics import judge_foldability
from foldshell.claims.limits import judge_folds
from foldshell.claims.statement import Claim, describe_claim
from foldshell.claims.structure import judge_supports
from foldshell.claims.study import write_warnings
from foldshell.claims.words import join_names, write_findings, write_section
from foldshell.records.claims import Dependence
from foldshell.records.measures import FlatEqualRecord
from record_cases import make_quality

COMPARER = Comparer()


def _with_quality(one, flat_foldability_max_rad, **measures):
    values = replace(one.values, flat_foldability_max_rad=flat_foldability_max_rad)
    return replace(one, quality=make_quality(**measures), values=values)


def test_names_share_what_they_have_in_common():
    assert join_names(["arch-28-strip", "arch-28-zigzag"]) == "arch-28-strip\\|zigzag"
    assert join_names(["arch-28", "flat"]) == "arch-28 | flat".replace("|", "\\|")
    assert join_names(["one"]) == "one"


def test_a_row_holds_the_values_in_the_order_of_its_name():
    """The evenness of C7 is claimed the other way round than the volume."""
    designs = [
        make_design_result(
            {"utilization_variation": 0.3, "volume_per_area": 0.08}, support="strip"
        ),
        make_design_result(
            {"utilization_variation": 0.5, "volume_per_area": 0.05}, support="zigzag"
        ),
    ]
    entry = describe_claim(judge_supports(designs, COMPARER))
    (table,) = write_findings(entry.numbers.findings)
    row = table.splitlines()[2]
    assert "zigzag\\|strip" in row
    assert "0.5 / 0.3 ± 0.029: holds" in row and "50 / 80 ± 4.8: holds" in row
    assert "volume per area [mm]" in table


def test_units_of_quantities_are_those_of_their_records():
    """Metres show as mm, strains as %: the factors by what the units mean."""
    factors = {("m", "mm"): 1000, ("-", "%"): 100}
    units = {
        "volume": ("m3", "m3"), "volume_per_area": ("m", "mm"), "displacement": ("m", "mm"),
        "displacement_edge": ("m", "mm"), "displacement_inner": ("m", "mm"), "depth": ("m", "m"),
        "panel_area": ("m2", "m2"), "edge_strain_rms": ("-", "%"),
        "steel_kg_m2": ("kg/m2", "kg/m2"),
        "angle_defect_max_rad": ("rad", "rad"), "flat_foldability_max_rad": ("rad", "rad"),
    }  # fmt: skip
    for quantity in QUANTITIES:
        about = describe_quantity(quantity)
        unit, shown = units.get(quantity, ("-", "-"))
        assert (about.unit, find_unit(quantity), about.shown) == (unit, unit, shown), quantity
        assert about.factor == factors.get((unit, shown), 1), quantity
    assert find_unit("panels") == "-" and describe_quantity("panels") is None


@pytest.mark.parametrize(
    ("quantity", "values", "cell"),
    [
        ("displacement", (0.05, 0.04), "displacement [mm] | 50 / 40 ± 3.2"),
        ("volume_per_area", (0.08, 0.05), "volume per area [mm] | 80 / 50 ± 4.8"),
        ("volume", (80.0, 50.0), "volume [m3] | 80 / 50 ± 4.8"),
        ("edge_strain_rms", (0.012, 0.01), "edge strain rms [%] | 1.2 / 1"),
        ("depth", (1.9, 1.5), "depth [m] | 1.9 / 1.5"),
        ("panel_area", (2.0, 1.5), "panel area [m2] | 2 / 1.5"),
        ("utilization_mean", (0.4, 0.3), "utilization mean [-] | 0.4 / 0.3 ± 0.025"),
    ],
)
def test_a_cell_shows_the_number_in_the_unit_of_its_column(quantity, values, cell):
    """5 % uncertainty of each, of a volume 5.1 %; what folding alone decides has none."""
    one, two = (make_design_result({quantity: value}, strip=16 + k)
                for k, value in enumerate(values))  # fmt: skip
    finding = COMPARER.compare("part", one, two, quantity)
    assert finding.values == values and finding.unit == find_unit(quantity)
    (table,) = write_findings([finding])
    head, _, row = table.splitlines()[:3]
    column, shown = cell.split(" | ")
    assert head.split(" | ")[1] == f"part: {column} |"
    assert row.split(" | ")[1] == f"{shown}: holds |"


def test_rows_share_a_table_only_where_columns_mean_the_same():
    """The worst of planarity and strain decides rigid foldability: the header says which it is."""
    exact = {"planarity_max": 0.0, "edge_strain_max": 0.0, "angle_defect_max_rad": 0.0,
             "flat_foldability_max_rad": 0.0}  # fmt: skip
    designs = [
        _with_quality(make_design_result(strip=16 + k), **exact | {worst: 0.02})
        for k, worst in enumerate(("planarity_max", "edge_strain_max", "planarity_max"))
    ]
    tables = write_findings(describe_claim(judge_foldability(designs)).numbers.findings)
    assert [len(table.splitlines()) for table in tables] == [4, 3]
    assert "rigid foldability: planarity max [-], limit 0.001" in tables[0]
    assert "rigid foldability: edge strain max [-], limit 0.001" in tables[1]
    assert "angle defect max [rad]" in tables[0]


def test_a_section_says_what_cannot_be_told():
    says = Dependence(words="Nothing.", runs=None, equal_thickness=None)
    section = write_section(replace(describe_claim(Claim("C6", [])), sensitivity=says))
    assert section.startswith("## C6: cannot be told") and "Sensitivity: Nothing." in section


def test_the_largest_uncertainty_of_a_claim_is_per_cent():
    """A quantity whose two values are 5 % uncertain, the errors of either code as one."""
    designs = [make_design_result({"volume_per_area": value}, support=support)
               for support, value in (("strip", 0.08), ("zigzag", 0.05))]  # fmt: skip
    claim = describe_claim(judge_supports(designs, COMPARER))
    largest = claim.uncertainty.largest_relative
    shown = "; ".join(
        f"{quantity.replace('_', ' ')} {float(f'{value * 100:.3g}'):g} %"
        for quantity, value in largest.items()
    )
    assert all(0.01 < value < 0.2 for value in largest.values()) and largest
    assert f"Largest: {shown}." in write_section(claim)


def test_flat_sheets_have_a_row_each():
    design = make_design_result()
    measures = replace(design.values, displacement=None, utilization_panel_mean_max=None)
    flat = FlatEqualRecord(
        flat="flat-sheet", state="unstable", thickness_m=0.05, volume_m3=80.0, area_m2=1600.0,
        sides_m=(40.0, 41.5), displacement_first_order_m=2.0, errors={}, measures=measures,
    )  # fmt: skip
    claim = judge_folds([design], {design.name: flat}, COMPARER)
    section = write_section(describe_claim(claim))
    assert "| flat-sheet | 40 x 41.5 | 50 | 80 | unstable | 2 | - |" in section
    assert section.startswith("## C13: holds")


def test_designs_whose_model_is_in_doubt_are_listed_on_the_page():
    sound, doubtful = make_design_result(), make_design_result(strip=17)
    assert write_warnings([sound]) == ""
    text = write_warnings([sound, replace(doubtful, warning="3 of 210 panels are thick")])
    assert f"| {doubtful.name} | 3 of 210 panels are thick |" in text
    assert sound.name not in text.replace(doubtful.name, "")
