"""The metadata of an archive by the validator of the RO-Crate community, without a network.

Profiles at REQUIRED: RO-Crate 1.1, Workflow RO-Crate 1.0, Process, Workflow and Provenance Run
Crate 0.5 (those of the wheel of roc-validator). The one context that they ask for is in tests/data.
"""

from pathlib import Path

import pytest
import requests

pytest.importorskip("bagit", reason="envs/archive.lock is not installed")
pytest.importorskip("rocrate_validator", reason="roc-validator is not installed")

from rocrate_validator.services import validate
from rocrate_validator.utils.http import HttpRequester

from archive_case import make_study, with_a_surface_file, with_an_edit, write
from foldshell.archive.check import unpack

CONTEXTS = {
    "https://w3id.org/ro/crate/1.1/context": "ro-crate-1.1-context.jsonld",
}
DATA = Path(__file__).parents[2] / "data/ro_crate"
PROFILES = (
    "ro-crate-1.1",
    "workflow-ro-crate-1.0",
    "process-run-crate-0.5",
    "workflow-run-crate-0.5",
    "provenance-run-crate-0.5",
)


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """An archive with an edit by hand and a surface file in it, unpacked."""
    folder = tmp_path_factory.mktemp("archive")
    study = make_study(folder)
    with_an_edit(study)
    with_a_surface_file(study)
    return unpack(write(study, folder / "t.zip"), folder / "out")


def answer(_, url, *args, **kwargs):
    """Answer as the network would for what is stored here, with 504 for all else."""
    response = requests.Response()
    name = CONTEXTS.get(url.rstrip("/"))
    response.status_code = 200 if name else 504
    response._content = (DATA / name).read_bytes() if name else b""
    response.headers["Content-Type"] = "application/ld+json"
    response.url = url
    return response


@pytest.mark.slow
@pytest.mark.parametrize("profile", PROFILES)
def test_profile(bag, profile, monkeypatch):
    monkeypatch.setattr(HttpRequester, "get", answer, raising=False)
    monkeypatch.setattr(HttpRequester, "head", answer, raising=False)
    result = validate(
        {
            "rocrate_uri": bag / "data",
            "profile_identifier": profile,
            "requirement_severity": "REQUIRED",
            "skip_availability_check": True,
        }
    )
    said = [f"{issue.check.identifier}: {issue.message}" for issue in result.get_issues()]
    assert said == []


@pytest.mark.slow
def test_the_validator_is_heard(bag, monkeypatch):
    """A crate without a licence is not let pass: the checks above do run."""
    monkeypatch.setattr(HttpRequester, "get", answer, raising=False)
    metadata = bag / "data/ro-crate-metadata.json"
    text = metadata.read_text()
    try:
        metadata.write_text(text.replace('"datePublished"', '"dateOfNothing"'))
        result = validate({"rocrate_uri": bag / "data", "profile_identifier": "ro-crate-1.1"})
        assert not result.passed()
    finally:
        metadata.write_text(text)
