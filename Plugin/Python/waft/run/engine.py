# SPDX-License-Identifier: BSD-3-Clause
"""The flight of a scene: the source of Waft Animation runs all stages; in ParaView they are made by themselves when they are asked for."""
import contextlib
import json
import os

from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

from waft import reading
from waft.failures import InputError, Interrupted, WaftError
from waft.files import table_rows
from waft.loading import data_file, load_plugin
from waft.run._chain import ATTRIBUTES, QUALITIES, STAGES
from waft.run.unfolding import unfold
from waft.texts import say
from waft.watching import Clock, Effort, collect

_FAULTS = {"memory": WaftError, "disk": WaftError, "stopped": Interrupted}  # whose a failure is; of all others InputError
_AFTER_SCENE, _AFTER_ALL = 0, 5
_MOTION = {"planner": (0, 4, 2), "assimilation": (0, 2, 4), "spacetime": (0, 2, 5)}  # ports of tracks, vortices and report


class Engine:
    """The source, which needs VTK alone; what the last flight told: told (vtkMotionAnimationSource::GetFlight) and report (of the
    rows, a dictionary each, all texts)."""

    def __init__(self, scene, quality, database=None):
        self.scene_file = str(scene)
        self.database_file = str(database or data_file("Database/embedded.vtm"))
        from waft.vtkWaftFilters import vtkMotionAnimationSource
        from waft.vtkWaftSources import vtkCheckedFiles

        wrong = vtkCheckedFiles.CheckDatabase(os.fsencode(self.database_file))
        if wrong:
            raise InputError(wrong)

        self.algorithm = vtkMotionAnimationSource()
        self.algorithm.SetQuality(QUALITIES.index(quality))
        self.algorithm.SetDatabase(self.database_file if database is not None else "")
        self.settings = {}  # {stage: {property: value}} besides defaults and those of the quality
        self.told = {}
        self.report = []
        self._kept_poses = None  # of before a flight that failed
        self._stages = {}  # {attribute: proxy}, once they are made

    def delete(self):
        """Takes all proxies out of ParaView's session, which would hold them and their data to its end."""
        for name in reversed(self._stages):
            self._simple().Delete(self._stages[name])
        self._stages = {}

    def read(self, clock):
        """The scene. Raises InputError where it cannot be flown."""
        self.algorithm.SetFileName(self.scene_file)
        self.algorithm.SetStopAfter(_AFTER_SCENE)
        self._update(clock)

    @property
    def watches(self):
        """{stage: Effort}"""
        return {name: Effort.of(effort) for name, effort in self.told["stages"].items()}

    @property
    def warnings(self):
        return self.told["warnings"]

    def set_options(self, settings):
        """Properties of stages: {stage of the table: {property: value}}."""
        self.settings = settings
        for stage, own in settings.items():
            for name, value in own.items():
                if not self.algorithm.SetStageOption(stage, name, _number(stage, name, value)):
                    raise AttributeError(f"{stage} has no option {name}")

    def _follow_stages(self):
        """The source has the properties of the stages that were made of it."""
        for name, attribute in ATTRIBUTES.items():
            stage = self._stages.get(attribute)
            for option in STAGES[name]["options"] if stage is not None else ():
                value = getattr(stage, option, None)
                if isinstance(value, (int, float)) and option not in ("Seed", "TimeLimit"):
                    self.algorithm.SetStageOption(name, option, value)
        if "planner" in self._stages:
            self.algorithm.SetNumberOfTakes(self._stages["planner"].NumberOfTakes)
            self.algorithm.SetTake(self._stages["planner"].Take)

    def hand_over(self):
        """The stages that were made have the motion of the source."""
        for name, stage in self._stages.items():
            if "Seed" in stage.ListProperties():
                stage.Seed = self.seed
        if self._stages:
            self._show_stages()

    @contextlib.contextmanager
    def undone_on_failure(self):
        """What is told of the motion, and its poses, are as before where what is done meanwhile fails."""
        before = vtkPolyData()
        before.ShallowCopy(self.poses)
        told, report, seed = self.told, self.report, self.algorithm.GetSeed()
        try:
            self._follow_stages()
            yield
        except BaseException:
            self.told, self.report, self._kept_poses = told, report, before
            self.algorithm.SetSeed(seed)
            raise

    def ask(self, request, writes):
        """The next flight is as a Request says, into its output where this process writes."""
        self._request = _as_flight(request)
        if request.output is not None and writes:
            self._request["Output"] = os.fspath(request.output)
        self.algorithm.SetFlight(json.dumps(self._request))

    def fly(self, clock):
        """Runs the stages, and writes what was asked for. Raises InputError of what a stage fails of (WaftError where memory or room ended,
        which is no fault of the input), Interrupted when it is to stop and there is nothing to write yet."""
        self.algorithm.SetStopAfter(_AFTER_ALL)
        left = clock.remaining()
        self.algorithm.SetTimeLimit(0.0 if left is None else max(left, 0.001))
        self._update(clock)
        self._kept_poses = None
        self.told = json.loads(self.algorithm.GetFlight())
        for name, watch in self.watches.items():
            say(f"waft: {name}: {watch.seconds:.1f} s, {watch.processor_seconds:.1f} s of processor time, {watch.peak_mb:.0f} MB", "detail")
        rows = vtkTable()
        self.algorithm.GetReport(rows)
        self.report = rows_of(rows)

    def _update(self, clock):
        """Updates the source, which says what happens."""
        errors = []

        def tell(*_):
            name = self.algorithm.GetStageAtWork()
            if clock.should_stop():
                self.algorithm.SetAbortExecute(1)
            clock.stage = name
            clock.show(name, self.algorithm.GetProgress(), self.algorithm.GetProgressText())

        clock.check()
        observed = [(self.algorithm, self.algorithm.AddObserver(event, take))
                    for event, take in (("ProgressEvent", tell), ("UserEvent", lambda *_: clock.keep()))]
        observed += [collect(self.algorithm, "ErrorEvent", errors), collect(self.algorithm.GetExecutive(), "ErrorEvent", errors),
                     collect(self.algorithm, "WarningEvent", [])]
        try:
            self.algorithm.Update()
        finally:
            for each, observer in observed:
                each.RemoveObserver(observer)
        clock.check_progress()
        if errors:
            self._fail(errors[0], clock)

    def _fail(self, words, clock=None):
        kind = _FAULTS.get(json.loads(self.algorithm.GetFlight())["fault"], InputError)
        if kind is Interrupted and clock is not None:
            clock.hand_on()
        raise kind(words)

    def save(self, folder, is_shown=False):
        """Writes the folder of the flight."""
        # The source may be behind what they show; a flight that was stopped does not go on for that.
        if not self.told["isStopped"] and (self._stages or self._kept_poses is not None):
            with self.undone_on_failure(), Clock(quiet=True) as clock:
                self.fly(clock)
        wrong = self.algorithm.SaveFlight(json.dumps({**self._request, "Output": os.fspath(folder)}), is_shown)
        self.told = json.loads(self.algorithm.GetFlight())
        if wrong:
            self._fail(wrong)

    @property
    def seed(self):
        return self.told["seed"]

    @property
    def poses(self):
        """The poses as VTK data: of the stages, once there are some."""
        rotation = self._stages.get("rotation")
        if rotation is None and self._kept_poses is not None:
            return self._kept_poses
        return self.algorithm.GetOutputDataObject(1) if rotation is None else rotation.GetClientSideObject().GetOutputDataObject(1)

    def stage(self, name):
        """The proxy of a stage; None where the flight had none of that name. Raises InputError where they are to be made, and the scene
        file is there no more."""
        if not self._stages:
            self._make_stages()
        ran = name in ("reader", "planner", "rotation") or name in self.watches
        return self._stages.get(name) if ran else None

    def _make_stages(self):
        attributes = {STAGES[name]["proxy"]: attribute for name, attribute in ATTRIBUTES.items()}
        reading.check_scene_file(self.scene_file)
        simple = self._simple()
        animation = simple.WaftAnimation(FileName=self.scene_file, Quality=QUALITIES.index(self.told["quality"]), Seed=self.seed)
        made = {attributes[proxy.SMProxy.GetXMLName()]: proxy for proxy in unfold(animation).values()
                if proxy.SMProxy.GetXMLName() in attributes}
        simple.Delete(animation)
        if self.algorithm.GetDatabase():
            self._stages["database"] = made["planner"].Database = _database_reader(simple, self.database_file)
        if "assimilation" in made:
            made["assimilation"].EditOf = self.told["editOf"]
        self._stages.update(made)
        for name, own in self.settings.items():
            for setting, value in own.items() if ATTRIBUTES[name] in made else ():
                setattr(made[ATTRIBUTES[name]], setting, value)
        self._show_stages()

    @staticmethod
    def _simple():
        load_plugin()
        from paraview import simple

        return simple

    def _show_stages(self):
        for stage in self._stages.values():
            self.algorithm.HandOver(stage.GetClientSideObject())
        for name in ("rotation", "fit"):
            if name in self._stages and name in self.watches:
                self._stages[name].UpdatePipeline()

    def output(self, name, port=0):
        """The data object of an output port of a stage, on this side."""
        return self.stage(name).GetClientSideObject().GetOutputDataObject(port)

    @property
    def motion(self):
        """The name of the stage that moves the objects to their marks, and its ports of tracks, vortices and report."""
        return self.told["movedBy"], *_MOTION[self.told["movedBy"]]


def _number(stage, name, value):
    """The value of a property of a stage, which may be said by a word of its list."""
    if not isinstance(value, str):
        return value
    load_plugin()
    from paraview import servermanager

    prototype = servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy("filters", STAGES[stage]["proxy"])
    words = prototype.GetProperty(name).FindDomain("vtkSMEnumerationDomain")
    return next(words.GetEntryValue(i) for i in range(words.GetNumberOfEntries()) if words.GetEntryText(i) == value)


def rows_of(table):
    """A table as one dictionary a row, all texts."""
    header, rows = table_rows(table)
    return [dict(zip(header, row)) for row in rows]


def _as_flight(request):
    """A Request as vtkMotionAnimationSource::SetFlight takes it."""
    return {"EditOf": "" if request.edit_of is None else os.fspath(request.edit_of), "Resumes": request.resume, "HasCsv": request.csv,
            "HasMeshes": request.meshes, "HasParticles": request.particles, "KeepsAir": "air" in request.keep,
            "KeepsState": "state" in request.keep, "Defaults": dict(request._defaults), "EndsWhole": True}


def _database_reader(simple, path):
    """A source of ParaView that gives a motion database: its own reader, or what Waft reads where that may not be able to."""
    if reading.has_appended_blocks(path):
        source = simple.TrivialProducer(registrationName="Database")
        source.GetClientSideObject().SetOutput(reading.read_blocks(path))
        return source
    source = simple.XMLMultiBlockDataReader(registrationName="Database", FileName=[path])
    source.TimeArray = "None"
    return source
