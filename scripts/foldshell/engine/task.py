"""A job as scripts know it, made without Snakemake: for jobs that run within another one."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


class Named:
    """Values by name, as a job of Snakemake has them: by attribute, and one by one in order."""

    def __init__(self, **values: Any) -> None:
        self.__dict__.update(values)

    def __iter__(self) -> Iterator[Any]:
        """Yield all values, those of lists one by one."""
        for value in vars(self).values():
            yield from value if isinstance(value, list | tuple) else [value]

    def __getitem__(self, key: int | str) -> Any:
        """Return the value of a name, or the one at a place."""
        return vars(self)[key] if isinstance(key, str) else list(self)[key]

    def keys(self) -> list[str]:
        """Return the names."""
        return list(vars(self))

    def items(self) -> list[tuple[str, Any]]:
        """Return (name, value) of all."""
        return list(vars(self).items())

    def get(self, name: str, default: Any = None) -> Any:
        """Return a value, the default where there is none."""
        return vars(self).get(name, default)


@dataclass(frozen=True)
class Task:
    """What a script reads of the global `snakemake`: rule, wildcards, files and parameters."""

    rule: str
    wildcards: Named
    input: Named
    output: Named
    params: Named
