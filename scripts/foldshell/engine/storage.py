"""Whether the object storage answers that results are kept in."""

import socket
from collections.abc import Mapping, Sequence
from urllib.parse import urlsplit

PUBLIC = "https://s3.amazonaws.com"
VARIABLE = "SNAKEMAKE_STORAGE_S3_ENDPOINT_URL"
OPTION = "--storage-s3-endpoint-url"
PORTS = {"https": 443, "http": 80}
PATIENCE = 5.0
"""Seconds until a server counts as gone."""


def find_endpoint(environment: Mapping[str, str], arguments: Sequence[str]) -> str:
    """Return the address of the storage, from a command line or the environment, else the public
    one."""
    for number, word in enumerate(arguments):
        name, _, value = word.partition("=")
        if name == OPTION:
            return value or next(iter(arguments[number + 1 :]), PUBLIC)
    return environment.get(VARIABLE) or PUBLIC


def describe_silence(url: str, place: str) -> str:
    """Return a sentence where a storage does not answer, empty where it does.

    `url` is its address, `place` what is kept there.
    """
    parts = urlsplit(url if "//" in url else f"//{url}")
    try:
        address = parts.hostname or url, parts.port or PORTS.get(parts.scheme, PORTS["https"])
        with socket.create_connection(address, timeout=PATIENCE):
            return ""
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        return (
            f"the storage of {place}, {url}, does not answer ({reason}): nothing that is stored "
            "there is lost; start again when it does"
        )
