"""Run by the system's Python with UNO: type into cells of a workbook as a person would, and save.

Usage: python3 libreoffice_typing.py IN OUT EDITS.json, where EDITS is a list of
["type", sheet, cell, text], ["delete_row", sheet, row], ["insert_column", sheet, column] or
["rename", sheet, name]. Rows and columns count from 1.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import uno
from com.sun.star.beans import PropertyValue
from com.sun.star.connection import NoConnectException


def connect(pipe: str):
    """Return LibreOffice's desktop once it answers on a named pipe."""
    local = uno.getComponentContext()
    resolver = local.ServiceManager.createInstanceWithContext(
        "com.sun.star.bridge.UnoUrlResolver", local
    )
    address = f"uno:pipe,name={pipe};urp;StarOffice.ComponentContext"
    for _ in range(240):
        try:
            remote = resolver.resolve(address)
            return remote.ServiceManager.createInstanceWithContext(
                "com.sun.star.frame.Desktop", remote
            )
        except NoConnectException:
            time.sleep(0.25)
    raise SystemExit("LibreOffice did not answer")


def set_property(name: str, value) -> PropertyValue:
    """Return a named property for LibreOffice."""
    item = PropertyValue()
    item.Name, item.Value = name, value
    return item


def apply_edit(document, edit: list) -> None:
    """Carry out one edit."""
    kind, sheet_name, *rest = edit
    sheet = document.Sheets.getByName(sheet_name)
    if kind == "type":
        cell = sheet.getCellRangeByName(rest[0])
        cell.FormulaLocal = rest[1]
    elif kind == "delete_row":
        sheet.Rows.removeByIndex(rest[0] - 1, 1)
    elif kind == "insert_column":
        sheet.Columns.insertByIndex(rest[0] - 1, 1)
    elif kind == "rename":
        sheet.Name = rest[0]


def main(source: str, target: str, edits: str) -> None:
    """Open, edit, save as .xlsx, close."""
    pipe = f"foldshell-{Path(target).parent.name}"
    with tempfile.TemporaryDirectory() as profile:
        office = subprocess.Popen(
            [
                "soffice",
                "--headless",
                "--norestore",
                f"-env:UserInstallation=file://{profile}",
                f"--accept=pipe,name={pipe};urp;",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            desktop = connect(pipe)
            for index, case in enumerate(json.loads(Path(edits).read_text())):
                hidden = (set_property("Hidden", True),)
                url = uno.systemPathToFileUrl(str(Path(source).resolve()))
                document = desktop.loadComponentFromURL(url, "_blank", 0, hidden)
                for edit in case:
                    apply_edit(document, edit)
                out = Path(target).resolve() / f"{index}.xlsx"
                saved = (set_property("FilterName", "Calc MS Excel 2007 XML"),)
                document.storeToURL(uno.systemPathToFileUrl(str(out)), saved)
                document.close(True)
            desktop.terminate()
            office.wait(30)
        finally:
            if office.poll() is None:
                office.terminate()


if __name__ == "__main__":
    main(*sys.argv[1:])
