"""A damaged line of an OBJ file once reached the terminal with the codes that it held."""

import json

import pytest

from meshjig.cli import commands
from meshjig.cli.run import exit_code


@pytest.mark.parametrize("command", ["info", "make"])
def test_codes_of_a_damaged_line_move_no_cursor(tmp_path, capsys, monkeypatch, command):
    monkeypatch.setattr(commands, "set_verbosity", lambda *given, **more: None)
    path = tmp_path / "esc.obj"
    path.write_bytes(b"v \x1b]0;pwned\x07\x1b[31m\nf 1 2 3")
    more = ["-o", str(tmp_path / "out")] if command == "make" else []
    assert exit_code([command, str(path), *more, "--json"]) == 4
    said = capsys.readouterr()
    assert len(said.err.splitlines()) == 1
    assert not set(said.err.rstrip("\n") + said.out) & {"\x1b", "\x07"}
    assert json.loads(said.out)["error"]["kind"] == "input"
