"""Sheets and tools shared by the folding tests."""

import math

import numpy as np

from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target
from foldshell.pattern.design import design_sheet
from foldshell.pattern.miura import Miura
from foldshell.pattern.sheet import make_miura_sheet
from foldshell.settings.fold import Fold

SPAN_HEIGHTS = ((28, 10), (13, 5), (5, 2), (28, 28), (28, 6))
DENSITIES = ((30, 16), (50, 16), (15, 16), (30, 32), (8, 32))


def skewed_sheet(zigzag_count=5, strip_count=6, size=0.05):
    """A small Miura sheet and a disturbed, rotated copy of its rest state."""
    sheet = make_miura_sheet(Miura(0.9, 0.7, math.radians(63), zigzag_count, strip_count), 0)
    rng = np.random.default_rng(7)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    vertices = (sheet.rest - sheet.rest.mean(axis=0)) @ turn.T * 0.5 + [0.2, -0.1, 0.6]
    return sheet, vertices + size * rng.normal(size=vertices.shape) * 0.5


def differentiate(function, vertices, step=1e-6):
    """Central differences (m, 3V) of a function of vertices."""
    columns = []
    for k in range(vertices.size):
        shift = np.zeros(vertices.size)
        shift[k] = step
        shift = shift.reshape(vertices.shape)
        columns.append((function(vertices + shift) - function(vertices - shift)) / (2 * step))
    return np.column_stack(columns)


def fold_case(surface, span, height, zigzag, strip, mode="elastic", angle=60.0, **settings):
    """Fold one design; returns sheet, target and result."""
    target = make_target(surface, span, height)
    sheet = design_sheet("miura", target.section_lengths(), zigzag, strip, angle, 0)
    return sheet, target, fold_sheet(sheet, target, mode, Fold(**settings))
