"""The combinations by which the engineering verdict judges a design's final state."""

from foldshell.loads.cases import case_actions
from foldshell.settings.codes import Codes
from foldshell.settings.combination_rules import CombinationSet, generate_combinations
from foldshell.settings.loads import Loads


def engineering_combinations(loads: Loads, codes: Codes) -> CombinationSet:
    """Return the combinations of the rule `codes.engineering`, each with wind both ways.

    The result has three mappings {name: {case: factor}}: `strength` (ULS1, ...: ultimate limit
    states), `characteristic` (SLS1, ...: short-term deflections) and `quasi_permanent` (QP1, ...:
    sustained, for deflections with creep). With `cases = make_load_cases(loads, unit_weight)`,
    `combination_matrix(found.strength, list_cases(cases))` gives the factors (cases, combinations)
    by which results of the load cases are superposed; `analyse_shell` takes `cases` and
    `found.strength` as they are.

    Parameters
    ----------
    loads : settings of a design's stage, with the loads of its own set where it has one
    codes : settings of the group `codes`, as the stage `checks` has them

    Raises
    ------
    ValueError
        for more combinations than `GENERATED_MAX`.
    """
    return generate_combinations(codes.engineering, case_actions(loads), codes)
