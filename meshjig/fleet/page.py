"""index.html: a batch at a glance, failures first; it opens without a network."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from pathlib import Path
from urllib.parse import quote

from meshjig.errors import printable
from meshjig.fleet.record import FAILED, Record
from meshjig.fleet.tally import Tally
from meshjig.fleet.thumbnail import thumbnail_name

__all__ = ["MOST_ROWS", "write_page"]

MOST_ROWS = 5_000  # of a page; the table in summary.csv has all

_HEAD = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>meshjig batch</title>
<style>
:root { color-scheme: light dark; --line: #8884; --bad: #c62828; --warn: #b26a00; }
@media (prefers-color-scheme: dark) { :root { --bad: #ff8a80; --warn: #ffcc80; } }
body { font: 15px/1.45 system-ui, sans-serif; margin: 1.5rem auto; max-width: 75rem; padding: 0 1rem; }
h1 { font-size: 1.3rem; margin: 0 0 .3rem; }
h2 { font-size: 1.05rem; margin: 2rem 0 .6rem; }
table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; vertical-align: top; padding: .35rem .8rem .35rem 0;
  border-bottom: 1px solid var(--line); }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.name { overflow-wrap: anywhere; min-width: 8rem; }
.kind { color: var(--bad); font-weight: 600; white-space: nowrap; }
.warn { color: var(--warn); }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem; }
.card { border: 1px solid var(--line); border-radius: .5rem; padding: .6rem; overflow-wrap: anywhere; }
.card img { width: 100%; height: 7rem; object-fit: contain; background: #fff; border-radius: .3rem; }
.card small, p.note { opacity: .75; }
a { color: inherit; }
</style>
</head>
<body>
"""


def write_page(path: Path, records: Iterable[Record], tally: Tally, table: str) -> None:
    """Write the page.

    Parameters
    ----------
    path : Path
    records : iterable of Record, of which not all need be there
    tally : Tally, of all scans
    table : str, the name of the file that has all
    """
    failed: list[str] = []
    broken: list[str] = []
    good: list[str] = []
    for record in records:
        if record.outcome == FAILED:
            failed.append(_failure(record))
        else:
            (broken if record.broken else good).append(_card(record))
    shown = len(failed) + len(broken) + len(good)
    with path.open("w", encoding="utf-8", errors="xmlcharrefreplace") as file:
        file.write(_HEAD)
        file.write(f"<h1>{escape(str(tally))}</h1>\n")
        left = f"{tally.scans - shown} more are in " if tally.scans > shown else "All figures are in "
        file.write(f'<p class="note">{left}<a href="{_link(table)}">{escape(table)}</a>.</p>\n')
        if failed:
            file.write(f"<h2>Failed: {len(failed)}</h2>\n<table>\n<tr><th>scan</th><th>what</th>")
            file.write('<th>why</th><th class="n">seconds</th></tr>\n')
            file.writelines(failed)
            file.write("</table>\n")
        for title, cards in (("Made, with broken promises", broken), ("Made", good)):
            if cards:
                file.write(f'<h2>{title}: {len(cards)}</h2>\n<div class="grid">\n')
                file.writelines(cards)
                file.write("</div>\n")
        file.write("</body>\n</html>\n")


def _failure(record: Record) -> str:
    tried = f", {record.attempts} times" if record.attempts > 1 else ""
    return (
        f'<tr><td class="name" title="{escape(_shown(record.source))}">{escape(_shown(record.name))}</td>'
        f'<td class="kind">{escape(record.kind + tried)}</td><td>{escape(_shown(record.sentence))}</td>'
        f'<td class="n">{record.seconds:.1f}</td></tr>\n'
    )


def _card(record: Record) -> str:
    folder, picture = _link(record.name), _link(thumbnail_name(record.name))
    files = [*record.shows, "report.json"]
    links = [f'<a href="{folder}/{file}">{file.partition(".")[0]}</a>' for file in files]
    size = " x ".join(f"{x:.0f}" for x in record.size_mm)
    promises = (
        f'<br><span class="warn">broken: {escape(", ".join(record.broken))}</span>' if record.broken else ""
    )
    name = escape(_shown(record.name))
    return (
        f'<div class="card"><a href="{folder}/{files[0]}"><img src="{picture}" alt="" loading="lazy"></a>'
        f"<b>{name}</b>{promises}<br>{record.pieces} pieces, {size} mm<br>"
        f"<small>{record.faces} faces, {record.seconds:.1f} s, {record.peak_mb:.0f} MB</small><br>"
        f"{' &middot; '.join(links)}</div>\n"
    )


def _link(name: str) -> str:
    return quote(name, safe="/", errors="surrogateescape")


def _shown(text: str) -> str:
    return printable(text.encode("utf-8", "backslashreplace").decode())
