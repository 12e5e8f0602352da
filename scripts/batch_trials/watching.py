"""What a batch leaves running, and how much memory it holds."""

import os
import statistics
import time
from pathlib import Path

import psutil


def tree(pid: int) -> list[psutil.Process]:
    """List a process and all below it."""
    try:
        process = psutil.Process(pid)
        return [process, *process.children(recursive=True)]
    except psutil.Error:
        return []


class Watcher:
    """Looks at a batch from time to time: memory of its client and workers, and who belonged to it."""

    def __init__(self, pid: int) -> None:
        self.pid, self.seen = pid, set()
        self.client, self.workers = [], {}

    def look(self) -> None:
        """Look once."""
        for process in tree(self.pid):
            try:
                self.seen.add(process)
                words = " ".join(process.cmdline())
                held = process.memory_info().rss / 1e6
            except psutil.Error:
                continue
            if "run_behind_front" in words and process.ppid() == self.pid:
                self.client.append(held)
            elif "spawn_main" in words:
                self.workers.setdefault(process.pid, []).append(held)

    def watch(self, process, every: float = 2.0, seconds: float = 1e9) -> None:
        """Look until it ends."""
        end = time.monotonic() + seconds
        while process.poll() is None and time.monotonic() < end:
            self.look()
            time.sleep(every)

    def said(self) -> str:
        """Give the memory in the first and in the last tenth, and the most, MB."""
        lines = [f"client: {_course(self.client)}"]
        lines += [f"worker {pid}: {_course(held)}" for pid, held in self.workers.items() if len(held) > 5]
        return "\n".join(lines)

    def left(self) -> list[str]:
        """Name those that are still there."""
        time.sleep(2)
        found = []
        for process in self.seen:
            try:
                if process.is_running() and process.status() != psutil.STATUS_ZOMBIE:
                    found.append(f"{process.pid} {' '.join(process.cmdline())[-150:]}")
            except psutil.Error:
                continue
        return found


def _course(held: list[float]) -> str:
    if len(held) < 3:
        return "not seen"
    tenth = max(1, len(held) // 10)
    early = held[len(held) // 20 : len(held) // 20 + tenth] or held[:1]
    return (
        f"{statistics.median(early):.0f} MB in the beginning,"
        f" {statistics.median(held[-tenth:]):.0f} MB in the end, {max(held):.0f} MB at most"
    )


def running(text: str) -> list[str]:
    """Name other processes whose command line or current folder has a text in it."""
    found, ours = [], {os.getpid(), *(p.pid for p in psutil.Process().parents())}
    for process in psutil.process_iter():
        try:
            if process.pid in ours or process.status() == psutil.STATUS_ZOMBIE:
                continue
            if text in " ".join(process.cmdline()) or text in process.cwd():
                found.append(f"{process.pid} {' '.join(process.cmdline())[-150:]}")
        except psutil.Error:
            continue
    return found


def leftovers(folder: Path) -> list[str]:
    """Name what is in a folder for temporary files."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))
