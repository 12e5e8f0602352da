"""A script: replace a folder again and again, hit by a signal before or after each call of the system.

It prints a line for every case: the signal, the call, what is in the target's place then, what was said of
it, what the next run puts there, and what is left beside it then.
"""

import json
import os
import signal
import sys
from contextlib import suppress
from pathlib import Path

from meshjig.output.folder import claim, replace_folder, system

CALLS = ("open", "write", "mkdir", "rename", "chmod", "ftruncate", "unlink", "rmdir")


def fill(folder, text):
    (folder / "report.json").write_text(json.dumps({"meshjig": "0", "kind": "puzzle", "text": text}))
    (folder / "pieces").mkdir()
    (folder / "pieces" / "a.stl").write_text(text)


def replace(target, text):
    with replace_folder(target) as folder:
        fill(folder, text)


def hit(number, nth, after):
    """Send this process a signal at the nth call, and give a list that counts the calls."""
    count = [0]

    def wrapped(call):
        def run(*words, **more):
            count[0] += 1
            mine = count[0] == nth
            if mine and not after:
                os.kill(os.getpid(), number)
            result = call(*words, **more)
            if mine and after:
                os.kill(os.getpid(), number)
            return result

        return run

    for name in CALLS:
        setattr(os, name, wrapped(getattr(os, name)))
    claim.exchange = wrapped(claim.exchange)
    return count


def whole(target):
    """Say which version is in place, wholly; or what is wrong."""
    try:
        text = json.loads((target / "report.json").read_text())["text"]
        return text if (target / "pieces/a.stl").read_text() == text else "mixed"
    except OSError as error:
        return repr(error)


def case(folder, number, nth, after):
    """Run one case in a process of its own; give the number of calls that it made."""
    target = folder / "out"
    told, telling = os.pipe()
    child = os.fork()
    if not child:
        written = []
        claim.tell = lambda word, value: written.append(word) if word == "written" else None
        count = hit(number, nth, after)
        with suppress(KeyboardInterrupt):
            replace(target, "new")
        os.write(telling, json.dumps([count[0], "new" if written else "old"]).encode())
        os._exit(0)
    os.close(telling)
    os.waitpid(child, 0)
    answer = os.read(told, 1000)
    os.close(told)
    return json.loads(answer) if answer else [None, None]


def main(folder, without_exchange):
    if without_exchange:
        claim.exchange = system.exchange = lambda *_: False
    replace(folder / "out", "old")
    calls, _ = case(folder, 0, 0, False)
    for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
        for nth in range(1, calls + 1):
            for after in (False, True):
                replace(folder / "out", "old")
                _, said = case(folder, number, nth, after)
                place = whole(folder / "out")
                replace(folder / "out", "next")
                left = [path.name for path in folder.iterdir()]
                print(json.dumps([number.name, nth, place, said, whole(folder / "out"), left]))


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2] == "without")
