"""Files of results in an object storage that no rule declares: records of jobs, seconds, and what a
loop in one job leaves. They go the way of declared ones, so that a bucket alone holds a study."""

import contextlib
import hashlib
import os
import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from foldshell.files.errors import InputError
from foldshell.files.libraries import need_library
from foldshell.files.whole import atomic_path

RECORDS = (
    r"(.+/)?jobs/[^/.]+\.json|(.+/)?seconds\.json|sizing/(\d\d/edited-|superseded/)[^/.]+[^/]*"
)
"""Paths in the folder of a design or study that no rule declares."""
WHOLE_LOOP = RECORDS + r"|sizing/\d\d/[^/.][^/]*"
"""The same where a loop is one job."""
EVERYTHING = r"(?s:.*)"
ITERATIONS = r"[^/]+/sizing/\d\d/(analysis|written)\.json"
"""In the folder of all results: what a summary says of edits."""
OF_ITERATIONS = r"sizing/\d\d/.+|jobs/(analyse|resize)-\d\d\.json"
"""In the folder of a design: what the end of a loop takes away of iterations that are left over."""
VARIABLES = {
    "region_name": "REGION",
    "aws_access_key_id": "ACCESS_KEY",
    "aws_secret_access_key": "SECRET_KEY",
    "aws_session_token": "TOKEN",
}
"""Arguments of boto3, and what follows SNAKEMAKE_STORAGE_S3_ in the environment."""
CONNECT_SECONDS = 5
ATTEMPTS = 3


@dataclass(frozen=True)
class StoredFile:
    """An object: size in bytes, MD5 where the storage says it, and when it was stored."""

    size: int
    etag: str
    stored: datetime

    def is_like(self, path: Path) -> bool:
        """Tell whether a file on this machine has the same content, as far as is known: an object
        that came in parts says no MD5 and is taken to be what is not newer than it."""
        state = path.stat()
        if state.st_size != self.size:
            return False
        if "-" in self.etag:
            return state.st_mtime <= self.stored.timestamp()
        return hashlib.md5(path.read_bytes(), usedforsecurity=False).hexdigest() == self.etag


@dataclass(frozen=True)
class StoredFolder:
    """A folder of results in a bucket, below `key`, and the folder `local` of its copies here.

    `client` is one of boto3 for S3; threads may share it.
    """

    client: Any
    bucket: str
    key: str
    local: Path

    def fetch(self, folder: str, pattern: str) -> list[str]:
        """Fetch files of a folder that are not here, or are newer there and others; return their
        names in the folder, which match the pattern whole."""
        fetched = []
        for name, there in self._list(folder):
            path = self.local / folder / name
            if not re.fullmatch(pattern, name):
                continue
            newer = not path.exists() or path.stat().st_mtime < there.stored.timestamp()
            if newer and not (path.exists() and there.is_like(path)):
                with atomic_path(path) as temporary:
                    self.client.download_file(self.bucket, self._join(folder, name), f"{temporary}")
                fetched.append(name)
        return fetched

    def store(self, folder: str, pattern: str, more: Iterable[str] = ()) -> list[str]:
        """Store files of a folder that are not there, or are others there; return their names in
        the folder, which match the pattern whole or are among `more`."""
        there, stored = dict(self._list(folder)), []
        for path in sorted((self.local / folder).rglob("*")):
            name = path.relative_to(self.local / folder).as_posix()
            if not (re.fullmatch(pattern, name) or name in more) or not path.is_file():
                continue
            if name not in there or not there[name].is_like(path):
                self.client.upload_file(str(path), self.bucket, self._join(folder, name))
                stored.append(name)
        return stored

    def take_away(self, folder: str, pattern: str) -> list[str]:
        """Remove objects of a folder that are not here; return their names in the folder, which
        match the pattern whole."""
        gone = [
            name
            for name, _ in self._list(folder)
            if re.fullmatch(pattern, name) and not (self.local / folder / name).exists()
        ]
        for name in gone:
            self.client.delete_object(Bucket=self.bucket, Key=self._join(folder, name))
        return gone

    def _list(self, folder: str) -> Iterator[tuple[str, StoredFile]]:
        prefix = f"{self._join(folder)}/"
        pages = self.client.get_paginator("list_objects_v2")
        for page in pages.paginate(Bucket=self.bucket, Prefix=prefix):
            for one in page.get("Contents", ()):
                name = one["Key"].removeprefix(prefix)
                if name and not name.endswith("/"):
                    yield name, StoredFile(one["Size"], one["ETag"].strip('"'), one["LastModified"])

    def _join(self, *parts: str) -> str:
        return posixpath.normpath(posixpath.join(self.key, *parts))


def open_stored(
    prefix: str, results: str, local: str | Path, endpoint: str, environment: Mapping[str, str]
) -> StoredFolder:
    """Return the folder `results` below `prefix`, s3://BUCKET/FOLDER, of the storage at `endpoint`.

    `local` is the folder of the copies of `results`; keys are taken from the environment, by the
    names that Snakemake has for them, else from where boto3 finds them.
    """
    boto3, parts = need_library("boto3", "storage"), urlsplit(prefix)
    config = need_library("botocore.config", "storage").Config(
        connect_timeout=CONNECT_SECONDS, retries={"max_attempts": ATTEMPTS, "mode": "standard"}
    )
    found = {
        argument: environment.get(f"SNAKEMAKE_STORAGE_S3_{name}")
        for argument, name in VARIABLES.items()
    }
    found = {argument: value for argument, value in found.items() if value}
    os.environ.setdefault("AWS_REQUEST_CHECKSUM_CALCULATION", "when_required")
    os.environ.setdefault("AWS_RESPONSE_CHECKSUM_VALIDATION", "when_required")
    fields = {"region_name": "us-east-1", **found}
    client = boto3.session.Session().client("s3", endpoint_url=endpoint, config=config, **fields)
    key = posixpath.normpath(posixpath.join(parts.path.lstrip("/"), results.lstrip("/")))
    return StoredFolder(client, parts.netloc, key, Path(local))


@contextlib.contextmanager
def storage_errors(folder: StoredFolder) -> Iterator[None]:
    """Raise `InputError`, one sentence, for all that goes wrong with a storage in the block."""
    errors = need_library("botocore.exceptions", "storage")
    failed = need_library("boto3.exceptions", "storage").Boto3Error
    try:
        yield
    except (errors.BotoCoreError, errors.ClientError, failed) as error:
        said = " ".join(str(error).split())
        raise InputError(f"s3://{folder.bucket}/{folder.key}: the storage says: {said}") from None
