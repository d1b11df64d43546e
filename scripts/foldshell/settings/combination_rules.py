"""Combinations of load cases by the rule of a code: Table 2 of the paper, ASCE 7, EN 1990.

Cases of permanent actions act together. Cases of one variable action (imposed, snow, wind,
temperature) exclude each other: what acts at the same time is one case. A case acts both ways where
it says so, which wind along an axis does.
"""

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from foldshell.settings.codes import Codes, En1990

PERMANENT, SETTLEMENT = "permanent", "settlement"
VARIABLE = ("imposed", "snow", "wind", "temperature")
ACTIONS = (PERMANENT, *VARIABLE, SETTLEMENT)
"""Kinds of actions that the rules tell apart."""

GENERATED_MAX = 120
"""Combinations of one purpose that a rule may make."""

Combination = dict[str, float]


@dataclass(frozen=True)
class Action:
    """A load case as combination rules see it: its kind, and whether it acts both ways."""

    case: str
    kind: str
    both_ways: bool = False


@dataclass(frozen=True)
class CombinationSet:
    """Combinations by purpose: factors of load cases by the name of the combination.

    `strength` holds the ultimate limit states; `characteristic` and `quasi_permanent` those that
    deflections are taken from, the latter under sustained load.
    """

    strength: Mapping[str, Combination]
    characteristic: Mapping[str, Combination]
    quasi_permanent: Mapping[str, Combination]


def generate_combinations(rule: str, actions: Sequence[Action], codes: Codes) -> CombinationSet:
    """Return the combinations of load cases by a rule: "paper", "asce7" or "en1990".

    Names are ULS1, ULS2, ..., SLS1, ... (characteristic) and QP1, ... (quasi-permanent). Raises
    `ValueError` for more than `GENERATED_MAX` of one purpose.
    """
    makers = {"paper": _paper, "asce7": _asce7, "en1990": lambda a: _en1990(a, codes.en1990)}
    strength, characteristic, sustained = (list(part) for part in makers[rule](_Cases(actions)))
    return CombinationSet(
        _name("ULS", strength), _name("SLS", characteristic), _name("QP", sustained)
    )


def _name(prefix: str, found: Iterable[Combination]) -> dict[str, Combination]:
    """Number combinations that load something and differ from those before."""
    unique = {tuple(sorted(one.items())): one for one in map(_without_zeros, found) if one}
    if len(unique) > GENERATED_MAX:
        raise ValueError(
            f"the rule makes {len(unique)} combinations of these cases: at most {GENERATED_MAX} "
            "are allowed, what acts at the same time may be one case"
        )
    return {f"{prefix}{number}": one for number, one in enumerate(unique.values(), start=1)}


def _without_zeros(one: Combination) -> Combination:
    return {case: factor for case, factor in one.items() if factor}


class _Cases:
    """Cases by kind of action, as terms of combinations."""

    def __init__(self, actions: Sequence[Action]):
        self._actions = actions
        self.dead = {action.case: 1.0 for action in actions if action.kind == PERMANENT}

    def of(self, kind: str) -> list[Combination]:
        """Return the terms of a variable action: each case alone, each way."""
        own = [action for action in self._actions if action.kind == kind]
        ways = [(a.case, (1.0, -1.0) if a.both_ways else (1.0,)) for a in own]
        return [{case: way} for case, signs in ways for way in signs]

    def any_of(self, kind: str) -> list[Combination]:
        """Return the same and none of them, none first."""
        return [{}, *self.of(kind)]


def _sum(*terms: tuple[float, Combination]) -> Combination:
    """Return the sum of factor times term."""
    total: Combination = {}
    for factor, term in terms:
        for case, value in term.items():
            total[case] = round(total.get(case, 0.0) + factor * value, 12)
    return total


def _gravity(cases: _Cases) -> list[Combination]:
    """Return imposed load and snow as one action, each case alone."""
    return cases.of("imposed") + cases.of("snow")


def _paper(cases: _Cases) -> tuple[Iterable[Combination], ...]:
    """Table 2 of Tsiamis et al. (2018) with wind both ways; snow stands in for live load.

    S: 1.4 D; 1.2 D + 1.6 L + 0.5 W; 1.2 D + 1.0 L + 1.0 W. Deflection: D; D + L + W; D alone.
    """
    dead, live, wind = cases.dead, _gravity(cases) or [{}], cases.of("wind") or [{}]
    others = cases.of("temperature") + cases.of(SETTLEMENT)
    pairs = list(itertools.product(live, wind))
    strength = [_sum((1.4, dead))]
    strength += [_sum((1.2, dead), (1.6, one), (0.5, blow)) for one, blow in pairs]
    strength += [_sum((1.2, dead), (1.0, one), (1.0, blow)) for one, blow in pairs]
    strength += [_sum((1.2, dead), (1.2, one)) for one in others]
    service = [dead, *(_sum((1, dead), (1, one), (1, blow)) for one, blow in pairs)]
    service += [_sum((1, dead), (1, one)) for one in others]
    return strength, service, [dead]


def _asce7(cases: _Cases) -> tuple[Iterable[Combination], ...]:
    """ASCE/SEI 7-16, 2.3.1 and 2.3.5, and C-2 of Appendix C for deflection.

    Imposed load is taken for L and for L_r, whichever is more: 1.6 of it with 0.5 W, 1.0 with W.
    Where nothing else is said, self-straining T has the factor 1.2.
    """
    return _asce7_strength(cases), _asce7_service(cases), _asce7_sustained(cases)


def _asce7_strength(cases: _Cases) -> Iterator[Combination]:
    dead, live, snow, wind = cases.dead, *(cases.any_of(k) for k in ("imposed", "snow", "wind"))
    yield _sum((1.4, dead))
    for one, white in itertools.product(live, snow):
        if one or white:
            yield _sum((1.2, dead), (1.6, one), (0.5, white))
        if white:
            yield _sum((1.2, dead), (1.6, white), (1.0, one))
    for term, blow in itertools.product(_gravity(cases), wind[1:]):
        yield _sum((1.2, dead), (1.6, term), (0.5, blow))
    for one, white, blow in itertools.product(live, snow, wind[1:]):
        yield _sum((1.2, dead), (1.0, blow), (1.0, one), (0.5, white))
    yield from (_sum((0.9, dead), (1.0, blow)) for blow in wind[1:])
    for strain in cases.of("temperature") + cases.of(SETTLEMENT):
        yield from (_sum((1.2, dead), (1.2, strain), (1.0, one)) for one in live)


def _asce7_service(cases: _Cases) -> Iterator[Combination]:
    dead, wind = cases.dead, cases.any_of("wind")
    yield dead
    for one, white in itertools.product(cases.any_of("imposed"), cases.any_of("snow")):
        yield from (_sum((1, dead), (1, one), (0.5, white), (1, blow)) for blow in wind)
        if white:
            yield _sum((1, dead), (0.5, one), (1, white))
    for strain in cases.of("temperature") + cases.of(SETTLEMENT):
        yield _sum((1, dead), (1, strain))


def _asce7_sustained(cases: _Cases) -> Iterator[Combination]:
    """D + 0.5 L, for which creep is to be regarded (CC.2.1)."""
    yield from (_sum((1, cases.dead), (0.5, one)) for one in cases.any_of("imposed"))


def _en1990(cases: _Cases, code: En1990) -> tuple[Iterable[Combination], ...]:
    """EN 1990:2002 (6.10), (6.14b) characteristic and (6.16b) quasi-permanent.

    gamma_G G + gamma_Q Q_1 + sum of gamma_Q psi_0 Q_i for each leading action; favourable
    permanent actions stand with a leading wind alone. Settlements are there or not.
    """
    high, low, gamma = code.permanent_unfavourable, code.permanent_favourable, code.variable
    variable = list(_lead(cases, code))
    strength = [_sum((high, cases.dead)), *(_sum((high, cases.dead), (gamma, v)) for v in variable)]
    strength += [_sum((low, cases.dead), (gamma, blow)) for blow in cases.of("wind")]
    service = [_sum((1, cases.dead), (1, v)) for v in variable]
    sustained = []
    for chosen in itertools.product(*(cases.any_of(kind) for kind in VARIABLE)):
        terms = ((_psi(code, kind, 2), term) for kind, term in zip(VARIABLE, chosen, strict=True))
        sustained.append(_sum((1, cases.dead), *terms))
    moved = cases.any_of(SETTLEMENT)
    groups = ((strength, code.settlement), ([cases.dead, *service], 1.0), (sustained, 1.0))
    return tuple(
        [_sum((1, one), (factor, away)) for away in moved for one in found]
        for found, factor in groups
    )


def _lead(cases: _Cases, code: En1990) -> Iterator[Combination]:
    """Yield Q_1 + sum of psi_0 Q_i of every leading action with every choice of the others."""
    for kind in VARIABLE:
        others = [other for other in VARIABLE if other != kind and _psi(code, other, 0)]
        for lead in cases.of(kind):
            for chosen in itertools.product(*(cases.any_of(other) for other in others)):
                terms = zip((_psi(code, other, 0) for other in others), chosen, strict=True)
                yield _sum((1, lead), *terms)


def _psi(code: En1990, kind: str, number: int) -> float:
    return getattr(code, f"{kind}_psi{number}")
