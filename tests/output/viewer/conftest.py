"""A browser, and a puzzle in it."""

import pytest

from meshjig.output.viewer.page import write_viewer
from tests.output.viewer.browser import Browser
from tests.output.viewer.viewing import opened, report_of, ring


@pytest.fixture(scope="session")
def wheel(tmp_path_factory):
    """The viewer's page of six spheres in a ring."""
    path = tmp_path_factory.mktemp("viewer") / "viewer.html"
    write_viewer(path, ring(), report_of(ring()), plates={"piece_002": 7})
    return path


@pytest.fixture(scope="session")
def desktop():
    """A browser on a desk."""
    with Browser(900, 600) as browser:
        yield browser


@pytest.fixture
def page(desktop, wheel):
    """The ring in that browser, freshly loaded; nothing may have gone wrong with it in the end."""
    yield opened(desktop, wheel)
    assert desktop.errors == []
