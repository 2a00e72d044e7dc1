# SPDX-License-Identifier: BSD-3-Clause
"""Does some of the cases, each in a fork of this process, which has the package loaded once for all.

    pvpython worker.py FIRST STEP GROUPS PATTERN EVERY      of every EVERY-th case that PATTERN finds, FIRST, FIRST + STEP, ...;
                                                            a line of JSON for each
"""
import importlib
import json
import os
import pathlib
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python")]

import judge  # noqa: E402
import warm  # noqa: E402
from case import LEAF, synthesize  # noqa: E402
from waft import cli, loading  # noqa: E402

ADDRESS_SPACE = 8 << 30  # bytes
PROCESSOR_SECONDS = 20
ASLEEP_SECONDS = 6.0  # a process that does nothing for so long waits for what will not come
WALL_SECONDS = 900.0


def picture_of(folder):
    """What is in a folder, so that a change of anything is seen."""
    found = {}
    for path in sorted(folder.rglob("*")):
        about = path.lstat()
        is_folder = path.is_dir() and not path.is_symlink()
        found[str(path.relative_to(folder))] = (0, 0, 0) if is_folder else (about.st_size, about.st_mtime_ns, about.st_ino)
    return found


def changes(before, after):
    return [f"+{name}" for name in after if name not in before] + [
        name for name in before if after.get(name) != before[name]]


def in_child(case, arguments, folder, said):
    """Never returns."""
    os.setsid()

    def act():
        os.environ.update(case.environment)
        limits = {resource.RLIMIT_AS: ADDRESS_SPACE, resource.RLIMIT_CORE: 0, resource.RLIMIT_CPU: PROCESSOR_SECONDS,
                  **case.limits}
        for limit, value in limits.items():
            resource.setrlimit(limit, (value, value + 5 if limit == resource.RLIMIT_CPU else value))
        if case.act is None:
            if arguments and arguments[0] in warm.OWN:
                os.execv(loading.command(), ["waft", *map(os.fsencode, arguments)])
            return cli.main(arguments)
        wrong = case.act()
        print(wrong or "", file=sys.stderr)
        return 1 if wrong else 0

    warm.become(act, folder, said, said)


def _used(child):
    """State and processor time of a process, as the system tells them."""
    fields = pathlib.Path(f"/proc/{child}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return fields[0], int(fields[11]) + int(fields[12])


def follow(child, pipe):
    """(status of wait4, usage, what it said, whether it hung)"""
    said = bytearray()
    started = awake = time.monotonic()
    used = 0
    is_hung = False
    while True:
        ready, _, _ = select.select([pipe], [], [], 0.5)
        if ready:
            part = os.read(pipe, 1 << 16)
            if not part:
                break
            said += part[:max(0, (1 << 20) - len(said))]
        state, now_used = _used(child)
        if state == "Z":  # it may have spoken and ended since the pipe was looked at
            while select.select([pipe], [], [], 0.0)[0] and (part := os.read(pipe, 1 << 16)):
                said += part[:max(0, (1 << 20) - len(said))]
            break
        now = time.monotonic()
        if state in "RD" or now_used != used:
            awake, used = now, now_used
        if now - awake > ASLEEP_SECONDS or now - started > WALL_SECONDS:
            is_hung = True
            os.killpg(child, signal.SIGKILL)
            break
    _, status, usage = os.wait4(child, 0)
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        is_hung = True
    return status, usage, bytes(said), is_hung


class Worker:
    def __init__(self, folder):
        self.folder = folder
        self.kept = folder / "kept"
        self.results = folder / "results"
        self._make_results()

    def _make_results(self):
        """Results of an older run, with a file of the user's beside them."""
        scene = self.folder / "old.waft.json"
        scene.write_text(json.dumps(LEAF), encoding="utf-8")
        if subprocess.run([loading.command(), *map(str, synthesize(scene, self.kept))], check=False).returncode != 0:
            raise RuntimeError("the scene of one leaf could not be done")
        (self.kept / "notes.txt").write_text("the user's own", encoding="utf-8")
        self._restore()

    def _restore(self):
        shutil.rmtree(self.results, ignore_errors=True)
        shutil.copytree(self.kept, self.results)
        self.old = picture_of(self.results)

    def do(self, case):
        folder = self.folder / "case"
        folder.mkdir()
        try:
            arguments = case.make(folder, self.results) if case.make else None
            before = picture_of(folder)
            end, start = os.pipe()
            child = os.fork()
            if child == 0:
                os.close(end)
                in_child(case, arguments, folder, start)
            os.close(start)
            status, usage, said, is_hung = follow(child, end)
            os.close(end)
            changed = changes(before, picture_of(folder))
            old_changed = changes(self.old, picture_of(self.results))
            if old_changed:
                self._restore()
            done = judge.Done(-os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status), is_hung,
                              usage.ru_maxrss / 1024.0, said, changed, old_changed)
            return judge.faults(case, done)
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def main(first, step, groups, pattern, every):
    import waft.exporting  # noqa: F401 (each fork has them then)
    import waft.measuring.rows  # noqa: F401
    import waft.page.writing  # noqa: F401
    import waft.render.stage  # noqa: F401
    import waft.run.engine  # noqa: F401
    import waft.synthesis  # noqa: F401

    cases = [case for group in groups.split(",") for case in importlib.import_module(f"cases_{group}").cases()
             if re.search(pattern, f"{case.group}: {case.name}")][::int(every)]
    with tempfile.TemporaryDirectory(prefix="waft-bad-input-") as folder:
        worker = Worker(pathlib.Path(folder))
        for case in cases[int(first)::int(step)]:
            began = time.monotonic()
            found = worker.do(case)
            print(json.dumps({"group": case.group, "name": case.name, "faults": found,
                              "seconds": time.monotonic() - began}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
