import json
import os
import stat

import pytest
from hypothesis import given
from hypothesis import strategies as st

from xsec_sym.record.files import layout, writing


def test_whole_or_not_at_all(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")
    path.chmod(0o640)
    with pytest.raises(RuntimeError), writing(path) as out:
        out.write("half")
        raise RuntimeError
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["a.txt"]
    with writing(path) as out:
        out.write("new")
    assert path.read_text() == "new" and stat.S_IMODE(path.stat().st_mode) == 0o640


def test_links_and_devices_stay_what_they_are(tmp_path):
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    with writing(tmp_path / "link") as out:
        out.write("new")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "real").read_text() == "new"
    with writing("/dev/null") as out:
        out.write("gone")


@pytest.mark.parametrize("name", ["", "no/where/a.txt", "file/a.txt"])
def test_what_cannot_be_written_fails_at_once(tmp_path, name):
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError), writing(tmp_path / name):
        pytest.fail("the block must not run")


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(), lambda v: st.lists(v) | st.dictionaries(st.text(), v)
)


@given(JSON)
def test_layout_is_json(value):
    assert json.loads(layout(value)) == value
