"""The minute of a report: now, or the one that the environment fixes."""

from foldshell.report.provenance import find_provenance


def test_the_minute_can_be_fixed(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")  # 2023-11-14T22:13:20Z by `date -u -d @`
    assert find_provenance(tmp_path).made == "14 November 2023, 22:13 UTC"
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    assert find_provenance(tmp_path).made != "14 November 2023, 22:13 UTC"
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    assert find_provenance(tmp_path).made.endswith("UTC")
