"""Run the command line by ``python -m meshjig``."""

from meshjig.cli import main

main()
