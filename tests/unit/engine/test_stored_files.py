"""Undeclared files of a storage, by a client that keeps objects in memory."""

import hashlib
import os
from datetime import UTC, datetime, timedelta

import pytest

from foldshell.engine.stored_files import (
    EVERYTHING,
    OF_ITERATIONS,
    RECORDS,
    WHOLE_LOOP,
    StoredFolder,
)

NOW = datetime.now(UTC)


class Client:
    """Objects {key: (bytes, time)} of one bucket, by the calls of boto3 that are made."""

    def __init__(self):
        self.objects = {}

    def get_paginator(self, name):
        assert name == "list_objects_v2"
        return self

    def paginate(self, Bucket, Prefix):
        found = [key for key in sorted(self.objects) if key.startswith(Prefix)]
        for key in found or ():  # a page for each
            data, stored = self.objects[key]
            etag = f'"{hashlib.md5(data).hexdigest()}"'
            one = {"Key": key, "Size": len(data), "ETag": etag, "LastModified": stored}
            yield {"Contents": [one]}
        yield {}

    def download_file(self, bucket, key, path):
        with open(path, "wb") as stream:
            stream.write(self.objects[key][0])

    def delete_object(self, Bucket, Key):
        del self.objects[Key]

    def upload_file(self, path, bucket, key):
        with open(path, "rb") as stream:
            self.objects[key] = stream.read(), NOW


@pytest.fixture
def folder(tmp_path):
    files = {
        "dome/jobs/mesh.json": b"mesh",
        "dome/jobs/.writing-1-draw.json": b"half",
        "dome/sizing/00/analysis.json": b"first",
        "dome/sizing/00/seconds.json": b"1",
        "dome/sizing/00/edited-ab.xlsx": b"by hand",
        "dome/design.vtu": b"declared",
        "other/jobs/mesh.json": b"other",
    }
    for name, data in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(data)
    return StoredFolder(Client(), "shells", "mine/results", tmp_path)


def test_records_are_stored_once_and_what_a_whole_loop_leaves(folder):
    beside = ["jobs/mesh.json", "sizing/00/edited-ab.xlsx", "sizing/00/seconds.json"]
    assert folder.store("dome", RECORDS) == beside
    assert folder.store("dome", RECORDS) == []
    assert folder.store("dome", WHOLE_LOOP) == ["sizing/00/analysis.json"]
    assert folder.client.objects["mine/results/dome/jobs/mesh.json"][0] == b"mesh"
    (folder.local / "dome/jobs/mesh.json").write_bytes(b"mesh again")
    assert folder.store("dome", RECORDS) == ["jobs/mesh.json"]


def test_a_new_machine_has_what_was_stored(folder, tmp_path):
    folder.store("dome", WHOLE_LOOP)
    folder.store("other", RECORDS)
    other = StoredFolder(folder.client, "shells", "mine/results", tmp_path / "new")
    assert other.fetch("dome", RECORDS) == [
        "jobs/mesh.json",
        "sizing/00/edited-ab.xlsx",
        "sizing/00/seconds.json",
    ]
    assert other.fetch("", EVERYTHING) == ["dome/sizing/00/analysis.json", "other/jobs/mesh.json"]
    assert other.fetch("", EVERYTHING) == []
    assert (other.local / "dome/sizing/00/analysis.json").read_bytes() == b"first"


def test_iterations_that_are_left_over_go(folder):
    names = [
        "sizing/00/thickness.xlsx",
        "sizing/03/memory.npz",
        "jobs/analyse-03.json",
        "page.html",
    ]
    for name in names:
        folder.client.objects[f"mine/results/dome/{name}"] = b"old", NOW
    folder.fetch("dome", r"sizing/00/.*")
    assert folder.take_away("dome", OF_ITERATIONS) == ["jobs/analyse-03.json", names[1]]
    assert len(folder.client.objects) == 2 and folder.take_away("dome", OF_ITERATIONS) == []


@pytest.mark.parametrize(("later", "kept"), [(-60, b"mine"), (60, b"theirs")])
def test_the_newer_of_two_that_differ_is_taken(folder, later, kept):
    """So that a loop that was killed here goes on from what it has."""
    path = folder.local / "dome/jobs/mesh.json"
    path.write_bytes(b"mine")
    os.utime(path, (NOW.timestamp(), NOW.timestamp()))
    key = "mine/results/dome/jobs/mesh.json"
    folder.client.objects[key] = b"theirs", NOW + timedelta(seconds=later)
    folder.fetch("dome", RECORDS)
    assert path.read_bytes() == kept
