"""Which version of meshjig runs."""

from importlib.metadata import PackageNotFoundError, version

__all__ = ["meshjig_version"]


def meshjig_version() -> str:
    """Give the installed version."""
    try:
        return version("meshjig")
    except PackageNotFoundError:
        return "unknown"
