# SPDX-License-Identifier: BSD-3-Clause
"""What a run keeps in its folder while it goes, so that another can go on from it."""
import hashlib
import os
import pathlib
import re

from waft.failures import BadInput
from waft.files import copy_file, write_csv, write_json, write_xml
from waft.loading import version
from waft.reading import found_json, read_rows
from waft.results import manifest_of, manifest_rows, read_manifest

PLAN = {0: "planned.vtp", 3: "constraints.vtp", 4: "vortices.vtp"}
_REPORT, _KEY = "report.csv", "key"
# Of the optimiser; of the assimilation on its way, and when it is done.
_STATES = ("spacetime.state", "assimilation.state", "assimilated.state")
_OWN = re.compile("|".join([*(re.escape(name) for name in (*PLAN.values(), _REPORT, _KEY)),
                            *(re.escape(state) + r"(\.part\d+)?" for state in _STATES)]))


def run_key(pipeline, quality):
    """Tells runs apart: two of one key go the same way."""
    database = pathlib.Path(pipeline.database_file).resolve()
    about = database.stat()
    key = hashlib.sha256(f"{database} {about.st_size} {about.st_mtime_ns} {pipeline.seed} {quality} {version()}".encode())
    for port in range(6):
        if port != 3:  # what the shapes mean for the motion is in the objects
            key.update(_bytes(pipeline.output("reader", port)))
    return key.hexdigest()


def _bytes(data):
    """A data set as bytes; equal ones give the same."""
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

    writer = vtkXMLPolyDataWriter() if data.IsA("vtkPolyData") else vtkXMLImageDataWriter()
    writer.SetInputDataObject(data)
    writer.SetDataModeToAscii()
    writer.WriteToOutputStringOn()
    writer.Write()
    return writer.GetOutputString().encode()


class Checkpoint:
    """The folder `checkpoint` in a run's output: the plan, and the states of the stages after it as they were last written.

    place: the ResultPlace of the run. Raises BadInput when the folder holds what no run wrote.
    """

    def __init__(self, place, key):
        self._place = place
        self._folder = place.root / "checkpoint"
        self._key = key
        self.optimiser_file, self.assimilation_file, self.air_file = (self._folder / state for state in _STATES)
        if os.path.lexists(self._folder) and not self._is_own():
            raise BadInput(f"{self._folder}: expected no such folder, or one that a stopped run left: it holds something else and "
                           "stays as it is: move it away, or choose another place for the results")

    def _is_own(self):
        if self._folder.is_symlink() or not self._folder.is_dir():
            return False
        names = {entry.name for entry in self._folder.iterdir()}
        is_plan = names >= {*PLAN.values(), _REPORT} or read_manifest(self._folder / _KEY) is not None
        return all(_OWN.fullmatch(name) for name in names) and (is_plan or not names)

    def lack(self):
        """What keeps a run from going on from here, in words; empty when nothing does."""
        key = found_json(self._folder / _KEY)
        manifest = read_manifest(self._folder / _KEY)
        if not self._folder.is_dir():
            return "no stopped run of this scene, seed and version"
        if manifest is None or not {*PLAN.values(), _REPORT} <= manifest.keys():
            return f"{self._folder / _KEY} is damaged, or of another version"
        if key.get("key") != self._key:
            return "no stopped run of this scene, seed and version"
        damaged = [name for name, entry in manifest.items() if not entry.fits(self._folder / name)]
        return f"{self._folder / damaged[0]} is damaged" if damaged else ""

    def keep_plan(self, pipeline):
        """Takes the place of whatever another run left."""
        temporary = self._place.temporary()
        folder = temporary / self._folder.name
        folder.mkdir()
        for port, name in PLAN.items():
            write_xml(pipeline.planned(port), folder / name)
        header = list(pipeline.plan_report[0]) if pipeline.plan_report else []
        write_csv(folder / _REPORT, header, [list(row.values()) for row in pipeline.plan_report])
        write_json(folder / _KEY, {"key": self._key, "manifest": manifest_rows(manifest_of(folder))})
        self.clear()
        os.rename(folder, self._folder)
        self._place.discard(temporary)

    def take_plan(self, pipeline):
        pipeline.take_plan(*(self._folder / name for name in PLAN.values()))
        pipeline.plan_report = read_rows(self._folder / _REPORT)

    def copy_plan(self, name):
        """One of the plan's files among the results: the same bytes whether the plan was made or taken."""
        copy_file(self._folder / name, self._place.path(name))

    def clear(self):
        """Removes what runs left; what someone put beside it meanwhile stays."""
        if self._folder.is_dir():
            for entry in self._folder.iterdir():
                if _OWN.fullmatch(entry.name):
                    entry.unlink()
            if not any(self._folder.iterdir()):
                self._folder.rmdir()
