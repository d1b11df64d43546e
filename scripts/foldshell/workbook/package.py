"""Open an .xlsx file that people or programs may have damaged, within bounded time and memory.

Nothing is unpacked before the zip directory has been checked, and no part is larger than stated.
"""

import io
import posixpath
import re
import struct
import zipfile
from dataclasses import dataclass
from lzma import LZMAError
from pathlib import Path
from xml.etree import ElementTree
from zlib import error as ZlibError

from foldshell.files.errors import InputError
from foldshell.files.whole import read_small_file

LARGEST_FILE = 10_000_000
LARGEST_PART = 6_000_000
LARGEST_TOTAL = 8_000_000
MOST_PARTS = 400
LARGEST_TABLE = 1_500_000
_PICTURES = "xl/media/"
_OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_DIRECTORY_ENTRY = b"PK\x01\x02"
_SAVE_AS = "save it as .xlsx"
_FOREIGN_PARTS = {
    "xl/externallinks/": "links to other workbooks",
    "xl/connections.xml": "connections to outside data",
    "xl/vbaproject.bin": "macros",
}
_RELATION = "{http://schemas.openxmlformats.org/package/2006/relationships}Relationship"
_MEMBER_ERRORS = (zipfile.BadZipFile, ZlibError, LZMAError, EOFError, NotImplementedError)
_MEMBER_ERRORS += (RuntimeError, ValueError, OverflowError, MemoryError, struct.error)
_ENCODING = re.compile(r"""<\?xml[^>]{0,200}?\sencoding\s*=\s*["']([^"']*)["']""")


@dataclass(frozen=True)
class Package:
    """A checked .xlsx file: its path for messages, and the XML text of its parts by name."""

    path: Path
    archive: zipfile.ZipFile

    def names(self) -> list[str]:
        """Return the names of all parts."""
        return self.archive.namelist()

    def read_part(self, name: str, largest: int = LARGEST_TABLE) -> str:
        """Return one part as text without a document type, which XML bombs need.

        `largest` bounds its size in bytes, and so the time and memory to go through it.
        """
        try:
            size = self.archive.getinfo(name).file_size
            if size > largest or _is_picture(name):
                raise InputError(
                    f"{self.path}: part {name}: {size / 1e6:.1f} MB: at most {largest / 1e6:.1f} "
                    "MB are allowed"
                )
            data = self.archive.read(name)
        except (*_MEMBER_ERRORS, KeyError, OSError) as error:
            raise InputError(f"{self.path}: part {name}: damaged ({error})") from None
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            raise InputError(f"{self.path}: part {name}: not UTF-8: {_SAVE_AS} anew") from None
        declared = _ENCODING.match(text)
        if declared and declared[1].casefold() not in ("utf-8", "utf8", "us-ascii", "ascii"):
            raise InputError(
                f"{self.path}: part {name}: encoding {declared[1][:40]!r}: UTF-8 is allowed, "
                f"{_SAVE_AS} anew"
            )
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            raise InputError(f"{self.path}: part {name}: holds a document type, none is allowed")
        return text

    def parse_part(self, name: str) -> ElementTree.Element:
        """Return the root element of a part."""
        text = self.read_part(name)
        try:
            return ElementTree.fromstring(text)
        except (ElementTree.ParseError, ValueError, LookupError) as error:
            raise InputError(f"{self.path}: part {name}: damaged ({error})") from None

    def find_sheets(self) -> dict[str, str]:
        """Return the part of each worksheet by the sheet's name, in the order of the tabs."""
        relations = {
            relation.get("Id"): relation.get("Target", "")
            for relation in self.parse_part("xl/_rels/workbook.xml.rels").iter(_RELATION)
        }
        sheets: dict[str, str] = {}
        for element in self.parse_part("xl/workbook.xml").iter():
            if not element.tag.endswith("}sheet"):
                continue
            name = element.get("name", "")
            key = next((key for key in element.attrib if key.endswith("}id")), "")
            target = relations.get(element.get(key), "")
            if name in sheets:
                raise InputError(f"{self.path}: sheet {name!r}: stands twice, only once is allowed")
            sheets[name] = posixpath.normpath(posixpath.join("/xl", target)).lstrip("/")
        return sheets


def open_package(path: str | Path) -> Package:
    """Read and check a whole .xlsx file.

    Raises `InputError` for a file that is missing, of another kind (.xls, encrypted, HTML, ODS),
    cut off, a zip bomb, with doubled entries, macros or links to outside data.
    """
    path = Path(path)
    data = read_small_file(path, LARGEST_FILE, "a workbook of thicknesses")
    _refuse_other_kinds(path, data)
    _check_count(path, data.count(_DIRECTORY_ENTRY))
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except (zipfile.BadZipFile, ValueError, OverflowError, NotImplementedError):
        raise InputError(
            f"{path}: the workbook is cut off or damaged: a whole .xlsx is due"
        ) from None
    _check_entries(path, archive.infolist())
    if "xl/workbook.xml" not in archive.namelist():
        ods = "mimetype" in archive.namelist()
        kind = "an OpenDocument file" if ods else "a zip file but not a workbook"
        raise InputError(f"{path}: {kind}: {_SAVE_AS}")
    return Package(path, archive)


def _refuse_other_kinds(path: Path, data: bytes) -> None:
    if data.startswith(b"PK\x03\x04"):
        return
    start = data[:300].lstrip(b"\xef\xbb\xbf \r\n\t").lower()
    if not data:
        kind = "an empty file"
    elif data.startswith(_OLE):
        encrypted = "EncryptedPackage".encode("utf-16-le") in data
        kind = "an encrypted workbook" if encrypted else "an old .xls workbook"
    elif start.startswith((b"<html", b"<!doctype", b"<table", b"<?xml")):
        kind = "an HTML or XML page"
    elif start.startswith(b"%pdf"):
        kind = "a PDF file"
    else:
        kind = "not an .xlsx workbook"
    advice = "remove the password" if "encrypted" in kind else _SAVE_AS
    raise InputError(f"{path}: {kind} under the name of a workbook: {advice}")


def _check_count(path: Path, count: int) -> None:
    if count > MOST_PARTS:
        raise InputError(f"{path}: {count} zip entries: at most {MOST_PARTS} are allowed")


def _check_entries(path: Path, entries: list[zipfile.ZipInfo]) -> None:
    _check_count(path, len(entries))
    seen: set[str] = set()
    for entry in entries:
        name = re.sub(r"/+", "/", entry.filename.replace("\\", "/")).lstrip("/").casefold()
        if name in seen:
            raise InputError(f"{path}: entry {entry.filename!r}: stands twice")
        seen.add(name)
        if entry.flag_bits & 0x1:
            raise InputError(f"{path}: entry {entry.filename!r}: encrypted, remove the password")
        if entry.file_size > LARGEST_PART and not _is_picture(entry.filename):
            raise InputError(
                f"{path}: entry {entry.filename!r}: {entry.file_size / 1e6:.0f} MB unpacked: "
                f"at most {LARGEST_PART / 1e6:.0f} MB is allowed"
            )
        for start, content in _FOREIGN_PARTS.items():
            if name.startswith(start):
                raise InputError(f"{path}: the workbook holds {content}: plain values are allowed")
    total = sum(entry.file_size for entry in entries if not _is_picture(entry.filename))
    if total > LARGEST_TOTAL:
        raise InputError(
            f"{path}: {total / 1e6:.0f} MB unpacked: {LARGEST_TOTAL / 1e6:.0f} MB are allowed"
        )


def _is_picture(name: str) -> bool:
    """Tell whether a part is a picture, which is never unpacked here."""
    return name.startswith(_PICTURES)
