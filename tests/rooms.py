"""The rooms of the library in their order, for the test that holds them and for the map."""

from pathlib import Path

LIBRARY = Path(__file__).parents[1] / "scripts" / "foldshell"
ROOMS = (
    "files",
    "settings",
    "records",
    "pattern",
    "loads",
    "folding",
    "kinematics",
    "shell",
    "checks",
    "sizing",
    "results",
    "workbook",
    "claims",
    "explore",
    "figures",
    "report",
    "exchange",
    "archive",
    "engine",
)
"""From the floor up: a room may import the rooms before it, and itself."""
LEAVES = {"figures", "report", "exchange", "archive"}
"""Above the results; none of them imports another."""
