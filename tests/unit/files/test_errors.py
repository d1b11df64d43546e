"""Messages stay one readable line, whatever a file holds."""

import pickle

from foldshell.files.errors import InputError


def test_long_values_are_cut_and_the_rest_is_kept():
    text = str(InputError(f"a.tsv: line 3: span_m: '{'9' * 5000}': a number is allowed"))
    assert len(text) < 200
    assert text.startswith("a.tsv: line 3: span_m: '999") and text.endswith(
        "9': a number is allowed"
    )
    prose = str(InputError(f"a.tsv: {'word ' * 5000}: a number is allowed"))
    assert len(prose) < 1300 and prose.endswith("a number is allowed")


def test_characters_that_a_terminal_acts_on_are_written_out():
    text = str(InputError("a\x1b[31m\n\u202eb: größer ≤ 5"))
    assert text == "a\\x1b[31m\\n\\u202eb: größer ≤ 5"


def test_a_usual_message_is_as_it_was_also_from_another_process():
    error = InputError("/a/long/folder/of/a/person/designs.tsv: line 3: 5: at most 4 are allowed")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    assert str(error).endswith("at most 4 are allowed")
