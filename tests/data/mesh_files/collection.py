"""All mesh files: formats x flavours x damages, each with the answer that is due.

`python tests/data/mesh_files/collection.py FOLDER` writes them, with `answers.tsv` beside them.
"""

import sys
import tempfile
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from data.mesh_files.library_formats import msh_files, spoilt_files, vtk_files, xml_files
from data.mesh_files.patch import spoil
from data.mesh_files.ply_files import pack, ply_files, write_text
from data.mesh_files.text_formats import (
    Files,
    obj_files,
    off_files,
    pack_stl,
    stl_files,
    write_obj,
    write_stl,
)

SUFFIXES = (".stl", ".obj", ".ply", ".off", ".vtk", ".vtu", ".vtp", ".msh")
OWN = SUFFIXES[:4]
"""Formats that the project reads itself; the others need a process each."""
DISGUISES = {
    "empty": (b"", "empty"),
    "blank": (b"\n \n\0\0", "empty"),
    "web_page": (b"<!DOCTYPE html>\n<html><body>not found</body></html>", "a web page"),
    "lfs_pointer": (
        b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
        "Git LFS pointer",
    ),
    "zip": (b"PK\x03\x04" + bytes(90), "zip archive"),
    "gzip": (b"\x1f\x8b\x08" + bytes(90), "compressed"),
    "utf16": ("v 0 0 0\n".encode("utf-16"), "UTF-16"),
    "words": (b"this is not a mesh, whatever its name says\n" * 9, "."),
    "step": (b"ISO-10303-21;\nHEADER;\n", "STEP"),
}


def make_files(suffix: str, folder: Path) -> Files:
    """All files of one format by name; `folder` is for what libraries write on the way."""
    special = {".stl": stl_files, ".obj": obj_files, ".ply": ply_files, ".off": off_files}
    if suffix in special:
        files = special[suffix]()
    elif suffix == ".vtk":
        files = vtk_files(folder)
    elif suffix == ".msh":
        files = msh_files(folder)
    else:
        files = xml_files(folder, suffix)
    files |= {f"{name}{suffix}": case for name, case in DISGUISES.items()}
    other = write_text().encode() if suffix != ".ply" else write_obj(head="OFF").encode()
    named = "its content is PLY" if suffix != ".ply" else "."
    files[f"other_format{suffix}"] = (other, named)
    return files | _spoilt(suffix, folder)


def _spoilt(suffix: str, folder: Path) -> Files:
    files: Files = {}
    for stem, (patch, reason) in spoil().items():
        if suffix == ".stl":
            reason = reason.replace("at most 1e9", "single precision|at most 1e9")
            files[f"{stem}.stl"] = (write_stl(patch).encode(), reason)
            files[f"binary_{stem}.stl"] = (pack_stl(patch), reason)
        elif suffix == ".obj":
            files[f"{stem}.obj"] = (write_obj(patch).encode(), reason)
        elif suffix == ".ply":
            files[f"{stem}.ply"] = (pack(patch), reason)
        elif suffix == ".off":
            lines = [f"OFF {len(patch.vertices)} {len(patch.polygons)} 0"]
            lines += [" ".join(map(repr, row)) for row in patch.vertices.tolist()]
            lines += ["3 " + " ".join(map(str, p)) for p in patch.polygons]
            files[f"{stem}.off"] = (("\n".join(lines) + "\n").encode(), reason)
        else:
            found = spoilt_files(folder, patch, stem, reason)
            files[f"{stem}{suffix}"] = found[f"{stem}{suffix}"]
    return files


def main(folder: str) -> None:
    """Write every file into `folder`."""
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    lines = ["file\tdue"]
    with tempfile.TemporaryDirectory() as scratch:
        for suffix in SUFFIXES:
            for name, (data, due) in make_files(suffix, Path(scratch)).items():
                (target / name).write_bytes(data)
                lines.append(f"{name}\t{due if isinstance(due, int) else 'refused: ' + due}")
    (target / "answers.tsv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
