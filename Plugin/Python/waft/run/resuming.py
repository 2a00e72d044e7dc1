# SPDX-License-Identifier: BSD-3-Clause
"""What a run keeps in its folder while it goes, so that another can go on from it."""
import hashlib
import json
import pathlib
import re
import stat

from waft.beneath import Folder
from waft.failures import BadInput
from waft.files import write_json
from waft.loading import version
from waft.reading import read_surface
from waft.results import manifest_in, manifest_of, manifest_rows
from waft.results._records import KEPT, record_of
from waft.results._tables import columns_of
from waft.results.writing import PLAN

_FOLDER = "checkpoint"
_REPORT, _KEY = "report.csv", "key"
_COLUMNS = {"Row": int, "Target": int, "ObjectId": int, "Frame": int, "Kind": str, "Residual": float, "Status": str, "Message": str}
# Of the optimiser; of the assimilation on its way, and when it is done.
_STATES = ("spacetime.state", "assimilation.state", "assimilated.state")
_OWN = re.compile("|".join([*(re.escape(name) for name in (*PLAN, _REPORT, _KEY)),
                            *(re.escape(state) + r"(\.part\d+)?" for state in _STATES)]))


def run_key(engine, seed, quality):
    """Tells runs apart: two of one key go the same way."""
    database = pathlib.Path(engine.database_file).resolve()
    about = database.stat()
    return hashlib.sha256(f"{database} {about.st_size} {about.st_mtime_ns} {seed} {quality} {version()} "
                          f"{engine.algorithm.GetSceneDigest()}".encode()).hexdigest()


def _manifest_in(below):
    """Of the plan in a Folder; None where it cannot be read."""
    try:
        return manifest_in(below, f"{_FOLDER}/{_KEY}")
    except BadInput:
        return None


def key_and_damage(below):
    """(key of the run that left a checkpoint in a Folder, None where it cannot be told; what of it is damaged, in words)"""
    manifest = _manifest_in(below)
    try:
        key = record_of(below, f"{_FOLDER}/{_KEY}", KEPT)
    except BadInput:
        key = None
    folder = below.path / _FOLDER
    if key is None or manifest is None or not {*PLAN, _REPORT} <= manifest.keys():
        return None, f"{folder / _KEY} is damaged, or of another version"
    damaged = [name for name, entry in manifest.items() if not entry.fits(below, f"{_FOLDER}/{name}")]
    return key["key"], f"{folder / damaged[0]} is damaged" if damaged else ""


def stages_done(below):
    """The stages that the checkpoint in a Folder has something of, in their order; none where there is no checkpoint."""
    try:
        names = set(below.names(_FOLDER))
    except BadInput:  # it is no folder
        return []
    marks = {"planner": {_KEY}, "assimilation": set(_STATES[1:]), "spacetime": {_STATES[0]}}
    return [stage for stage, own in marks.items() if names & own]


class Checkpoint:
    """The folder `checkpoint` in a run's output: the plan, and the states of the stages after it as they were last written.

    place: the ResultPlace of the run, which begin() enters. Raises BadInput when the folder holds what no run wrote.
    """

    def __init__(self, place, key):
        self._place = place
        self._below = Folder(place.root) if place.root.is_dir() else None
        self._folder = place.root / _FOLDER
        self._key = key
        self.folder = self._folder
        self.air_file = self._folder / _STATES[2]
        if self._below is not None and self._below.about(_FOLDER) is not None and not self._is_own():
            raise BadInput(f"{self._folder}: expected no such folder, or one that a stopped run left: it holds something else and "
                           "stays as it is: move it away, or choose another place for the results")

    def _is_own(self):
        if not stat.S_ISDIR(self._below.about(_FOLDER).st_mode):
            return False
        names = set(self._below.names(_FOLDER))
        is_plan = names >= {*PLAN, _REPORT} or self._manifest() is not None
        are_own = all(_OWN.fullmatch(name) and self._below.is_regular(self._below.about(f"{_FOLDER}/{name}")) for name in names)
        return are_own and (is_plan or not names)

    def _manifest(self):
        return _manifest_in(self._below)

    def lack(self):
        """What keeps a run from going on from here, in words; empty when nothing does."""
        if self._below is None or not self._below.is_folder(_FOLDER):
            return "no stopped run of this scene, seed and version"
        key, damage = key_and_damage(self._below)
        if key is not None and key != self._key:
            return "no stopped run of this scene, seed and version"
        return damage or self._nonsense()

    def _nonsense(self):
        """What cannot be read of files that are as their digests say, in words: somebody else may have written both."""
        try:
            for name in PLAN:
                read_surface(self._below.file(f"{_FOLDER}/{name}"))
            columns_of(self._below.rows(f"{_FOLDER}/{_REPORT}"), _COLUMNS, self._folder / _REPORT)
        except BadInput as error:
            return f"it cannot be read: {error}"
        return ""

    def begin(self, engine, is_found):
        """Now there is something to write, the plan at first, unless it was found here."""
        self._place.__enter__()
        self._below = self._place.folder
        if not is_found:
            self.keep_plan(engine)

    def keep_plan(self, engine):
        """Takes the place of whatever another run left."""
        folder = self._place.apart(_FOLDER)
        wrong = engine.algorithm.WritePlan(str(folder))
        if wrong:
            raise OSError(wrong)
        objects = json.loads(engine.algorithm.GetFlight())["objects"]
        write_json(folder / _KEY, {"key": self._key, "objects": objects, "manifest": manifest_rows(manifest_of(folder))})
        self.clear()
        self._place.put(_FOLDER)

    def take_plan(self, engine):
        engine.take_plan(*(read_surface(self._below.file(f"{_FOLDER}/{name}")) for name in PLAN), self._below.rows(f"{_FOLDER}/{_REPORT}"))
        engine.plan_objects = record_of(self._below, f"{_FOLDER}/{_KEY}", KEPT)["objects"]

    @property
    def planned_file(self):
        """What is planned.vtp among the results: the same bytes whether the plan was made or taken."""
        return self._below.file(f"{_FOLDER}/{PLAN[0]}")

    def hand_on(self, store):
        """The state of the air, done, is kept in a Store for later edits."""
        store.keep(self._key, self._below, f"{_FOLDER}/{self.air_file.name}")

    def clear(self):
        """Removes what runs left; what someone put beside it meanwhile stays."""
        for name in self._below.names(_FOLDER):
            if _OWN.fullmatch(name):
                self._below.remove(f"{_FOLDER}/{name}")
        if self._below.is_folder(_FOLDER):
            self._below.remove_empty(_FOLDER)
