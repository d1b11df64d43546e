"""Print docs/records.md: `PYTHONPATH=scripts python -m foldshell.records > docs/records.md`."""

from foldshell.records.documentation import write_documentation

if __name__ == "__main__":
    print(write_documentation(), end="")
