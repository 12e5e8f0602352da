"""Run the command line: by the script ``meshjig``, or by ``python -m meshjig``."""

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:  # the time to import typing is time in which no signal is heard
    from typing import NoReturn

__all__ = ["main"]


def main() -> "NoReturn":
    """Run the command line."""
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # they are foreign, and may be damaged
    if hasattr(os, "posix_spawn") and sys.executable:
        from meshjig.cli.front import run_in_front

        run_in_front()
    from meshjig.cli.run import run

    run(sys.argv[1:])


if __name__ == "__main__":
    main()
