"""Rooms import only rooms below them; the topmost ones import none of each other."""

import ast

from rooms import LEAVES, LIBRARY, ROOMS


def imported_rooms(path):
    """Yield (line number, room) of every import of the library in a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = []
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level:
            names = ["foldshell.(a relative import hides its room)"]
        for name in names:
            parts = name.split(".")
            if parts[0] == "foldshell" and len(parts) > 1:
                yield node.lineno, parts[1]


def allowed(room):
    """Return the rooms that a room may import."""
    below = set(ROOMS[: ROOMS.index(room) + 1])
    return below - (LEAVES - {room} if room in LEAVES else set())


def test_rooms_import_only_rooms_below_them():
    wrong = []
    for path in sorted(LIBRARY.rglob("*.py")):
        place = path.relative_to(LIBRARY)
        if len(place.parts) == 1:
            continue  # the front door imports from all rooms
        for line, room in imported_rooms(path):
            if room not in allowed(place.parts[0]):
                wrong.append(f"{place}:{line}: {place.parts[0]} -> {room}")
    assert not wrong, "arrows that run upward: " + "; ".join(wrong)


def test_every_folder_of_the_library_is_a_room():
    places = [path.relative_to(LIBRARY).parts for path in LIBRARY.rglob("__init__.py")]
    folders = {parts[0] for parts in places if len(parts) > 1}  # a room may have folders of its own
    assert folders <= set(ROOMS), "folders that are no room: " + ", ".join(folders - set(ROOMS))


def test_only_the_engine_and_the_reading_of_config_know_the_workflow():
    for path in sorted(LIBRARY.rglob("*.py")):
        if path.relative_to(LIBRARY).parts[0] == "engine":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in getattr(node, "names", [])]
            if isinstance(node, ast.ImportFrom):
                names = [str(node.module)]
            assert not any(name.split(".")[0] == "snakemake" for name in names), path
