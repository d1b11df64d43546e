"""The groups of settings that stages about a loaded shell share."""

from foldshell.settings.analysis import Analysis
from foldshell.settings.checks import Checks
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.settings.reinforcement import Reinforcement
from foldshell.settings.sizing import Sizing

LOADED = (Material, Loads, Combinations)
ANALYSED = (*LOADED, Analysis, Sizing, Checks, Reinforcement)
"""How a shell is analysed and sized; of the checks a loop takes the width of strips alone,
of reinforcement nothing unless it sizes by it."""

MEASURED = (*LOADED, Crosscheck, Checks, Reinforcement)
"""What the mesh error of a state and of its reinforcement takes."""
