# Where no exploration is named: the target says what is due.

from foldshell.files.errors import InputError


def name_an_exploration(wildcards):
    """Say which setting the target `explore` needs."""
    with user_errors():
        raise InputError(
            "exploration: none is named: type --config exploration=FILE, such as "
            "config/explorations/paraboloid_strip.yaml"
        )


rule explore:
    input:
        name_an_exploration,
