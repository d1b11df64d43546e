"""Names of another program that it does not promise to keep."""

from collections.abc import Container


class NameCheck:
    """Looks names up before they are used and remembers those that are `gone`."""

    def __init__(self) -> None:
        self.gone: list[str] = []

    def has(self, owner: object, place: str, names: str) -> bool:
        """Tell whether an object has all attributes of a list with blanks, or a container all
        such members; `place` is what the object is called in the warning."""
        known = owner if isinstance(owner, Container) else dir(owner)
        gone = [f"{place}.{name}" for name in names.split() if name not in known]
        self.gone += [name for name in gone if name not in self.gone]
        return not gone

    def describe(self) -> str:
        """Return one line for a person, empty where nothing is gone."""
        if not self.gone:
            return ""
        names = ", ".join(self.gone)
        return f"warning: this Snakemake has no {names}: the run is slower, or says less\n"
