# SPDX-License-Identifier: BSD-3-Clause
"""The pipeline of a scene: each stage a ParaView proxy, joined by VTK data alone."""
from paraview import servermanager, simple

from waft import reading
from waft.database import check_database, settle_database
from waft.failures import BadInput, WaftError
from waft.loading import data_file
from waft.watching import StageWatch
from waft.writing import AIR_INTERVAL, read_rows

NO_MEMORY = "found too little memory for it"  # how stages say so


class Pipeline:
    """The live proxies: reader, database (None: the planner takes the one that comes with Waft), planner, assimilation and
    spacetime (None where the quality has none), rotation.

    Change a property of any of them and call UpdatePipeline() on the last: only what depends on the
    change is computed again.
    """

    def __init__(self, scene, database=None):
        self.scene_file = str(scene)
        self.database_file = str(database or data_file("Database/embedded.vtm"))
        settle_database(self.database_file)
        check_database(self.database_file)
        self._stages = []  # all proxies that were made, in order
        self.reader = self._add(simple.MotionSceneReader(registrationName="Scene"))  # the file once it is watched
        self.reader.OnEveryRank = servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
        self.database = None
        if database is not None:
            self.database = self._add(_database_reader(self.database_file))
        self.planner = None
        self._planned = {}  # outputs of the planner, or of readers of what an earlier run left
        self.assimilation = None
        self.spacetime = None
        self.rotation = None
        self.watches = {}

    def _add(self, stage):
        self._stages.append(stage)
        return stage

    def delete(self):
        """Takes all stages out of ParaView's session, which would hold them and their data to its end."""
        while self._stages:
            simple.Delete(self._stages.pop())

    def read(self, clock):
        """The scene and the database."""
        self.watch("reader", clock)
        self.reader.FileName = self.scene_file
        self.update("reader")
        if self.output("reader").GetNumberOfPoints() == 0:
            raise BadInput(f"{self.scene_file}: /objects: expected at least one object, found none")
        if self.database is not None:
            self.watch("database", clock)
            self.update("database")

    def watch(self, name, clock):
        self.watches[name] = StageWatch(name, getattr(self, name), clock)
        return self.watches[name]

    def update(self, name, can_stop=True):
        """Updates a stage that is watched; raises BadInput with its message when it failed (WaftError where memory ended, which is no
        fault of the input), Interrupted when it is to stop and there is nothing to write yet."""
        watch = self.watches[name]
        watch.clock.check()
        watch.can_stop = can_stop
        getattr(self, name).UpdatePipeline()
        watch.can_stop = False
        watch.clock.check()
        if watch.was_aborted and name in ("assimilation", "spacetime") and self.output(name).GetNumberOfPoints() == 0:
            self._drop(name)
        if watch.errors and not watch.was_aborted:
            message = watch.errors[0]
            is_database = self.database is not None and (name == "database" or message.startswith("motion database: "))
            kind = WaftError if NO_MEMORY in message else BadInput
            raise kind(f"{self.database_file}: {message}" if is_database else message)

    def _drop(self, name):
        """A stage that was stopped while it looked at its inputs gave nothing: the motion so far is that of the one before."""
        stage = getattr(self, name)
        setattr(self, name, None)
        self.watches.pop(name).release()
        self._stages.remove(stage)
        simple.Delete(stage)

    def output(self, name, port=0):
        """The data object of an output port, on this side."""
        return getattr(self, name).GetClientSideObject().GetOutputDataObject(port)

    # The stages are joined one by one: which optional inputs there are is known once the reader ran.

    def add_planner(self, seed):
        given = {} if self.database is None else {"Database": self.database}
        self.planner = self._add(simple.StylisticPlannerFilter(
            registrationName="Planner", Objects=self._scene("Objects"), Constraints=self._scene("Constraints"),
            Obstacles=self._scene("Obstacles"), **given))
        self.planner.Seed = seed
        self._planned = {port: simple.OutputPort(self.planner, port) for port in (0, 3, 4)}

    def take_plan(self, tracks, constraints, vortices):
        """Goes on from files of an earlier run instead of planning."""
        for port, path in ((0, tracks), (3, constraints), (4, vortices)):
            reader = self._add(simple.XMLPolyDataReader(FileName=[str(path)]))
            reader.TimeArray = "None"
            self._planned[port] = reader

    def planned(self, port):
        """The data object of an output of the planner (0 tracks, 3 constraints, 4 vortices)."""
        source = self._planned[port]
        return source.GetClientSideObject().GetOutputDataObject(source.Port)

    def add_spacetime(self):
        tracks, rows = self._tracks_and_rows()
        inputs = {"Obstacles": self._scene("Obstacles"), **self._wind()}
        if self.assimilation is not None:
            inputs.update(Air=simple.OutputPort(self.assimilation, 1), Vortices=simple.OutputPort(self.assimilation, 2))
        else:
            inputs["Vortices"] = self._vortices()
        self.spacetime = self._add(simple.SPHSpacetimeFilter(
            registrationName="Spacetime", Tracks=tracks, Objects=self._scene("Objects"), Constraints=rows, **inputs))

    def _tracks_and_rows(self):
        """Outputs of the assimilation, or of the plan without one."""
        if self.assimilation is not None:
            return simple.OutputPort(self.assimilation, 0), simple.OutputPort(self.assimilation, 3)
        return self._planned[0], self._planned[3]

    def add_assimilation(self, seed):
        own = {"Vortices": self._scene("Vortices")} if self.output("reader", 4).GetNumberOfCells() > 0 else {}
        self.assimilation = self._add(simple.AirAssimilationFilter(
            registrationName="Assimilation", Tracks=self._planned[0], Objects=self._scene("Objects"),
            Constraints=self._planned[3], Obstacles=self._scene("Obstacles"), **own, **self._wind()))
        self.assimilation.Seed = seed

    @property
    def has_air(self):
        """Whether an air was drawn: not by a run that was stopped before."""
        return self.assimilation is not None and self.output("assimilation", 5).GetNumberOfRows() > 0

    def add_rotation(self, seed, hurries=False):
        """hurries: of the air only the fields that results are written with, which takes a third of the time."""
        tracks, rows = self._tracks_and_rows()
        air = {"Air": simple.OutputPort(self.assimilation, 1)} if self.has_air else {}
        if air and hurries:
            rate = self.output("reader").GetFieldData().GetArray("FramesPerSecond").GetValue(0)
            frames = self.output("reader").GetFieldData().GetArray("NumberOfFrames").GetValue(0)
            air["Air"] = self._add(simple.ExtractTimeSteps(
                registrationName="Air", Input=air["Air"], SelectionMode="Select Time Range", TimeStepRange=[0, frames - 1],
                TimeStepInterval=max(1, round(AIR_INTERVAL * rate))))
        if self.spacetime is not None:
            tracks = simple.OutputPort(self.spacetime, 0)
        self.rotation = self._add(simple.RotationRefineFilter(
            registrationName="Rotation", Tracks=tracks, Objects=self._scene("Objects"), Shapes=self._scene("Shapes"),
            Obstacles=self._scene("Obstacles"), Constraints=rows, **air, **self._wind()))
        self.rotation.Seed = seed

    @property
    def motion(self):
        """The name of the stage that moves the objects to their marks, and its ports of tracks, vortices and report; of a run
        that was stopped before the stages after it, that is the planner."""
        if self.spacetime is not None:
            return "spacetime", 0, 2, 5
        return ("assimilation", 0, 2, 4) if self.assimilation is not None else ("planner", 0, 4, 2)

    def moved(self, port):
        """The data object of an output of the stage that moves the objects; of a plan also where an earlier run left it."""
        name, *_ = self.motion
        return self.planned(port) if name == "planner" else self.output(name, port)

    def moved_report(self):
        """The report of the stage that moves the objects, one dictionary a row, all texts."""
        name, _, _, port = self.motion
        return [dict(row) for row in self.plan_report] if name == "planner" else read_rows(self.output(name, port))

    def _scene(self, name):
        ports = ("Objects", "Constraints", "Obstacles", "Shapes", "Vortices", "Wind")
        return simple.OutputPort(self.reader, ports.index(name))

    def _wind(self):
        """The input of a stage that feels the scene's wind; none without one."""
        return {"Wind": self._scene("Wind")} if self.output("reader", 5).GetNumberOfPoints() > 0 else {}

    def _vortices(self):
        planned = self._planned[4]
        if self.output("reader", 4).GetNumberOfCells() == 0:
            return planned
        return self._add(simple.AppendGeometry(registrationName="Vortices", Input=[self._scene("Vortices"), planned]))


def _database_reader(path):
    """A source of ParaView that gives a motion database: its own reader, or what Waft reads where that may not be able to."""
    if reading.has_appended_blocks(path):
        source = simple.TrivialProducer(registrationName="Database")
        source.GetClientSideObject().SetOutput(reading.read_blocks(path))
        return source
    source = simple.XMLMultiBlockDataReader(registrationName="Database", FileName=[path])
    source.TimeArray = "None"
    return source
