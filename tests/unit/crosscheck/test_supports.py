"""Directions, clamps and springs against beams: linear, buckling and second order.

The strips have no Poisson's ratio, so that they are beams: within 0.5 %, which is the mesh and the
thin limit's rest of shear (4e-5). Both paths of the code, since each has its own assembly.
"""

import numpy as np
import pytest

from crosscheck.analysis import analyse_model, list_values
from crosscheck.buckling import compute_buckling_factors
from crosscheck.errors import CrosscheckError, MechanismError
from crosscheck.model import read_model
from crosscheck.opensees import divide_facets
from crosscheck.plain import find_plain_factors, find_plain_state
from crosscheck.records import MULTIFRONTAL, SCIPY
from crosscheck.second_order import solve_second_order
from crosscheck_models import describe_small_fold, describe_strip, write_model

LENGTH, WIDTH, THICKNESS, PARTS = 2.0, 0.5, 0.05, 4
STIFF = 31e6 * THICKNESS**3 / 12  # kNm per m of width
LIVE = 2.0
START, END = [[0, PARTS + 1]], [[PARTS, 2 * PARTS + 1]]
BOTH_PATHS = pytest.mark.parametrize("solver", [MULTIFRONTAL, SCIPY])


def describe(*supports, poisson=0.0, turn=0.0, **combinations):
    data = describe_strip(LENGTH, WIDTH, THICKNESS, PARTS, poisson)
    del data["supported_edges"]
    data |= {"format": "foldshell-neutral-model 3", "supports": list(supports)}
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    data["loads_kn_m2"] |= {"LL": LIVE, "W": 1.0, "wind_fraction": 1.0}
    data["combinations"] = {"S2": {"LL": 1.0}, "D2": {"LL": 1.0}} | combinations
    c, s = np.cos(turn), np.sin(turn)
    rotate = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    data["vertices_m"] = (np.array(data["vertices_m"]) @ rotate.T).tolist()
    return data


def analyse(folder, data, solver=MULTIFRONTAL, subdivisions=2):
    model = read_model(write_model(folder / "model.json", data))
    return analyse_model(model, subdivisions, solver=solver)


def clamp(name, edges, **more):
    return {"name": name, "edges": edges, "clamp": True, **more}


def down(analysis):
    return -analysis.response.displacement[..., 2, 0].min()


def tip(analysis):
    """Mean downward displacement of the two corners at the free end."""
    grid = analysis.system.grid
    nodes = grid.mesh.facet_nodes
    moved = analysis.response.displacement[..., 2, 0]
    return -np.mean([moved[nodes == corner].mean() for corner in END[0]])


@BOTH_PATHS
@pytest.mark.parametrize("stiffness", [0.0, 10.0, 100.0, 1e3])
def test_cantilever_on_a_line_spring(tmp_path, solver, stiffness):
    """w = (q L^4 / 8 EI) / (1 + k L^3 / 3 EI): 12.387, 11.442, 6.785, 1.338 mm."""
    spring = {"name": "tip", "edges": END, "fix": [], "spring_kn_m2": [0, 0, stiffness]}
    supports = [clamp("root", START)] + ([spring] if stiffness else [])
    analysis = analyse(tmp_path, describe(*supports), solver)
    free = LIVE * LENGTH**4 / (8 * STIFF)
    exact = free / (1 + stiffness * LENGTH**3 / (3 * STIFF))
    assert tip(analysis) == pytest.approx(exact, rel=5e-3)
    values = list_values(analysis)["S2"]
    unbalance = np.add(values["reaction_sum_kn"], values["load_sum_kn"])
    assert np.linalg.norm(unbalance) < 1e-8 * np.linalg.norm(values["load_sum_kn"])
    if stiffness:
        carried = values["support_reactions_kn"]["tip"][2]
        assert carried == pytest.approx(stiffness * WIDTH * exact, rel=5e-3)


@BOTH_PATHS
def test_a_stiff_spring_is_a_support(tmp_path, solver):
    """k = 1e8 kN/m per m leaves less than 2e-6 of the free tip, 12.4 mm."""
    spring = {"name": "tip", "edges": END, "fix": [], "spring_kn_m2": [0, 0, 1e8]}
    analysis = analyse(tmp_path, describe(clamp("root", START), spring), solver)
    assert 0 < tip(analysis) < 2e-6 * 12.387e-3


def test_poissons_ratio_lies_between_beam_and_plate(tmp_path):
    """12.39 mm of a beam, 11.89 of a plate strip; two other codes of 0.2 find 12.23."""
    analysis = analyse(tmp_path, describe(clamp("root", START), poisson=0.2))
    assert tip(analysis) == pytest.approx(12.23e-3, rel=5e-3)


def test_springs_at_two_points(tmp_path):
    springs = {"name": "tip", "vertices": END[0], "fix": [], "spring_kn_m": [0, 0, 25.0]}
    analysis = analyse(tmp_path, describe(clamp("root", START), springs))
    free = LIVE * LENGTH**4 / (8 * STIFF)
    exact = free / (1 + 50.0 / WIDTH * LENGTH**3 / (3 * STIFF))
    assert tip(analysis) == pytest.approx(exact, rel=1e-2)


@BOTH_PATHS
@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_clamps_at_both_ends(tmp_path, solver, turn):
    """q L^4 / 384 EI, also where the strip lies across the axes."""
    data = describe(clamp("left", START), clamp("right", END), turn=turn)
    exact = LIVE * LENGTH**4 / (384 * STIFF)
    assert down(analyse(tmp_path, data, solver)) == pytest.approx(exact, rel=5e-3)


@BOTH_PATHS
def test_a_roller_takes_no_thrust(tmp_path, solver):
    """5 q L^4 / 384 EI; the wind along the strip goes to the pinned end alone."""
    roller = {"name": "roller", "edges": END, "fix": ["y", "z"]}
    data = describe({"name": "pin", "edges": START}, roller, D2={"LL": 1.0, "WX": 1.0})
    analysis = analyse(tmp_path, data, solver)
    exact = 5 * LIVE * LENGTH**4 / (384 * STIFF)
    assert down(analysis) == pytest.approx(exact, rel=5e-3)
    found = list_values(analysis)["D2"]["support_reactions_kn"]
    assert found["roller"][0] == 0.0
    assert found["pin"][0] == pytest.approx(-LENGTH * WIDTH, rel=1e-8)
    assert found["roller"][2] == pytest.approx(LIVE * LENGTH * WIDTH / 2, rel=1e-6)


class Column:
    """A beam-column by Ritz, powers of the distance from its clamp: exact to 1e-6.

    It is pushed to the clamp by q per metre, loaded across by p, and held at its free end by k.
    """

    def __init__(self, k):
        power = np.arange(2, 10)
        i, j = power[:, None], power
        s = LENGTH
        self.stiff = STIFF * i * (i - 1) * j * (j - 1) * s ** (i + j - 3) / (i + j - 3)
        self.stiff = self.stiff + k * s ** (i + j)
        self.push = i * j * s ** (i + j) * (1 / (i + j - 1) - 1 / (i + j))
        self.load = s ** (power + 1) / (power + 1)
        self.end = s**power

    def factor(self, q):
        """Least f with which f q buckles the column."""
        return 1 / np.linalg.eigvals(np.linalg.solve(self.stiff, q * self.push)).real.max()

    def sway(self, q, p):
        """Displacement of the free end to second order."""
        return self.end @ np.linalg.solve(self.stiff - q * self.push, p * self.load)


def test_the_column_is_that_of_the_books():
    """q L = 7.837 EI / L^2 for a clamped column under its own weight."""
    assert Column(0.0).factor(1.0) * LENGTH**3 / STIFF == pytest.approx(7.837, rel=1e-4)


def describe_column(stiffness, push):
    """Clamped at its far end, towards which the wind pushes; a spring across at the near end."""
    spring = {"name": "tip", "edges": START, "fix": [], "spring_kn_m2": [0, 0, stiffness]}
    supports = [clamp("root", END)] + ([spring] if stiffness else [])
    combination = {"LL": 1.0, "WX": push}
    return describe(*supports, S2=combination, D2=combination)


@pytest.mark.parametrize("stiffness", [0.0, 200.0])
def test_buckling_of_a_column_on_a_spring(tmp_path, stiffness):
    """Both paths within 0.5 % of Ritz; the spring raises the factor by more than half."""
    exact = Column(stiffness).factor(1.0)
    found = []
    for solver in (MULTIFRONTAL, SCIPY):
        analysis = analyse(tmp_path, describe_column(stiffness, 1.0), solver)
        if solver == MULTIFRONTAL:
            found.append(compute_buckling_factors(analysis.system, analysis.response).factor[0])
        else:
            found.append(find_plain_factors(analysis.system, analysis.response)[0])
    assert found == pytest.approx([exact] * 2, rel=5e-3)
    assert exact > 1.5 * Column(0.0).factor(1.0) or not stiffness


@pytest.mark.parametrize("stiffness", [0.0, 200.0])
def test_second_order_of_a_column_on_a_spring(tmp_path, stiffness):
    """At 0.6 of its buckling load: within 1 %, both paths; first order is less than half of it."""
    column = Column(stiffness)
    push = 0.6 * column.factor(1.0)
    exact = column.sway(push, LIVE)
    for solver in (MULTIFRONTAL, SCIPY):
        analysis = analyse(tmp_path, describe_column(stiffness, push), solver)
        first, forces = analysis.response.pick_cases([0]), analysis.forces[..., [0]]
        if solver == MULTIFRONTAL:
            state = solve_second_order(analysis.system, forces, first).response
        else:
            state = find_plain_state(analysis.system, forces, first)
        nodes = analysis.system.grid.mesh.facet_nodes
        end = -state.displacement[..., 2, 0][nodes == START[0][0]].mean()
        assert end == pytest.approx(exact, rel=1e-2)
        assert end > 1.9 * column.sway(0.0, LIVE)
        balance = state.reactions.sum(axis=(0, 2)) + forces.sum(axis=(0, 1, 3))
        assert np.abs(balance).max() < 1e-6 * np.abs(forces).sum()


def test_a_clamp_on_a_folded_edge_holds_the_fold(tmp_path):
    """Both paths alike where two clamped edges meet on a fold; stiffer than pins."""
    data = describe_small_fold()
    edges = data.pop("supported_edges")
    data |= {"format": "foldshell-neutral-model 3"}
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    found = {}
    for clamped in (False, True):
        data["supports"] = [{"name": "ends", "edges": edges, "clamp": clamped}]
        for solver in (MULTIFRONTAL, SCIPY):
            found[clamped, solver] = analyse(tmp_path, data, solver).response.displacement
    for clamped in (False, True):
        fast, plain = found[clamped, MULTIFRONTAL], found[clamped, SCIPY]
        assert np.abs(fast - plain).max() < 1e-8 * np.abs(plain).max()
    assert np.abs(found[True, SCIPY]).max() < 0.95 * np.abs(found[False, SCIPY]).max()


def test_stiff_springs_under_a_roof_tend_to_pins(tmp_path):
    """The difference falls as 1/k from 1e8 to 1e10 kN/m per m, where it is 1e-5 of the largest.

    The roof is small and stiff: softer springs take a part in its bending.
    """
    data = describe_small_fold()
    edges = data.pop("supported_edges")
    data |= {"format": "foldshell-neutral-model 3"}
    data["compare"] = {"strength": ["S2"], "deflection": ["D2"]}
    data["supports"] = [{"name": "ends", "edges": edges}]
    pinned = analyse(tmp_path, data).response.displacement
    gaps = []
    for stiffness in (1e8, 1e9, 1e10):
        spring = {"name": "ends", "edges": edges, "fix": [], "spring_kn_m2": [stiffness] * 3}
        data["supports"] = [spring]
        found = analyse(tmp_path, data).response.displacement
        gaps.append(np.abs(found - pinned).max() / np.abs(pinned).max())
    assert gaps[2] < 1e-5
    assert gaps[0] / gaps[1] == pytest.approx(10, rel=0.05)
    assert gaps[1] / gaps[2] == pytest.approx(10, rel=0.05)


def test_a_strip_that_may_roll_away_is_refused(tmp_path):
    rollers = [{"name": f"r{k}", "edges": e, "fix": ["y", "z"]} for k, e in enumerate((START, END))]
    with pytest.raises(MechanismError, match="supports"):
        analyse(tmp_path, describe(*rollers))


@pytest.mark.parametrize(
    ("support", "words"),
    [
        ({"name": "a", "edges": START, "fix": ["w"]}, ["supports[0].fix", "some of x, y, z"]),
        ({"name": "a", "vertices": [0], "clamp": True}, ["vertex cannot be clamped"]),
        ({"name": "a", "edges": START, "fix": []}, ["holds in some way"]),
        ({"name": "a"}, ["holds in some way"]),
        ({"name": "a", "edges": START, "spring_kn_m": [0, 0, 1]}, ["spring_kn_m", "from 0"]),
        ({"name": "a", "edges": START, "spring_kn_m2": [0, 0, -1]}, ["spring_kn_m2", "from 0"]),
        ({"name": "a", "edges": [[0, 9]]}, ["supports[0].edges[0]", "facet side"]),
        ({"name": "a", "edges": START, "clamp": "yes"}, ["clamp", "true or false"]),
    ],
)
def test_a_support_that_cannot_be_is_one_sentence(tmp_path, support, words):
    with pytest.raises(CrosscheckError) as caught:
        read_model(write_model(tmp_path / "model.json", describe(support)))
    assert all(word in str(caught.value) for word in ["model.json", *words])


def test_two_supports_of_one_name_are_refused(tmp_path):
    pins = [{"name": "a", "edges": START}, {"name": "a", "edges": END}]
    with pytest.raises(CrosscheckError, match="a name of its own"):
        read_model(write_model(tmp_path / "model.json", describe(*pins)))


def test_opensees_is_not_asked_for_other_supports(tmp_path):
    model = read_model(write_model(tmp_path / "model.json", describe(clamp("root", START))))
    with pytest.raises(CrosscheckError, match="pinned"):
        divide_facets(model, 2)
