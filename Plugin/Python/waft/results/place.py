# SPDX-License-Identifier: BSD-3-Clause
"""Where a run's files go: which of those there an earlier run wrote, one run at a time, all files at once.

A file is Waft's when a manifest names it and its content is still what the run wrote; everything else is the user's, and is
neither replaced nor removed. The manifest is part of one file of the results, their seal, which goes first and comes
last when results change hands: where there is no seal the results are not whole.

While results change hands they are in the folder `.waft-move`: `new`, those that go in; `old`, those that stand aside until all
new ones are in; `journal.json`, the names of both. A move that was cut short is finished by the next run there, or undone. Of
files that are put in one by one `.waft-put` holds the rows until they are in the manifest.

The folder may be a stranger's: all that is below it is reached by beneath.Folder, by names alone, and what seals, journals and
`.waft-put` say is looked at like any input.
"""
import contextlib
import dataclasses
import errno
import fcntl
import hashlib
import json
import os
import pathlib
import time

from waft.beneath import Folder, parts_of
from waft.failures import BadInput, WaftError
from waft.files import write_json
from waft.reading import json_of, open_stream
from waft.scene._schema import fault
from waft.temporary import is_temporary, sweep_files, temporary_name
from waft.watching import report_to_guard

_MOVE = ".waft-move"
_JOURNAL = "journal.json"
_PUT = ".waft-put"
_RESERVE = 5  # descriptors that removing a temporary folder takes, which has three levels
_PATIENCE = 20.0  # s that results may take to change hands

_NAME = {"type": "string", "minLength": 1, "maxLength": 4095}
_ROW = {"type": "object", "required": ["name", "size", "digest"], "additionalProperties": False, "properties": {
    "name": _NAME, "size": {"type": "integer", "minimum": 0, "maximum": 2 ** 63},
    "digest": {"type": "string", "description": "sha256: and 64 digits", "pattern": r"\Asha256:[0-9a-f]{64}\Z", "maxLength": 71}}}
_ROWS = {"type": "array", "items": _ROW}
_SEALED = {"type": "object", "required": ["manifest"], "properties": {"manifest": _ROWS}}
_JOURNALED = {"type": "object", "required": ["seal", "new", "old"], "additionalProperties": False,
              "properties": {"seal": _NAME, "new": _ROWS, "old": _ROWS}}
_LOGGED = {"type": "object", "properties": {"new": _ROWS}}
_BEGUN = {"type": "object", "required": ["seal"], "additionalProperties": False, "properties": {"seal": _NAME}}


class Busy(BadInput):
    """Another run holds the place."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """What a run wrote under a name; without a digest, whatever file is there: of a seal. No file says so."""

    size: int = -1
    digest: str = ""

    @classmethod
    def of(cls, path):
        with open_stream(path) as stream:
            return cls._of_stream(stream)

    @classmethod
    def below(cls, folder, name):
        """Of a file in a Folder."""
        with folder.stream(name) as stream:
            return cls._of_stream(stream)

    @classmethod
    def _of_stream(cls, stream):
        content, size = hashlib.sha256(), 0
        while block := stream.read(1 << 20):
            content.update(block)
            size += len(block)
        return cls(size, "sha256:" + content.hexdigest())

    def fits(self, folder, name):
        """Whether it is what a Folder has under a name."""
        try:
            if not folder.is_file(name):
                return False
        except BadInput:
            return False
        return not self.digest or (self.size == folder.about(name).st_size and self == Entry.below(folder, name))


def manifest_of(folder):
    """{name: Entry} of all files in a folder."""
    folder = Folder(folder)
    return {name: Entry.below(folder, name) for name, about in sorted(folder.everything().items()) if folder.is_regular(about)}


def manifest_rows(manifest):
    """As they stand in a seal."""
    return [{"name": name, **dataclasses.asdict(entry)} for name, entry in sorted(manifest.items())]


def _checked(content, schema, path):
    """Content of a file, right by a schema and in the names that are in it; raises BadInput."""
    wrong = fault(content, schema, "")
    if wrong:
        place, expected, found = wrong
        raise BadInput(f"{path}: {place or '/'}: expected {expected}, found {found}: it is none of Waft's, and stays as it is")
    for field in ("manifest", "new", "old"):
        for number, row in enumerate(content.get(field, ())):
            try:
                parts_of(row["name"])
            except BadInput as error:
                raise BadInput(f"{path}: /{field}/{number}/name: {error}: it is none of Waft's, and stays as it is") from error
    return content


def _entries(rows):
    """{name: Entry} of a manifest's rows that were checked."""
    return {"/".join(parts_of(row["name"])): Entry(int(row["size"]), row["digest"]) for row in rows}


def read_manifest(path):
    """{name: Entry} of the manifest in a JSON file; see manifest_in."""
    path = pathlib.Path(path)
    return manifest_in(Folder(path.parent), path.name)


def manifest_in(folder, name):
    """{name: Entry} of the manifest in a JSON file of a Folder; None where the file has none, or there is no such file. Raises
    BadInput where it is malformed."""
    content = folder.found_json(name)
    if not isinstance(content, dict) or "manifest" not in content:
        return None
    return _entries(_checked(content, _SEALED, folder.path / name)["manifest"])


def check_folder(folder):
    """Raises BadInput unless files can be written in the folder, or it can be made; makes nothing."""
    try:
        place = pathlib.Path(folder).absolute()
        while not place.exists() and place != place.parent:
            place = place.parent
    except (OSError, ValueError) as error:
        raise BadInput(f"{str(folder)[:200]}: expected the name of a folder: {getattr(error, 'strerror', error)}") from error
    if not place.is_dir():
        raise BadInput(f"{place}: expected a folder for the results, found a file")
    if not os.access(place, os.W_OK | os.X_OK):
        raise BadInput(f"{place}: expected a folder that may be written in")


class ResultPlace:
    """Held by one run from enter to exit: what was cut short is put right first, and temporary folders of dead processes go.

    root: the folder that names are relative to. seal: name of the JSON file that holds the manifest. room: name below root of
    the folder that is locked, for what is not yet whole (none: root itself); it goes when it is empty. owns: whether a name may
    be one of these results at all. Raises BadInput when another run is at work there.
    """

    def __init__(self, root, seal, room=None, owns=lambda name: True):
        self.root = pathlib.Path(root)
        self.seal = seal
        self.room = self.root / room if room else self.root
        self._room_name = room
        self._owns = owns
        self._made = []  # folders to remove when they are empty in the end, the innermost first
        self.folder = self._room = None  # Folder of root and room; the latter's descriptor has the lock
        self._reserve = []  # descriptors for the end, when there may be no others left
        self._staging = None
        self._temporary = []
        self._log = None  # of the files that were put in one by one
        self._known = {}  # the manifest then

    def __enter__(self):
        check_folder(self.root)
        self._acquire()
        try:
            self._reserve = [os.dup(self._room.descriptor) for _ in range(_RESERVE)]
            self._recover()
        except BaseException:
            self._release()
            raise
        return self

    def __exit__(self, *_):
        self._free_reserve()
        for name in self._temporary:
            self._room.remove_all(name)
        self._release()

    def _acquire(self):
        """The lock is on the folder itself; the system takes it from a process that dies."""
        while self._room is None:
            missing = [folder for folder in (self.root, *self.root.parents) if not folder.exists()]
            self.root.mkdir(parents=True, exist_ok=True)
            folder = Folder(self.root)
            if self._room_name is not None:
                folder.make_folder(self._room_name)
            self._made = [*([self.room] if self._room_name is not None else []), *missing]
            for made in self._made:
                report_to_guard("made", made)
            room = folder if self._room_name is None else folder.below(self._room_name)
            try:
                fcntl.flock(room.descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                if error.errno == errno.EWOULDBLOCK:
                    raise Busy(f"{self.room}: another run of waft is at work there") from error
                raise WaftError(f"{self.room}: cannot be locked: {error.strerror}") from error
            if room.is_still_there():  # else a run that ended meanwhile took the folder away
                self.folder, self._room = folder, room

    def _release(self):
        self._free_reserve()
        for folder in self._made:
            try:
                folder.rmdir()
            except OSError:  # something is in it
                break
        if self._log is not None:
            self._log.close()
            self._log = None
        self._room.close()
        self.folder.close()
        self.folder = self._room = None

    def _free_reserve(self):
        while self._reserve:
            os.close(self._reserve.pop())

    def _recover(self):
        """Finishes or undoes a move that was cut short; removes what dead processes left."""
        if self._room.is_folder(_MOVE):
            _Move(self.folder, self._room, self._owns).go_on()
        self._take_put()
        sweep_files(self._room.path)
        for name in filter(is_temporary, self._room.names()):
            with contextlib.suppress(BadInput):  # a link, or whatever else is of this name
                if self._room.is_folder(name):
                    self._room.remove_all(name)

    def check(self, names, replaces_all=True):
        """Raises BadInput where something that no run wrote, or that was changed since, stands in the way of files of these
        names (with a slash at their end: of folders of them), or, if all results are replaced, among the earlier ones."""
        manifest = self.manifest()
        found = [inner for name in names for inner in self._found(name)]
        if replaces_all:
            found += [name for name in manifest if self.folder.about(name) is not None]
        for name in found:
            entry, about = manifest.get(name), self.folder.about(name)
            if entry is None or not self.folder.is_regular(about):
                raise BadInput(f"{self.root / name}: {_NOT_OURS}")
            if not entry.fits(self.folder, name):
                raise BadInput(f"{self.root / name}: it was changed since a run wrote it: {_STAYS}")

    def manifest(self):
        """{name: Entry} of the results that are there, their seal included."""
        is_there = self.folder.about(self.seal) is not None
        manifest = manifest_in(self.folder, self.seal)
        if manifest is None and is_there:
            raise BadInput(f"{self.root / self.seal}: {_NOT_OURS}")
        for name in filter(lambda name: not self._owns(name), manifest or ()):
            raise BadInput(f"{self.root / self.seal}: {name}: {_NOT_OURS}")
        return {**(manifest or {}), **({self.seal: Entry()} if is_there else {})}

    def _found(self, name):
        """Names of what is there under a name that is to be written."""
        above = [str(parent) for parent in list(pathlib.PurePosixPath(name).parents)[-2::-1]]
        for folder in above + ([name.rstrip("/")] if name.endswith("/") else []):
            try:
                is_there = self.folder.is_folder(folder)
            except BadInput as error:
                raise BadInput(f"{self.root / folder}: {_NOT_OURS}") from error
            if not is_there:
                return []
        if name.endswith("/"):
            return list(self.folder.everything(name.rstrip("/")))
        return [name] if self.folder.about(name) is not None else []

    def temporary(self):
        """A new folder in the room; it goes with the run, also when that dies, but for what was moved out of it."""
        return self.room / self._new_temporary()

    def _new_temporary(self):
        while True:
            name = temporary_name()
            with contextlib.suppress(FileExistsError):
                self._room.make_new_folder(name)
                self._temporary.append(name)
                return name

    def move_in(self, path, name):
        """What is in a temporary() folder gets a name below root; raises FileExistsError where something has it."""
        self._room.move(path.relative_to(self.room).as_posix(), self.folder, name)

    def discard(self, path):
        """Removes a temporary() folder that has served."""
        self._temporary.remove(path.name)
        self._room.remove_all(path.name)

    def path(self, name):
        """Where to write the file of this name for now; its folder is there."""
        if self._staging is None:
            self._staging = self._new_temporary()
        staged = f"{self._staging}/new/{name}"
        self._room.make_folder(os.path.dirname(staged))
        return self.room / staged

    def put(self, name):
        """The file at path(name) takes its place at once; the log says so, until confirm() or the next run takes that over."""
        if self._log is None:
            self._known = self.manifest()
            self._log = self._room.new_stream(_PUT)
            self._write_log({"seal": self.seal})
        staged = f"{self._staging}/new/{name}"
        is_there = self.folder.about(name) is not None
        if is_there and not (name in self._known and self._known[name].fits(self.folder, name)):  # it came there meanwhile
            raise WaftError(f"{self.root / name}: {_NOT_OURS}")
        self._known[name] = Entry.below(self._room, staged)
        self._write_log(manifest_rows({name: self._known[name]})[0])
        if os.path.dirname(name):
            self.folder.make_folder(os.path.dirname(name))
        self._room.move(staged, self.folder, name, replaces=is_there)

    def _write_log(self, row):
        self._log.write(json.dumps(row).encode() + b"\n")
        self._log.flush()

    def confirm(self):
        """Takes what files that were put() hold into the manifest."""
        if self._log is not None:
            self._log.close()
            self._log = None
            self._take_put()

    def _take_put(self):
        """The rows of the log go into the manifest, if it is that of this seal: those whose files came to their places."""
        if not self._room.is_file(_PUT):
            return
        path = self.room / _PUT
        whole = self._room.text(_PUT).split("\n")[:-1]  # a last line that was cut is of a file that did not come
        rows = [json_of(line, path) for line in whole]
        if rows:
            if _checked(rows[0], _BEGUN, path)["seal"] != self.seal:
                return
            put = _entries(_checked({"new": rows[1:]}, _LOGGED, path)["new"])
            manifest = {**self.manifest(), **{name: entry for name, entry in put.items() if entry.fits(self.folder, name)}}
            manifest.pop(self.seal, None)
            manifest = {name: entry if entry.digest else Entry.below(self.folder, name) for name, entry in manifest.items()
                        if self._owns(name) and self.folder.about(name) is not None}
            write_json(self.path(self.seal), {"manifest": manifest_rows(manifest)})
            self._room.move(f"{self._staging}/new/{self.seal}", self.folder, self.seal, replaces=True)
        self._room.remove(_PUT)

    def commit(self, content):
        """The files at the paths that were given take the place of those of the earlier run, all or none. content: what the
        seal is to say beside the manifest."""
        prefix = f"{self._staging}/new"
        new = {name[len(prefix) + 1:]: Entry.below(self._room, name) for name in self._room.everything(prefix)}
        try:
            self.check(new)
        except BadInput as error:  # it came there while the run was computing
            raise WaftError(str(error)) from error
        write_json(self.path(self.seal), {**content, "manifest": manifest_rows(new)})
        new[self.seal] = Entry.below(self._room, f"{prefix}/{self.seal}")
        old = {name: Entry.below(self.folder, name) for name in self.manifest() if self.folder.is_file(name)}
        write_json(self.room / self._staging / _JOURNAL,
                   {"seal": self.seal, "new": manifest_rows(new), "old": manifest_rows(old)})
        self._room.move(self._staging, self._room, _MOVE)
        self._temporary.remove(self._staging)
        self._staging = None
        move = _Move(self.folder, self._room, self._owns)
        try:
            move.go_on()
        except BadInput as error:
            raise WaftError(str(error)) from error
        except OSError:
            move.undo()
            raise


def settle(place):
    """Finishes or undoes a change that was cut short at a ResultPlace that is to be read; one that goes on there is waited
    for."""
    end = time.monotonic() + _PATIENCE
    while os.path.lexists(place.room / _MOVE):
        if not os.access(place.room, os.W_OK | os.X_OK):
            raise BadInput(f"{place.room}: a change of results was cut short there: it waits for a command of waft that may "
                           "write in the folder")
        try:
            with place:
                return
        except Busy:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)


_STAYS = "it stays as it is: move it away, or choose another place for the results"
_NOT_OURS = f"no run of waft wrote it: {_STAYS}"


class _Move:
    """Results that change hands; every step can be taken again after it was cut short."""

    def __init__(self, root, room, owns):
        self._root, self._room = root, room
        path = room.path / _MOVE / _JOURNAL
        journal = room.found_json(f"{_MOVE}/{_JOURNAL}")
        if journal is None:
            raise BadInput(f"{path.parent}: a change of results was cut short, and how it was to go on cannot be read: `new` and "
                           "`old` in it hold the files")
        _checked(journal, _JOURNALED, path)
        self._seal = journal["seal"]
        self._incoming, self._outgoing = _entries(journal["new"]), _entries(journal["old"])
        for name in (*self._incoming, *self._outgoing):
            if not owns(name):
                raise BadInput(f"{path}: {name}: expected names of these results alone")
            # Whatever else could be wrong with a name is reported before the first file is moved.
            for folder, inner in ((root, name), (room, self._new(name)), (room, self._old(name))):
                try:
                    folder.about(inner)
                except BadInput as error:
                    raise BadInput(f"{path}: {name}: {error}") from error

    @staticmethod
    def _new(name):
        return f"{_MOVE}/new/{name}"

    @staticmethod
    def _old(name):
        return f"{_MOVE}/old/{name}"

    def go_on(self):
        """Puts the new results in place; where they are not whole any more, the old ones back."""
        waiting = [name for name in self._incoming if self._room.about(self._new(name)) is not None]
        if not all(self._incoming[name].fits(self._room, self._new(name)) for name in waiting):
            self.undo()
            return
        if len(waiting) == len(self._incoming):
            for name in sorted(self._outgoing, key=lambda name: name != self._seal):  # the seal first
                self._hand_over(self._root, name, self._room, self._old(name), self._outgoing[name])
        for name in sorted(waiting, key=lambda name: name == self._seal):  # the seal last
            self._hand_over(self._room, self._new(name), self._root, name, self._incoming[name])
        self._end()

    def undo(self):
        """Puts the old results back as they were."""
        for name, entry in self._incoming.items():
            if self._room.about(self._new(name)) is None:
                self._hand_over(self._root, name, self._room, self._new(name), entry)
        for name in sorted(self._outgoing, key=lambda name: name == self._seal):
            self._hand_over(self._room, self._old(name), self._root, name, self._outgoing[name])
        self._end()

    def _hand_over(self, source, name, target, new_name, entry):
        """Moves a file, unless it was moved before; raises BadInput where one of the user's came in between."""
        if source.about(name) is None:
            return
        for path, is_free in ((source.path / name, entry.fits(source, name)),
                              (target.path / new_name, target.about(new_name) is None)):
            if not is_free:
                raise BadInput(f"{path}: {_NOT_OURS}; the results that were changing hands wait in {self._room.path / _MOVE}")
        if os.path.dirname(new_name):
            target.make_folder(os.path.dirname(new_name))
        source.move(name, target, new_name)

    def _end(self):
        for folder in {os.path.dirname(name) for name in (*self._outgoing, *self._incoming)} - {""}:
            self._root.remove_empty(folder)
        gone = temporary_name()
        self._room.move(_MOVE, self._room, gone)  # from here on it is swept and not gone on with
        self._room.remove_all(gone)
