"""Records of jobs under object storage name files as a run without one does."""

from types import SimpleNamespace

import pytest

from foldshell.engine.job import describe_job
from foldshell.files.whole import hash_data

PLACES = ["results", ".snakemake/storage/s3/bucket/prefix/results"]


@pytest.mark.parametrize("place", PLACES)
def test_results_of_designs_are_named_as_without_a_storage(place, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    final, table = f"{place}/dome/sizing/final.json", f"{place}/studies/tiny/summary.csv"
    for path in (final, table, "config/designs.tsv"):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text("1")
    task = SimpleNamespace(
        rule="summary",
        wildcards={"tag": "tiny"},
        input={},
        output=[table],
        params={"results": place},
    )
    record = describe_job(task, {final: "a", "config/designs.tsv": "b"})
    assert record.external == {"results/dome/sizing/final.json": "a", "config/designs.tsv": "b"}
    assert list(record.outputs) == ["summary.csv"]
    assert record.params_sha256 == hash_data({"results": "results"})


def test_the_folder_of_the_run_is_in_no_record(tmp_path, monkeypatch):
    """The same job in two folders: its parameters are the same; another file's name stays."""
    hashes = []
    for name in ("here", "there"):
        folder = tmp_path / name
        folder.mkdir()
        monkeypatch.chdir(folder)
        params = {"project": str(folder), "lists": [f"{folder}/config/loads.tsv", "/opt/own.tsv"]}
        task = SimpleNamespace(rule="report", wildcards={}, input={}, output=["a"], params=params)
        (folder / "a").write_text("1")
        hashes.append(describe_job(task, {}).params_sha256)
    due = {"project": ".", "lists": ["config/loads.tsv", "/opt/own.tsv"]}
    assert hashes == [hash_data(due)] * 2
