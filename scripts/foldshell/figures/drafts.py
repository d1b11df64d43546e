"""What every picture of a design is made of: surface, creases, supports, words."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from foldshell.figures.camera import STANDARD_DIRECTION
from foldshell.figures.colours import MISSING, ColourScale
from foldshell.figures.creases import Creases, cut_dashes, find_creases
from foldshell.figures.fields import choose_strength, membrane_force_coefficients
from foldshell.figures.force_lines import ForceLine, make_force_field, trace_force_lines
from foldshell.figures.layout import INK, SOFT, Caption, Key
from foldshell.figures.scene import Lines, Scene
from foldshell.figures.state import DesignState

DENSE = 350
"""Sheets of more panels get thinner lines, and fewer."""


@dataclass(frozen=True)
class Limits:
    """What a design is judged by: utilization (-), span over displacement (-)."""

    utilization_max: float = 1.0
    displacement_limit_span_over: float = 240.0


@dataclass(frozen=True)
class Elasticity:
    """Young's modulus kPa and Poisson's ratio."""

    youngs_modulus: float
    poissons_ratio: float


@dataclass(frozen=True)
class Subject:
    """What all pictures of a design share; `span` m."""

    state: DesignState
    creases: Creases
    span: float
    limits: Limits
    elasticity: Elasticity

    @property
    def size(self) -> float:
        """Length of the diagonal of the sheet's box, m."""
        return float(np.linalg.norm(np.ptp(self.state.cells.nodes, axis=0)))

    @cached_property
    def force_lines(self) -> tuple[str, list[ForceLine]]:
        """The combination that governs most, and the force lines of both families under it."""
        state, spacing, step = self.state, self.size / 60, self.size / 150
        name = choose_strength(state)
        stiffness = (self.elasticity.youngs_modulus, self.elasticity.poissons_ratio)
        coefficients, geometry = membrane_force_coefficients(state, name, *stiffness)
        field = make_force_field(state.mesh, geometry, coefficients)
        return name, trace_force_lines(field, (0, 1), spacing, step)


@dataclass(frozen=True)
class Draft:
    """A scene with its words, before it is rendered; `direction` is that towards the eye."""

    scene: Scene
    caption: Caption
    direction: tuple[float, float, float] = STANDARD_DIRECTION


def make_subject(
    state: DesignState,
    span: float,
    limits: Limits,
    elasticity: Elasticity,
    folded: bool = True,
) -> Subject:
    """Find the creases of a state; those of a smooth shell (`folded` False) are panel borders."""
    creases = find_creases(state.cells, state.folded, folded)
    return Subject(state, creases, span, limits, elasticity)


def read_limits(settings: Mapping[str, Any]) -> Limits:
    """Return the limits in the plain settings of stage `size`."""
    sizing = settings["sizing"]
    return Limits(sizing["utilization_max"], sizing["displacement_limit_span_over"])


def subject_of_design(
    state: DesignState, settings: Mapping[str, Any], span: float, pattern: str
) -> Subject:
    """Return the subject of a design with the plain settings of stage `size`; span m."""
    material = settings["material"]
    elasticity = Elasticity(material["youngs_modulus"], material["poissons_ratio"])
    return make_subject(state, span, read_limits(settings), elasticity, pattern != "smooth")


def draft_field(
    subject: Subject,
    title: str,
    facts: str,
    quantity: str,
    values: np.ndarray,
    scale: ColourScale,
    above: str = "",
    points: np.ndarray | None = None,
    extra: tuple[Lines, ...] = (),
    keys: tuple[Key, ...] = (),
) -> Draft:
    """Return the sheet coloured by values of its cells (C,) or nodes (N,)."""
    state = subject.state
    points = state.cells.nodes if points is None else points
    lines, line_keys = crease_lines(subject, points)
    scene = Scene(
        points, state.triangles, scale.colour(values), (*lines, *extra),
        *support_marks(subject),
    )  # fmt: skip
    all_keys = (*line_keys, *keys, Key("support", "pinned edges"))
    words = (facts, describe_verdict(state.report))
    return Draft(scene, Caption(f"{title}: {state.name}", words, quantity, scale, above, all_keys))


def draft_nothing(subject: Subject, title: str, words: str) -> Draft:
    """Return the grey sheet with words that say what is missing."""
    state = subject.state
    lines, keys = crease_lines(subject, state.cells.nodes)
    colours = np.tile(np.array(MISSING, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(state.cells.nodes, state.triangles, colours, lines, *support_marks(subject))
    verdict = describe_verdict(state.report)
    keys = (*keys, Key("support", "pinned edges"))
    return Draft(scene, Caption(f"{title}: {state.name}", (words, verdict), keys=keys))


def describe_verdict(report: Mapping[str, Any]) -> str:
    """Return verdict, count of analyses and reason as one line."""
    words = f"{str(report.get('verdict')).replace('_', ' ')} after {count_analyses(report)}"
    return f"{words}: {report['reason']}" if report.get("reason") else words


def count_analyses(report: Mapping[str, Any]) -> str:
    """Return the count of analyses in words."""
    count = report.get("iteration", 0) + 1
    return f"{count} {'analysis' if count == 1 else 'analyses'}"


def crease_lines(subject: Subject, points: np.ndarray) -> tuple[tuple[Lines, ...], tuple[Key, ...]]:
    """Return mountains as lines, valleys as dashes, other panel borders thin, and their keys."""
    creases = subject.creases
    dashes = cut_dashes(points[creases.valley], subject.size / 90)
    width = 2.5 * min(1.0, (DENSE / len(subject.state.final["thickness"])) ** 0.5)
    lines = (
        Lines(points[creases.border], INK, 0.8 * width),
        Lines(points[creases.flat], SOFT, 0.4 * width),
        Lines(points[creases.mountain], INK, width),
        Lines(dashes, INK, width),
    )
    keys = [Key("solid", "mountain crease"), Key("dashed", "valley crease")]
    if not len(creases.mountain) + len(creases.valley):
        keys = [Key("solid", "panel border", SOFT)]
    return lines, tuple(keys)


def support_marks(subject: Subject) -> tuple[np.ndarray, float]:
    """Return the vertices on supported edges (S, 3) m, and the size of their marks, m."""
    state = subject.state
    vertices = np.unique(state.shell["support_pairs"])
    return state.shell["vertices"][vertices], subject.size / 60


def lines_before(subject: Subject) -> Lines:
    """Return the undisplaced creases, of a dense sheet the border alone."""
    creases = subject.creases
    kinds = [creases.border]
    if len(subject.state.final["thickness"]) <= DENSE:
        kinds += [creases.mountain, creases.valley, creases.flat]
    return Lines(subject.state.cells.nodes[np.concatenate(kinds)], (150, 150, 150), 1.5, 0.0)
