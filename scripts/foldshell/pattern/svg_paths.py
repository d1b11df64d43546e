"""Points of SVG's `points` and `d` attributes; straight lines alone."""

import re

from foldshell.files.errors import InputError

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_TOKEN = re.compile(rf"[A-Za-z]|{_NUMBER.pattern}")
_SEPARATORS = re.compile(r"[\s,]*")
Point = tuple[float, float]


def _split(place: str, text: str) -> list[str]:
    """Letters and numbers of an attribute; raise `InputError` for anything else."""
    found, at = [], _SEPARATORS.match(text).end()  # type: ignore[union-attr]
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise InputError(f"{place}: {text[at : at + 30]!r}: letters and numbers are allowed")
        found.append(match[0])
        at = _SEPARATORS.match(text, match.end()).end()  # type: ignore[union-attr]
    return found


def read_points(place: str, text: str) -> list[Point]:
    """Points of a polyline or polygon."""
    words = _split(place, text)
    if len(words) % 2 or any(word.isalpha() for word in words):
        raise InputError(f"{place}: points: pairs of numbers are allowed")
    numbers = [float(word) for word in words]
    return list(zip(numbers[::2], numbers[1::2], strict=True))


def read_path(place: str, text: str) -> list[list[Point]]:
    """Chains of points of a path of M, L, H, V and Z, absolute or relative."""
    words = _split(place, text)
    chains: list[list[Point]] = []
    command, at, x, y = "", 0, 0.0, 0.0
    while at < len(words):
        if words[at].isalpha():
            command, at = words[at], at + 1
            if command.upper() not in "MLHVZ":
                raise InputError(f"{place}: path command {command!r}: M, L, H, V, Z are allowed")
            if command in "Zz":
                if chains and chains[-1]:
                    chains[-1].append(chains[-1][0])
                    x, y = chains[-1][0]
                    chains.append([(x, y)])
                continue
        elif not command or command in "Zz":
            raise InputError(f"{place}: path: a number without a command")
        size = 1 if command.upper() in "HV" else 2
        part = words[at : at + size]
        if len(part) < size or any(word.isalpha() for word in part):
            raise InputError(f"{place}: path: {command} without its {size} numbers")
        x, y = _move(command, [float(word) for word in part], x, y)
        at += size
        if command in "Mm":
            chains.append([(x, y)])
            command = "L" if command == "M" else "l"
        elif not chains:
            raise InputError(f"{place}: path: begins with {command}: M is due")
        else:
            chains[-1].append((x, y))
    return [chain for chain in chains if len(chain) > 1]


def _move(command: str, numbers: list[float], x: float, y: float) -> Point:
    kind, relative = command.upper(), command.islower()
    if kind == "H":
        return (x + numbers[0] if relative else numbers[0]), y
    if kind == "V":
        return x, (y + numbers[0] if relative else numbers[0])
    return (x + numbers[0], y + numbers[1]) if relative else (numbers[0], numbers[1])
