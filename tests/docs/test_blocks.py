"""Every command and every program of the README and of docs/ runs."""

import shutil
import sys
import tomllib

import pytest
import trimesh

import meshjig
from meshjig.options import Options
from tests.docs.blocks import PAGES, ROOT, blocks, fewer, lines, run, shim

SET_UP = (
    "pip install",
    "sudo ",
    "brew ",
    "python3 -m venv",
    ". jigsaw/",
)  # for a machine of its own
OTHER = {"", "text", "powershell", "{toctree}", "{eval-rst}", "{options-table}"}  # nothing to run here
DEFAULTS = " --no-viewer --no-guide"  # what a page leaves on, and would only cost time here


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """A light scan."""
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    mesh = meshjig.read_scan(ROOT / "data" / "duck.ply", faces=2000).mesh
    trimesh.Trimesh(mesh.V, mesh.F, process=False).export(path)
    return path


def installed(project, site):
    """Do what pip would with a small package: its entry points become known."""
    name, version = project["project"]["name"], project["project"]["version"]
    info = site / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    points = ""
    for group, names in project["project"]["entry-points"].items():
        points += f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in names.items())
    (info / "entry_points.txt").write_text(points)


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_what_a_page_shows_runs(page, scan, tmp_path):
    site = tmp_path / "site"
    site.mkdir()
    shim(tmp_path)
    shutil.copy(scan, tmp_path)
    found = blocks(page)
    for block in found:
        if block.file:
            (site / block.file).write_text(block.text)
    if (site / "pyproject.toml").exists():
        installed(tomllib.loads((site / "pyproject.toml").read_text()), site)
    for block in found:
        if block.language in ("sh", "bash"):
            for line in lines(block.text):
                try_command(line, tmp_path)
        elif block.language == "toml" and not block.file:
            try_options(block.text)
        elif block.language != "python":
            assert block.language in OTHER | {"toml"}, f"who runs {block.language}?"
    program = "\n".join(fewer(block.text) for block in found if block.language == "python" and not block.file)
    if program:
        said = run([sys.executable, "-W", "error", "-c", program], tmp_path)
        assert said.returncode == 0, said.stderr


def try_command(line, folder):
    """Run a command; of what sets up a machine, only see that it is there."""
    if line.startswith(SET_UP):
        return
    if line.startswith("scripts/"):
        script = ROOT / line.split()[0]
        assert script.stat().st_mode & 0o111, line
        return
    line = fewer(line)
    if " make " in line and "--dry-run" not in line:
        head, _, rest = line.partition(" > ")
        line = head + DEFAULTS + (f" > {rest}" if rest else "")
    said = run(["bash", "-c", line], folder)
    assert said.returncode in (0, 3), f"{line}: {said.stderr}"


def try_options(text):
    """Read a config file as the command line does."""
    given = {key.replace("-", "_"): value for key, value in tomllib.loads(text).items()}
    assert Options.of(**given)


def test_every_page_is_in_a_table_of_contents():
    named = [
        line.strip()
        for block in blocks(ROOT / "docs" / "index.md")
        if block.language == "{toctree}"
        for line in block.text.splitlines()
        if line.strip() and not line.startswith(":")
    ]
    pages = {str(page.relative_to(ROOT / "docs").with_suffix("")) for page in PAGES if page.parent != ROOT}
    assert sorted(named) == sorted(pages - {"index"})


def test_pictures_are_small_and_all_shown():
    pictures = list((ROOT / "docs" / "pictures").iterdir())
    assert sum(picture.stat().st_size for picture in pictures) < 1.5e6
    assert max(picture.stat().st_size for picture in pictures) < 300e3
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for picture in pictures:
        assert f"pictures/{picture.name}" in text, picture.name


@pytest.mark.slow
def test_the_pages_build_without_a_warning(tmp_path):
    pytest.importorskip("sphinx")
    words = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    said = run([*words, "-d", str(tmp_path / "tree"), str(ROOT / "docs"), str(tmp_path / "html")], tmp_path)
    assert said.returncode == 0, said.stderr
    options = (tmp_path / "html" / "api.html").read_text(encoding="utf-8")
    assert all(f">{name}</span>" in options for name in Options.model_fields)
