"""Options as TOML: what is read back is what was written."""

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from meshjig.fleet.toml_text import toml_text

text = st.text(st.characters(exclude_categories=["Cs"]))
value = st.booleans() | st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False) | text | st.lists(text)
table = st.dictionaries(text, st.integers(0, 9) | st.floats(0, 1), max_size=3)


@given(
    st.dictionaries(st.from_regex(r"[a-z_]+", fullmatch=True), value),
    st.dictionaries(text, table, max_size=3),
)
def test_what_is_written_is_read_back(options, processes):
    written = toml_text({**options, "left_out": None, "ZZ": processes})
    expected = {key: list(v) if isinstance(v, tuple) else v for key, v in options.items()}
    assert tomllib.loads(written) == expected | ({"ZZ": processes} if processes else {})
