"""Where the range of a variable decides: designs that stand at its end."""

from collections.abc import Sequence

from foldshell.records.candidate import CandidateRecord, is_found
from foldshell.settings.exploration import Exploration

AT_BOUND = 0.02
"""Share of a range within which a value counts as at its bound."""


def list_bounds(
    exploration: Exploration, records: Sequence[CandidateRecord]
) -> list[tuple[str, float]]:
    """Return the variables, with the end of their range, where found designs stand at that end."""
    found = []
    for variable in exploration.variables:
        if variable.choices:
            continue
        for record in records:
            if not is_found(record.candidate):
                continue
            name, width = variable.name, variable.high - variable.low
            given = record.columns[name] if name in record.columns else record.value_of(name)
            share = (float(given) - variable.low) / width
            if not AT_BOUND <= share <= 1 - AT_BOUND:
                found.append((name, variable.low if share < AT_BOUND else variable.high))
    return found
