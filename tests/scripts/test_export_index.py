"""Rule export_index: a list of the files that are there, or the command that makes them."""

import export_index
from foldshell.files.whole import write_json


def test_files_that_are_there_are_listed(tmp_path):
    record = {"format": "3dm", "holds": "panels & <creases>", "opens": "Rhino: File > Open",
              "files": {"a.3dm": {}, "b.3dm": {}}}  # fmt: skip
    write_json(tmp_path / "records/3dm.json", record)
    (tmp_path / "a.3dm").write_bytes(b"0" * 20_000)
    export_index.main([tmp_path / "records/3dm.json"], tmp_path / "index.html", design="roof")
    text = (tmp_path / "index.html").read_text()
    assert '<a href="a.3dm">a.3dm</a> <small>0.02 MB' in text and "b.3dm" not in text
    assert "panels &amp; &lt;creases&gt;" in text and "Rhino: File &gt; Open" in text


def test_without_files_the_command_is_said(tmp_path):
    export_index.main([], tmp_path / "index.html", design="roof")
    assert "snakemake --cores 2 export" in (tmp_path / "index.html").read_text()
