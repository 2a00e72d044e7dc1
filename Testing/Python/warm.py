# SPDX-License-Identifier: BSD-3-Clause
"""The command `waft` without its start, which takes longer than most of what tests ask of it.

    warm = Warm(WAFT)                                 WAFT: the command of the build or of an installed tree
    done = warm.run("check", "a.waft.json", cwd=folder)       as subprocess.run gives it, with status and words

One process of ParaView's Python has the package loaded, and each call of what is Python's is a fork of it.
"""
import importlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

# What a run loads late.
LOADED = ("waft.cli", "waft.render.stage", "waft.results.writing", "waft.run.engine", "waft.run.result", "waft.run.synthesis",
          "waft.scene.starting", "paraview.catalyst.detail")
OWN = ("synthesize", "check", "database")  # commands of the program itself, which starts at once


def load():
    """What the command needs, so that forks have it."""
    for name in LOADED:
        importlib.import_module(name)
    from waft.loading import load_plugin

    load_plugin()


def become(act, folder, output, errors):
    """In a fork: calls act() in a folder, its words going to two files, and ends as a script would. Never returns.

    act() gives the exit status, or raises what the interpreter would end by.
    """
    nothing = os.open(os.devnull, os.O_RDONLY)
    for source, target in ((nothing, 0), (output, 1), (errors, 2)):
        os.dup2(source, target)
    # Streams of its own: those of pvpython 5.13 keep what was flushed.
    sys.stdout, sys.stderr = (open(number, "w", encoding="utf-8", closefd=False, buffering=1) for number in (1, 2))
    status = 1
    try:
        os.chdir(folder)
        status = act()
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:  # as the interpreter itself would
        traceback.print_exc()
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(status or 0)


class Warm:
    def __init__(self, waft):
        self._waft = str(waft)
        package = pathlib.Path(waft).resolve().parents[1] / "lib/python3/dist-packages"
        environment = {**os.environ, "PYTHONPATH": str(package), "OMPI_MCA_ess_singleton_isolated": "1", "HWLOC_COMPONENTS": "-gl"}
        self._process = subprocess.Popen(["pvpython", __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)

    def run(self, *arguments, cwd=None):
        command = [str(argument) for argument in arguments]
        if command[0] in OWN:
            return subprocess.run([self._waft, *command], cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
            files = [f"/proc/{os.getpid()}/fd/{stream.fileno()}" for stream in (output, errors)]
            print(json.dumps([command, str(cwd or os.getcwd()), *files]), file=self._process.stdin, flush=True)
            status = int(self._process.stdout.readline())
            output.seek(0)
            errors.seek(0)
            return subprocess.CompletedProcess(["waft", *command], status, output.read(), errors.read())

    def close(self):
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait()


def serve():
    load()
    from waft import cli, watching

    def fly(arguments):
        watching.keep_stops()
        return cli.main(arguments)

    for line in open(0, encoding="utf-8"):  # pvpython's sys.stdin gives no lines
        arguments, folder, *files = json.loads(line)
        child = os.fork()
        if child == 0:
            become(lambda: fly(arguments), folder, *(os.open(file, os.O_WRONLY | os.O_APPEND) for file in files))
        status = os.waitpid(child, 0)[1]
        answer = -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
        os.write(1, f"{answer}\n".encode())  # pvpython's sys.stdout of 5.13 keeps it, flushed or not


if __name__ == "__main__":
    serve()
