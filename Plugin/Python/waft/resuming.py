# SPDX-License-Identifier: BSD-3-Clause
"""What a run keeps in its folder while it goes, so that another can go on from it."""
import csv
import hashlib
import pathlib
import shutil

from waft.files import replaced_folder, write_csv, write_xml
from waft.loading import version

PLAN = {0: "planned.vtp", 3: "constraints.vtp", 4: "vortices.vtp"}


def run_key(pipeline, preview):
    """Tells runs apart: two of one key go the same way."""
    database = pathlib.Path(pipeline.database_file).resolve()
    about = database.stat()
    key = hashlib.sha256(f"{database} {about.st_size} {about.st_mtime_ns} {pipeline.seed} {preview} {version()}".encode())
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
    """The folder `checkpoint` in a run's output: the plan, and the optimiser's state as it was last written."""

    def __init__(self, output, key):
        self._folder = pathlib.Path(output) / "checkpoint"
        self._key = key
        self.state_file = self._folder / "spacetime.state"

    def is_there(self):
        """A run of the same key has left its plan."""
        try:
            return (self._folder / "key").read_text(encoding="utf-8") == self._key
        except OSError:
            return False

    def keep_plan(self, pipeline):
        """Takes the place of whatever another run left."""
        with replaced_folder(self._folder) as folder:
            for port, name in PLAN.items():
                write_xml(pipeline.planned(port), folder / name)
            header = list(pipeline.plan_report[0]) if pipeline.plan_report else []
            write_csv(folder / "report.csv", header, [list(row.values()) for row in pipeline.plan_report])
            (folder / "key").write_text(self._key, encoding="utf-8")

    def take_plan(self, pipeline):
        pipeline.take_plan(*(self._folder / name for name in PLAN.values()))
        with open(self._folder / "report.csv", encoding="utf-8", newline="") as file:
            pipeline.plan_report = list(csv.DictReader(file))

    def copy_plan(self, name, out):
        """One of the plan's files among the results: the same bytes whether the plan was made or taken."""
        shutil.copyfile(self._folder / name, out.path(name))

    def clear(self):
        shutil.rmtree(self._folder, ignore_errors=True)
