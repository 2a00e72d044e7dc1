# SPDX-License-Identifier: BSD-3-Clause
"""The flight of a scene: the source of Waft Animation runs all stages; in ParaView they are made by themselves when they are asked for."""
import contextlib
import json

from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

from waft import reading
from waft.failures import BadInput, WaftError
from waft.files import table_rows
from waft.loading import data_file, load_plugin
from waft.processes import share
from waft.run._chain import ATTRIBUTES, QUALITIES, STAGES
from waft.run.database import check_database, settle_database
from waft.run.unfolding import unfold
from waft.texts import say
from waft.watching import Clock, Effort, collect

NO_MEMORY = "found too little memory for it"  # how stages say so
_STOPPABLE = ("planner", "assimilation", "spacetime")  # the others are quick, and the best so far is to be written whole
_AFTER_SCENE, _AFTER_ALL = 0, 5
_MOTION = {"planner": (0, 4, 2), "assimilation": (0, 2, 4), "spacetime": (0, 2, 5)}  # ports of tracks, vortices and report


class Engine:
    """The source, which needs VTK alone; what the last flight told: watches ({stage: Effort}), warnings, report (of the
    rows, a dictionary each, all texts), plan_objects (what planning came to), stopped_in, moved_by (stages; the first may be "")."""

    def __init__(self, scene, quality, database=None):
        self.scene_file = str(scene)
        self.database_file = str(database or data_file("Database/embedded.vtm"))
        settle_database(self.database_file)
        check_database(self.database_file)
        from waft.vtkWaftFilters import vtkMotionAnimationSource

        self.algorithm = vtkMotionAnimationSource()
        self.algorithm.SetQuality(QUALITIES.index(quality))
        self.algorithm.SetDatabase(self.database_file if database is not None else "")
        share(self.algorithm)
        self.settings = {}  # {stage: {property: value}} besides defaults and those of the quality
        self.watches, self.warnings, self.report, self.plan_objects = {}, [], [], []
        self.stopped_in, self.moved_by, self.has_air = "", "planner", False
        self.is_planned_here = True
        self._kept_poses = None  # of before a flight that failed
        self._stages = {}  # {attribute: proxy}, once they are made

    def delete(self):
        """Takes all proxies out of ParaView's session, which would hold them and their data to its end."""
        for name in reversed(self._stages):
            self._simple().Delete(self._stages[name])
        self._stages = {}

    def read(self, clock):
        """The scene. Raises BadInput where it cannot be flown."""
        self.algorithm.SetFileName(self.scene_file)
        self.algorithm.SetStopAfter(_AFTER_SCENE)
        effort = Effort().begin()
        self._update(clock, lambda: None)
        self.watches = {"reader": effort.end()}

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
        told = {name: getattr(self, name) for name in ("watches", "warnings", "report", "plan_objects", "stopped_in", "moved_by", "has_air")}
        seed = self.algorithm.GetSeed()
        try:
            self._follow_stages()
            yield
        except BaseException:
            vars(self).update(told, _kept_poses=before)
            self.algorithm.SetSeed(seed)
            raise

    def take_plan(self, tracks, rows, vortices, report):
        """The next flight goes on from a plan; report: a dictionary a row, all texts. Raises BadInput where it cannot be."""
        wrong = self.algorithm.TakePlan(tracks, rows, vortices, _table_of(report))
        if wrong:
            raise BadInput(wrong)
        self.is_planned_here = False

    def fly(self, clock, planned):
        """Runs the stages; planned() is called once the paths are. Raises what that raises, BadInput of what a stage fails of (WaftError
        where memory ended, which is no fault of the input), Interrupted when it is to stop and there is nothing to write yet."""
        self.algorithm.SetStopAfter(_AFTER_ALL)
        left = clock.remaining()
        self.algorithm.SetTimeLimit(0.0 if left is None else max(left, 0.001))
        self._update(clock, planned)
        clock.check()
        self._kept_poses = None
        told = json.loads(self.algorithm.GetFlight())
        for name, effort in told["efforts"].items():
            watch = self.watches[ATTRIBUTES[name]] = Effort.of(effort)
            say(f"waft: {ATTRIBUTES[name]}: {watch.seconds:.1f} s, {watch.processor_seconds:.1f} s of processor time, "
                f"{watch.peak_mb:.0f} MB", "detail")
        self.stopped_in = ATTRIBUTES.get(told["stopped"], "")
        self.moved_by, self.has_air = ATTRIBUTES[told["movedBy"]], told["hasAir"]
        if told["objects"]:
            self.plan_objects = told["objects"]
        clock.timed_out = clock.timed_out or bool(told["stopped"]) and not clock.interrupted
        rows = vtkTable()
        self.algorithm.GetReport(rows)
        self.report = rows_of(rows)

    def _update(self, clock, planned):
        """Updates the source, which says what happens."""
        errors, failures = [], []

        def end(act):
            try:
                act()
            except BaseException as failure:  # noqa: B902 (raised again below: within VTK it would be lost)
                failures.append(failure)
                self.algorithm.SetAbortExecute(1)

        def tell(*_):
            name = ATTRIBUTES.get(self.algorithm.GetStageAtWork(), "")
            if name in _STOPPABLE and clock.should_stop():
                self.algorithm.SetAbortExecute(1)
            clock.stage = name
            clock.show(name or "database", self.algorithm.GetProgress(), self.algorithm.GetProgressText())

        def check_and_plan():
            clock.check()
            planned()

        clock.check()
        events = (("ProgressEvent", tell), ("UserEvent", lambda *_: end(check_and_plan)))
        observed = [(self.algorithm, self.algorithm.AddObserver(event, take)) for event, take in events]
        observed += [collect(self.algorithm, "ErrorEvent", errors), collect(self.algorithm.GetExecutive(), "ErrorEvent", errors),
                     collect(self.algorithm, "WarningEvent", self.warnings)]
        try:
            self.algorithm.Update()
        finally:
            for each, observer in observed:
                each.RemoveObserver(observer)
        if failures:
            raise failures[0]
        clock.check_progress()
        if errors:
            kind = WaftError if NO_MEMORY in errors[0] else BadInput
            raise kind(f"{self.database_file}: {errors[0]}" if errors[0].startswith("motion database: ") else errors[0])

    def write(self, options):
        """Writes the files of the flight; returns what report.json has of its motion."""
        # The source may be behind what they show; a flight that was stopped does not go on for that.
        if not self.stopped_in and (self._stages or self._kept_poses is not None):
            with self.undone_on_failure(), Clock(quiet=True) as clock:
                self.fly(clock, lambda: None)
        told = json.loads(self.algorithm.WriteFlight(json.dumps(options)))
        if "error" in told:
            raise OSError(told["error"])
        self.warnings += [text for text in told["warnings"] if text not in self.warnings]
        return told["report"]

    @property
    def seed(self):
        return self.algorithm.GetSeed() if self.algorithm.GetSeed() >= 0 else self.algorithm.GetSceneSeed()

    @property
    def poses(self):
        """The poses as VTK data: of the stages, once there are some."""
        rotation = self._stages.get("rotation")
        if rotation is None and self._kept_poses is not None:
            return self._kept_poses
        return self.algorithm.GetOutputDataObject(1) if rotation is None else rotation.GetClientSideObject().GetOutputDataObject(1)

    def stage(self, name):
        """The proxy of a stage; None where the flight had none of that name. Raises BadInput where they are to be made, and the scene
        file is there no more."""
        if not self._stages:
            self._make_stages()
        ran = name in ("reader", "planner", "rotation") or name in self.watches
        return self._stages.get(name) if ran else None

    def _make_stages(self):
        attributes = {STAGES[name]["proxy"]: attribute for name, attribute in ATTRIBUTES.items()}
        reading.check_scene_file(self.scene_file)
        simple = self._simple()
        animation = simple.WaftAnimation(FileName=self.scene_file, Quality=self.algorithm.GetQuality(), Seed=self.seed)
        made = {attributes[proxy.SMProxy.GetXMLName()]: proxy for proxy in unfold(animation).values()
                if proxy.SMProxy.GetXMLName() in attributes}
        simple.Delete(animation)
        if self.algorithm.GetDatabase():
            self._stages["database"] = made["planner"].Database = _database_reader(simple, self.database_file)
        if "assimilation" in made:
            made["assimilation"].EditOf = self.algorithm.GetEditOf()
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
        return self.moved_by, *_MOTION[self.moved_by]


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


def _table_of(rows):
    """A vtkTable of texts, of dictionaries with the same keys."""
    from vtkmodules.vtkCommonCore import vtkStringArray

    table = vtkTable()
    for name in rows[0] if rows else ():
        column = vtkStringArray()
        column.SetName(name)
        for row in rows:
            column.InsertNextValue(row[name])
        table.AddColumn(column)
    return table


def _database_reader(simple, path):
    """A source of ParaView that gives a motion database: its own reader, or what Waft reads where that may not be able to."""
    if reading.has_appended_blocks(path):
        source = simple.TrivialProducer(registrationName="Database")
        source.GetClientSideObject().SetOutput(reading.read_blocks(path))
        return source
    source = simple.XMLMultiBlockDataReader(registrationName="Database", FileName=[path])
    source.TimeArray = "None"
    return source
