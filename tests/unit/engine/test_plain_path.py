"""A folder with braces in its name is reached by a link without any."""

from foldshell.engine.plain_path import find_plain_path


def test_a_plain_folder_is_itself(tmp_path):
    assert find_plain_path(tmp_path) == tmp_path.resolve()


def test_braces_are_led_around_by_the_same_link_each_time(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path))
    folder = tmp_path / "br{a}ce"
    folder.mkdir()
    (folder / "file").write_text("x")
    link = find_plain_path(folder)
    assert "{" not in str(link) and (link / "file").read_text() == "x"
    assert find_plain_path(folder) == link


def test_a_link_of_somebody_else_is_not_taken(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    folder, other = tmp_path / "br{a}ce", tmp_path / "other"
    folder.mkdir()
    other.mkdir()
    link = find_plain_path(folder)
    link.unlink()
    link.symlink_to(other)
    found = find_plain_path(folder)
    assert found != link and found.resolve() == folder.resolve()
