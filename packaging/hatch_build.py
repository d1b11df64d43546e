"""What a wheel holds beside the library: the files of the workflow, the same as in a checkout."""

from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PATTERNS = (
    "Snakefile",
    "rules/*.smk",
    "scripts/*.py",
    "scripts/crosscheck/**/*.py",
    "config/*",
    "envs/*",
    "profiles/**/*.yaml",
    "docs/report/*.rst",
    "tests/verification/README.md",
)


class CustomBuildHook(BuildHookInterface):
    """Put the workflow's files below foldshell/workflow, in folders of the same names."""

    def initialize(self, version: str, build_data: dict) -> None:
        """Add them to the wheel."""
        del version
        root = Path(self.root)
        for pattern in PATTERNS:
            for path in sorted(root.glob(pattern)):
                if path.is_file():
                    place = f"foldshell/workflow/{path.relative_to(root).as_posix()}"
                    build_data["force_include"][str(path)] = place
