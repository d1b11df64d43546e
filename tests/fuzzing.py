"""Damage for fuzz tests: of bytes, of lines and words, and of trees of plain data."""

from hypothesis import HealthCheck
from hypothesis import strategies as st

FUZZ = {
    "deadline": None,
    "suppress_health_check": [HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
}
WORDS = [
    "", "-1", "0", "1", "3", "1e999", "-1e-999", "nan", "inf", "1,5", "1_0", "0x10", "010",
    "1.", ".5", "+2", "--1", "1e", "9" * 30, "9" * 5000, "true", "null", "~", "[", "]", "{", "}",
    "\u0663", "\u00bd", "a\u202eb", "'", '"', ":", "&a", "*a", "!!int", "- 1", "\\", "/", "#",
    "{design}",
    "=1+1", "<b>", "%s", "$(id)", "../x", "15.0", "9.0", "1e1", "28 m", "28,5",
]  # fmt: skip
WORD = st.one_of(st.sampled_from(WORDS), st.text(max_size=6), st.floats().map(repr),
                 st.integers(-(10**20), 10**20).map(str))  # fmt: skip
PLACE = st.floats(0, 1, exclude_max=True)
BYTE_EDITS = st.lists(
    st.one_of(
        st.tuples(st.just("set"), PLACE, st.binary(min_size=1, max_size=4)),
        st.tuples(st.just("insert"), PLACE, st.binary(min_size=1, max_size=8)),
        st.tuples(st.just("delete"), PLACE, st.integers(1, 40)),
        st.tuples(st.just("cut"), PLACE),
        st.tuples(st.just("flip"), PLACE, st.integers(0, 7)),
    ),
    min_size=1, max_size=6,
)  # fmt: skip
LINE_EDITS = st.lists(
    st.one_of(
        st.tuples(st.just("word"), PLACE, PLACE, WORD),
        st.tuples(st.just("add"), PLACE, PLACE, WORD),
        st.tuples(st.sampled_from(["drop", "twice", "swap", "blank"]), PLACE, PLACE),
        st.tuples(st.just("glue"), PLACE, PLACE),
    ),
    min_size=1, max_size=5,
)  # fmt: skip


def edit_bytes(data: bytes, edits) -> bytes:
    """Apply edits of bytes."""
    found = bytearray(data)
    for kind, place, *more in edits:
        at = int(place * max(len(found), 1))
        if kind == "set":
            found[at : at + len(more[0])] = more[0]
        elif kind == "insert":
            found[at:at] = more[0]
        elif kind == "delete":
            del found[at : at + more[0]]
        elif kind == "cut":
            del found[at:]
        elif at < len(found):
            found[at] ^= 1 << more[0]
    return bytes(found)


def edit_lines(text: str, edits, gap: str = " ") -> str:
    """Apply edits of lines and of words, which `gap` separates."""
    lines = text.split("\n")
    for kind, row, column, *more in edits:
        at = int(row * len(lines))
        words = lines[at].split(gap)
        place = int(column * len(words))
        other = int(column * len(lines))
        if kind == "word":
            words[place] = more[0]
            lines[at] = gap.join(words)
        elif kind == "add":
            words.insert(place, more[0])
            lines[at] = gap.join(words)
        elif kind == "drop" and len(lines) > 1:
            del lines[at]
        elif kind == "twice":
            lines.insert(other, lines[at])
        elif kind == "swap":
            lines[at], lines[other] = lines[other], lines[at]
        elif kind == "blank":
            lines.insert(at, "")
        elif kind == "glue" and at + 1 < len(lines):
            lines[at : at + 2] = [lines[at] + lines[at + 1]]
    return "\n".join(lines)


LEAVES = st.one_of(
    st.none(), st.booleans(), st.floats(), st.integers(-(10**20), 10**20), st.text(max_size=5),
    st.sampled_from([[], {}, [[]], [1], {"a": 1}, "1", "nan", 10**400, -0.0, 1.0, 15.0, 3, 0]),
)  # fmt: skip
TREE_EDITS = st.lists(
    st.tuples(st.sampled_from(["set", "drop", "twice"]), st.lists(PLACE, min_size=1, max_size=5),
              LEAVES),
    min_size=1, max_size=3,
)  # fmt: skip


def edit_tree(data, edits):
    """Apply edits to a deep copy of plain dicts and lists: a path of shares leads to the place."""
    import copy

    found = copy.deepcopy(data)
    for kind, path, leaf in edits:
        node = found
        for depth, share in enumerate(path):
            keys = list(node) if isinstance(node, dict) else range(len(node))
            if not len(keys):
                break
            key = keys[int(share * len(keys))]
            child = node[key]
            if depth + 1 < len(path) and isinstance(child, dict | list) and len(child):
                node = child
                continue
            if kind == "drop":
                del node[key]
            elif kind == "twice" and isinstance(node, list):
                node.insert(key, child)
            else:
                node[key] = copy.deepcopy(leaf)
            break
    return found


def is_one_sentence(error, path) -> bool:
    """Whether a refusal names the file and is one line, not endless."""
    text = str(error)
    return text.startswith(str(path)) and "\n" not in text and len(text) < 1000
