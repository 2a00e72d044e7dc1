# SPDX-License-Identifier: BSD-3-Clause
"""The command as one run of several MPI processes: same bytes, one status, stops, and what a killed process leaves.

    python3 test_processes.py WAFT [MPIEXEC]        exit status 77 (skipped) without MPIEXEC
"""
import contextlib
import filecmp
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

from waft import processes


class Launches(unittest.TestCase):
    """What a process knows of itself by what its launcher says."""

    def seen(self, **variables):
        with mock.patch.dict(os.environ, variables, clear=True), \
                mock.patch.object(os, "sched_getaffinity", lambda _: set(range(24)), create=True):
            return processes.threads_here()

    def test_knows_launchers(self):
        by_mpiexec = {"OMPI_COMM_WORLD_RANK": "3", "OMPI_COMM_WORLD_SIZE": "8", "OMPI_COMM_WORLD_LOCAL_SIZE": "4"}
        by_srun = {"PMIX_RANK": "1", "SLURM_STEP_NUM_TASKS": "64", "SLURM_STEP_TASKS_PER_NODE": "8(x8)", "SLURM_NTASKS": "64"}
        self.assertIsNone(self.seen())
        self.assertIsNone(self.seen(SLURM_NTASKS="64", SLURM_CPUS_PER_TASK="2"))  # a batch script, by itself
        self.assertEqual(self.seen(**by_mpiexec), 6)
        self.assertEqual(self.seen(**by_srun), 3)
        self.assertEqual(self.seen(**by_mpiexec, SLURM_CPUS_PER_TASK="2"), 2)
        self.assertIsNone(self.seen(**{**by_mpiexec, "OMPI_COMM_WORLD_SIZE": "1"}))
        self.assertIsNone(self.seen(**{**by_mpiexec, "OMPI_COMM_WORLD_RANK": "none"}))


class Command(unittest.TestCase):
    """The command, started by a launcher."""

    SIMULATIONS = ["--simulations", "5", "--frames", "40", "--resolution", "12"]

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, processes, *arguments):
        """All of its processes have the folder of this test in their environment."""
        launcher = [MPIEXEC, "-q", "--allow-run-as-root", "--oversubscribe", "-n", str(processes)] if processes > 1 else []
        environment = {**os.environ, "WAFT_TEST_FOLDER": str(self.folder)}
        environment.pop("VTK_SMP_BACKEND_IN_USE", None)
        return subprocess.Popen([*launcher, WAFT, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=environment)

    def run_on(self, processes, *arguments):
        started = self.start(processes, *arguments)
        out, error = started.communicate(timeout=600)
        return started.returncode, out, error

    def processes(self):
        """The ids of the processes of a run that the launcher has started, by rank."""
        found = {}
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                variables = dict(part.split(b"=", 1) for part in (entry / "environ").read_bytes().split(b"\0") if b"=" in part)
                if variables.get(b"WAFT_TEST_FOLDER") == os.fsencode(self.folder) and b"OMPI_COMM_WORLD_RANK" in variables:
                    found[int(variables[b"OMPI_COMM_WORLD_RANK"])] = int(entry.name)
        return found

    def assert_same(self, one, other, but=()):
        compared = filecmp.dircmp(one, other, list(but))
        self.assertEqual((compared.left_only, compared.right_only), ([], []))
        for name in compared.common_files:
            self.assertTrue(filecmp.cmp(one / name, other / name, shallow=False), f"{one / name} {other / name}")
        for name in compared.common_dirs:
            self.assert_same(one / name, other / name)

    def await_kept(self, run, path):
        """Until a first simulation is kept."""
        while not list(path.with_name(f"{path.name}.kept").glob("simulation?")):
            self.assertIsNone(run.poll(), "it has ended before a simulation was whole")
            time.sleep(0.01)

    def test_makes_the_same_database(self):
        for processes in (1, 3):
            (self.folder / str(processes)).mkdir()
            status, out, error = self.run_on(processes, "database", "--output", self.folder / str(processes) / "air.vtm", *self.SIMULATIONS)
            self.assertEqual((status, out), (0, ""), error)
            self.assertEqual(error.count("5 simulations"), 1, error)
        self.assert_same(self.folder / "1", self.folder / "3")

    def make_scene(self, height):
        """Maples, of which one has a mark."""
        path = self.folder / "scene.waft.json"
        path.write_text(json.dumps({
            "waft": 1, "seed": 5, "time": {"frames": 13}, "shapes": {"maple": {"builtin": "maple"}},
            "objects": [{"shape": "maple", "positions": [[0.2, 0.1, 2.6], [-0.2, 0.1, 2.6], [0, -0.2, 2.6]]}],
            "constraints": [{"kind": "position", "object": 0, "frame": 10, "value": [0.2, 0.1, height], "radius": 0.1}]}),
            encoding="utf-8")
        return path

    def test_runs_the_scripts_of_the_page(self):
        page = (pathlib.Path(__file__).resolve().parents[2] / "Documentation" / "ManyMachines.md").read_text(encoding="utf-8")
        database, scene = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
        self.make_scene(2.5)
        environment = {**os.environ, "SLURM_NTASKS": "2", "PATH": f"{pathlib.Path(WAFT).parent}:{os.environ['PATH']}",
                       "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
        for script, arguments, made in ((database, self.SIMULATIONS, "air.vtm"), (scene, ["--preview"], "out/poses.csv")):
            (self.folder / "job.sh").write_text(script, encoding="utf-8")
            done = subprocess.run(["sh", "job.sh", *arguments], cwd=self.folder, env=environment, stderr=subprocess.PIPE, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.folder / made).is_file())

    def test_gives_the_status_of_the_first(self):
        path = self.make_scene(9)
        for processes in (1, 2):
            status, _, error = self.run_on(processes, "synthesize", path, "--preview", "--output", self.folder / f"out{processes}")
            self.assertEqual((status, error.count("row 0 target 0")), (3, 1), error)
        for name in ("poses.csv", "planned.vtp", "optimized.vtp", "constraints.csv"):
            self.assertTrue(filecmp.cmp(self.folder / "out1" / name, self.folder / "out2" / name, shallow=False), name)
        for arguments, wanted in ((["database", "--output", self.folder / "air.obj"], 2), (["--version"], 0), (["info", path], 0)):
            alone, launched = self.run_on(1, *arguments), self.run_on(2, *arguments)
            self.assertEqual((alone, launched[0]), (launched, wanted))

    def test_stops_by_a_signal_and_goes_on(self):
        (self.folder / "stopped").mkdir()
        path = self.folder / "stopped" / "air.vtm"
        of_each = ["--frames", 120, "--resolution", 12, "--threads", 1]  # a thousand of them take minutes
        run = self.start(2, "database", "--output", path, "--simulations", 1000, *of_each)
        self.await_kept(run, path)
        of_run = self.processes().values()
        for number in of_run:  # or it makes simulations meanwhile, which all are made again below
            os.kill(number, signal.SIGSTOP)
        other = self.run_on(2, "database", "--output", path, *self.SIMULATIONS)  # two runs on one file are no processes of one
        self.assertEqual((other[0], other[2].count("another run")), (2, 1), other[2])
        for number in of_run:
            os.kill(number, signal.SIGCONT)
        run.send_signal(signal.SIGUSR1)  # which mpiexec hands on to all
        _, error = run.communicate(timeout=300)
        self.assertEqual(run.returncode, 4, error)
        self.assertEqual(error.count("stopped early"), 1, error)
        done = int(re.search(r"(\d+) simulations", error)[1])
        self.assertLess(done, 1000)

        def make(folder, processes_, count, *how):
            (self.folder / folder).mkdir(exist_ok=True)
            status, _, error = self.run_on(processes_, "database", "--output", self.folder / folder / "air.vtm", "--simulations", count,
                                           *of_each, *how)
            self.assertEqual(status, 0, error)

        make("whole", 1, done)
        self.assert_same(self.folder / "whole", path.parent, ["air.vtm.kept"])
        make("more", 1, done + 1)
        make("stopped", 2, done + 1, "--resume")
        self.assert_same(self.folder / "more", path.parent)

    def test_ends_as_a_whole_when_one_is_killed(self):
        for rank in (0, 1):
            folder = self.folder / f"killed{rank}"
            folder.mkdir()
            path = folder / "air.vtm"
            run = self.start(3, "database", "--output", path, "--simulations", 1000, "--frames", 40, "--resolution", 12, "--threads", 1)
            self.await_kept(run, path)
            of_run = self.processes()
            self.assertEqual(sorted(of_run), [0, 1, 2])
            os.kill(of_run[rank], signal.SIGKILL)
            run.communicate(timeout=60)
            self.assertNotEqual(run.returncode, 0)
            self.assertEqual(self.processes(), {})
            self.assertEqual([entry.name for entry in folder.iterdir() if entry.name != "air.vtm.kept"], [])
            status, _, error = self.run_on(1, "database", "--output", path, "--resume", *self.SIMULATIONS)
            self.assertEqual(status, 0, error)


if __name__ == "__main__":
    WAFT = sys.argv[1]
    MPIEXEC = sys.argv[2] if len(sys.argv) > 2 else ""
    if not MPIEXEC:
        print("mpiexec is not there (package openmpi-bin): several processes are not tested")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
