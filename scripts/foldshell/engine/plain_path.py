"""A path without braces to a folder: Snakemake reads braces in paths of scripts as patterns."""

import hashlib
import os
import tempfile
from pathlib import Path


def find_plain_path(folder: str | Path) -> Path:
    """Return the folder itself, or a link to it from the folder of temporary files where its name
    has braces. The link has the same name in each run, so that nothing is made anew."""
    folder = Path(folder).resolve()
    if not set("{}") & set(str(folder)):
        return folder
    digest = hashlib.sha256(os.fsencode(folder)).hexdigest()[:12]
    link = Path(tempfile.gettempdir()) / f"foldshell-{os.getuid()}-{digest}"
    if not _leads_to(link, folder):
        link = Path(tempfile.mkdtemp(prefix="foldshell-")) / "code" if _is_there(link) else link
        link.symlink_to(folder, target_is_directory=True)
    return link


def _is_there(link: Path) -> bool:
    return link.is_symlink() or link.exists()


def _leads_to(link: Path, folder: Path) -> bool:
    """Tell whether a link is our own and leads to the folder."""
    ours = link.is_symlink() and link.lstat().st_uid == os.getuid()
    return ours and link.resolve() == folder
