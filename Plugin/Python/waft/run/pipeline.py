# SPDX-License-Identifier: BSD-3-Clause
"""The pipeline of a scene: each stage a ParaView proxy, joined by VTK data alone."""
from paraview import servermanager, simple

from waft import reading
from waft.failures import BadInput, WaftError
from waft.loading import data_file
from waft.results.writing import AIR_INTERVAL
from waft.run._chain import ATTRIBUTES, STAGES
from waft.run.database import check_database, settle_database
from waft.texts import say
from waft.watching import StageWatch

NO_MEMORY = "found too little memory for it"  # how stages say so


class Pipeline:
    """The live proxies: reader, database (None: the planner takes the one that comes with Waft), planner, assimilation and
    spacetime (None where the quality has none), rotation, fit (None likewise).

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
        self.plan_report = []  # of the rows, and what planning came to, a dictionary each
        self.plan_objects = []
        self._taken = {}  # {port of the planner: the reader of what an earlier run left}
        self.assimilation = None
        self.spacetime = None
        self.rotation = None
        self.fit = None
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
        watch.can_stop, watch.clock.stage = can_stop, name
        getattr(self, name).UpdatePipeline()
        watch.can_stop, watch.clock.stage = False, ""
        say(f"waft: {name}: {watch.seconds:.1f} s, {watch.processor_seconds:.1f} s of processor time, {watch.peak_mb:.0f} MB", "detail")
        watch.clock.check()
        if watch.was_aborted and name in ("assimilation", "spacetime") and self.output(name).GetNumberOfPoints() == 0:
            self._drop(name)
        if watch.errors and not watch.was_aborted:
            message = watch.errors[0]
            is_database = self.database is not None and (name == "database" or message.startswith("motion database: "))
            kind = WaftError if NO_MEMORY in message else BadInput
            raise kind(f"{self.database_file}: {message}" if is_database else message)

    def rewind(self):
        """Shows the first frame in all outputs, as when the stages ran: what is written of them tells of it."""
        for stage in (self.planner, self.assimilation, self.spacetime, self.rotation):
            if stage is not None:
                stage.UpdatePipeline(0.0)

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

    # The stages are joined one by one, by the table of the chain: which optional inputs there are is known once the reader ran.

    def add_planner(self, seed):
        given = {} if self.database is None else {"Database": self.database}
        self.planner = self._join("Planner", **given)
        self.planner.Seed = seed

    def take_plan(self, tracks, constraints, vortices):
        """Goes on from files of an earlier run instead of planning."""
        for port, path in ((0, tracks), (3, constraints), (4, vortices)):
            reader = self._add(simple.XMLPolyDataReader(FileName=[str(path)]))
            reader.TimeArray = "None"
            self._taken[port] = reader

    def planned(self, port):
        """The data object of an output of the planner (0 tracks, 3 constraints, 4 vortices)."""
        source = self._port("Planner", port)
        return source.GetClientSideObject().GetOutputDataObject(source.Port)

    def add_assimilation(self, seed):
        self.assimilation = self._join("Assimilation")
        self.assimilation.Seed = seed

    def add_spacetime(self):
        self.spacetime = self._join("Spacetime")

    @property
    def has_air(self):
        """Whether an air was drawn: not by a run that was stopped before."""
        return self.assimilation is not None and self.output("assimilation", 5).GetNumberOfRows() > 0

    def add_rotation(self, seed, hurries=False):
        """hurries: of the air only the fields that results are written with, which takes a third of the time."""
        air = {}
        if self.has_air and hurries:
            rate = self.output("reader").GetFieldData().GetArray("FramesPerSecond").GetValue(0)
            frames = self.output("reader").GetFieldData().GetArray("NumberOfFrames").GetValue(0)
            air["Air"] = self._add(simple.ExtractTimeSteps(
                registrationName="Air", Input=self._port("Assimilation", 1), SelectionMode="Select Time Range",
                TimeStepRange=[0, frames - 1], TimeStepInterval=max(1, round(AIR_INTERVAL * rate))))
        self.rotation = self._join("Rotation", **air)
        self.rotation.Seed = seed

    def add_fit(self, seed):
        self.fit = self._join("VortexFit")
        self.fit.Seed = seed

    def _join(self, name, **given):
        """A stage of the table, its inputs from the stages that there are; given: inputs that are others."""
        stage = STAGES[name]
        inputs = {}
        for own, alternatives in stage["inputs"].items():
            there = next((givers for givers in alternatives if all(self._is_there(*giver) for giver in givers)), [])
            ports = [self._port(*giver) for giver in there if not self._is_left_out(own, *giver)]
            if len(ports) == 1:
                inputs[own] = ports[0]
            elif ports:
                inputs[own] = self._add(simple.AppendGeometry(registrationName=own, Input=ports))
        made = getattr(simple, stage["proxy"])(registrationName=name, **{**inputs, **given})
        return self._add(made)

    def _is_there(self, name, port):
        return getattr(self, ATTRIBUTES[name]) is not None or (name == "Planner" and port in self._taken)

    def _is_left_out(self, own, name, port):
        """Whether an input that a stage may go without has nothing in it."""
        if own == "Air":
            return not self.has_air
        if own == "Wind" or (own == "Vortices" and name == "Scene"):
            return self.output("reader", port).GetNumberOfPoints() == 0
        return False

    def _port(self, name, port):
        """An output of a stage of the table, or the reader of what an earlier run left of it."""
        stage = getattr(self, ATTRIBUTES[name])
        return self._taken[port] if stage is None else simple.OutputPort(stage, port)

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


def _database_reader(path):
    """A source of ParaView that gives a motion database: its own reader, or what Waft reads where that may not be able to."""
    if reading.has_appended_blocks(path):
        source = simple.TrivialProducer(registrationName="Database")
        source.GetClientSideObject().SetOutput(reading.read_blocks(path))
        return source
    source = simple.XMLMultiBlockDataReader(registrationName="Database", FileName=[path])
    source.TimeArray = "None"
    return source
