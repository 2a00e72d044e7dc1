# SPDX-License-Identifier: BSD-3-Clause
"""Where a run's files go: which of those there an earlier run wrote, one run at a time, all files at once.

A file is Waft's when a manifest names it and its content is still what the run wrote; everything else is the user's, and is
neither replaced nor removed. The manifest is part of one file of the results, their seal, which goes first and comes
last when results change hands: where there is no seal the results are not whole.

While results change hands they are in the folder `.waft-move`: `new`, those that go in; `old`, those that stand aside until all
new ones are in; `journal.json`, the names of both. A move that was cut short is finished by the next run there, or undone.
"""
import base64
import dataclasses
import errno
import fcntl
import hashlib
import os
import pathlib
import re
import secrets
import shutil
import string

from waft.failures import BadInput, WaftError
from waft.files import write_json
from waft.reading import found_json, open_stream
from waft.watching import tell_guard

_MOVE = ".waft-move"
_JOURNAL = "journal.json"
_TEMPORARY = re.compile(r"\.waft-([0-9a-z]{4})([0-9a-z]{4})")  # the second half tells of the first that a run made the folder


class Busy(BadInput):
    """Another run holds the place."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """What a run wrote under a name; without a digest, whatever is there."""

    size: int = -1
    digest: str = ""

    @classmethod
    def of(cls, path):
        content, size = hashlib.sha256(), 0
        with open_stream(path) as stream:
            while block := stream.read(1 << 20):
                content.update(block)
                size += len(block)
        return cls(size, "sha256:" + content.hexdigest())

    def fits(self, path):
        if path.is_symlink() or not path.is_file():
            return False
        return not self.digest or (self.size == path.stat().st_size and self == Entry.of(path))


def manifest_of(folder):
    """{name: Entry} of all files in a folder."""
    files = (path for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file())
    return {path.relative_to(folder).as_posix(): Entry.of(path) for path in files}


def manifest_rows(manifest):
    """As they stand in a seal."""
    return [{"name": name, **dataclasses.asdict(entry)} for name, entry in sorted(manifest.items())]


def _entries(rows):
    """{name: Entry} of a manifest's rows; raises ValueError, KeyError or TypeError where they are none."""
    manifest = {}
    for row in rows:
        name = pathlib.PurePosixPath(row["name"])
        if name.is_absolute() or ".." in name.parts or not name.parts:
            raise ValueError(f"the name {name}")
        manifest[str(name)] = Entry(int(row["size"]), str(row["digest"]))
    return manifest


def read_manifest(path):
    """{name: Entry} of the manifest in a JSON file; None where there is none."""
    content = found_json(path)
    try:
        return _entries(content["manifest"])
    except (KeyError, TypeError, ValueError):
        return None


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

    root: the folder that names are relative to. seal: name of the JSON file that holds the manifest. room: the folder that is
    locked, for what is not yet whole, on the same disk (default root); when it is another, it goes when it is empty. earlier:
    gives the {name: Entry} of results whose seal has no manifest (None: they are none of Waft's). Raises BadInput when another
    run is at work there.
    """

    def __init__(self, root, seal, room=None, earlier=None):
        self.root = pathlib.Path(root)
        self.seal = seal
        self.room = pathlib.Path(room or root)
        self._earlier = earlier or (lambda root: None)
        self._made = []  # folders to remove when they are empty in the end, the innermost first
        self._lock = None
        self._staging = None
        self._temporary = []

    def __enter__(self):
        check_folder(self.root)
        check_folder(self.room)
        self._acquire()
        try:
            _recover(self.root, self.room)
        except BaseException:
            self._release()
            raise
        return self

    def __exit__(self, *_):
        for folder in self._temporary:
            _sweep(folder)
        self._release()

    def _acquire(self):
        """The lock is on the folder itself; the system takes it from a process that dies."""
        while self._lock is None:
            missing = [folder for folder in (self.room, *self.room.parents) if not folder.exists()]
            self.room.mkdir(parents=True, exist_ok=True)
            self._made = missing or ([] if self.room == self.root else [self.room])
            for folder in self._made:
                tell_guard("made", folder)
            lock = os.open(self.room, os.O_RDONLY | os.O_DIRECTORY)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                os.close(lock)
                if error.errno == errno.EWOULDBLOCK:
                    raise Busy(f"{self.room}: another run of waft is at work there") from error
                raise WaftError(f"{self.room}: cannot be locked: {error.strerror}") from error
            if _is_same(lock, self.room):
                self._lock = lock
            else:  # a run that ended meanwhile took the folder away
                os.close(lock)

    def _release(self):
        for folder in self._made:
            try:
                folder.rmdir()
            except OSError:  # something is in it
                break
        os.close(self._lock)
        self._lock = None

    def check(self, names, replaces_all=True):
        """Raises BadInput where something that no run wrote, or that was changed since, stands in the way of files of these
        names (with a slash at their end: of folders of them), or, if all results are replaced, among the earlier ones."""
        manifest = self.manifest()
        found = [path for name in names for path in self._found(name)]
        if replaces_all:
            found += [self.root / name for name in manifest if os.path.lexists(self.root / name)]
        for path in found:
            entry = manifest.get(path.relative_to(self.root).as_posix())
            if entry is None or path.is_symlink() or not path.is_file():
                raise BadInput(f"{path}: {_NOT_OURS}")
            if not entry.fits(path):
                raise BadInput(f"{path}: it was changed since a run wrote it: {_STAYS}")

    def manifest(self):
        """{name: Entry} of the results that are there, their seal included."""
        seal = self.root / self.seal
        is_there = os.path.lexists(seal)
        manifest = read_manifest(seal)
        if manifest is None:
            manifest = self._earlier(self.root)
        if manifest is None and is_there:
            raise BadInput(f"{seal}: {_NOT_OURS}")
        return {**(manifest or {}), **({self.seal: Entry()} if is_there else {})}

    def _found(self, name):
        """What is there under a name that is to be written."""
        path = self.root / name
        folders = [self.root / parent for parent in list(pathlib.PurePosixPath(name).parents)[-2::-1]]
        for folder in folders + ([path] if name.endswith("/") else []):
            if os.path.lexists(folder) and (folder.is_symlink() or not folder.is_dir()):
                raise BadInput(f"{folder}: {_NOT_OURS}")
        if not name.endswith("/"):
            return [path] if os.path.lexists(path) else []
        return [pathlib.Path(at, entry) for at, inner, files in os.walk(path)
                for entry in files + [folder for folder in inner if os.path.islink(os.path.join(at, folder))]]

    def temporary(self):
        """A new folder; it goes with the run, also when that dies, unless it is renamed, as its folders may be."""
        folder = _free_name(self.room)
        folder.mkdir(mode=0o700)
        self._temporary.append(folder)
        return folder

    def discard(self, folder):
        """Removes a temporary() folder that has served."""
        self._temporary.remove(folder)
        _sweep(folder)

    def path(self, name):
        """Where to write the file of this name for now; its folder is there."""
        if self._staging is None:
            self._staging = self.temporary()
        path = self._staging / "new" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def claim(self, names):
        """Says in the manifest that files of these names are a run's, whatever is in them: for those put() one by one."""
        self._write_manifest({**self.manifest(), **{name: Entry() for name in names}})

    def put(self, name):
        """The file at path(name) takes its place at once."""
        target = self.root / name
        target.parent.mkdir(parents=True, exist_ok=True)
        os.replace(self.path(name), target)

    def confirm(self, names):
        """Says in the manifest what files that were put() hold; those that were not are none of a run's."""
        manifest = self.manifest()
        for name in names:
            manifest.pop(name)
            if (self.root / name).is_file():
                manifest[name] = Entry.of(self.root / name)
        self._write_manifest(manifest)

    def _write_manifest(self, manifest):
        manifest.pop(self.seal, None)
        write_json(self.path(self.seal), {"manifest": manifest_rows(manifest)})
        self.put(self.seal)

    def commit(self, content):
        """The files at the paths that were given take the place of those of the earlier run, all or none. content: what the
        seal is to say beside the manifest."""
        new = manifest_of(self._staging / "new")
        try:
            self.check(new)
        except BadInput as error:  # it came there while the run was computing
            raise WaftError(str(error)) from error
        write_json(self.path(self.seal), {**content, "manifest": manifest_rows(new)})
        new[self.seal] = Entry.of(self.path(self.seal))
        old = {name: Entry.of(self.root / name) for name in self.manifest() if (self.root / name).is_file()}
        write_json(self._staging / _JOURNAL, {"seal": self.seal, "new": manifest_rows(new), "old": manifest_rows(old)})
        os.rename(self._staging, self.room / _MOVE)
        self._staging = None
        move = _Move(self.root, self.room / _MOVE)
        try:
            move.go_on()
        except OSError:
            move.undo()
            raise


_STAYS = "it stays as it is: move it away, or choose another place for the results"
_NOT_OURS = f"no run of waft wrote it: {_STAYS}"


def _is_same(descriptor, path):
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path))
    except OSError:
        return False


def _recover(root, room):
    """Finishes or undoes a move that was cut short; removes what dead processes left."""
    if (room / _MOVE).is_dir():
        _Move(root, room / _MOVE).go_on()
    for entry in room.iterdir():
        if _is_temporary(entry.name) and not entry.is_symlink():
            _sweep(entry)


def _free_name(room):
    """A path in room for a temporary folder. That it is one is in its name: whatever happens to its run, it is known as one from
    the moment it is there until it is gone, and a folder of the user's is none."""
    while True:
        start = "".join(secrets.choice(string.ascii_lowercase + string.digits) for _ in range(4))
        path = room / f".waft-{start}{_check_of(start)}"
        if not os.path.lexists(path):
            return path


def _check_of(start):
    """Four letters and digits that go with four others."""
    return base64.b32encode(hashlib.sha256(f"temporary of waft: {start}".encode()).digest()).decode()[:4].lower()


def _is_temporary(name):
    match = _TEMPORARY.fullmatch(name)
    return match is not None and match[2] == _check_of(match[1])


def _sweep(folder):
    """Removes a temporary folder as far as the system lets it; a later run goes on with that."""
    shutil.rmtree(folder, ignore_errors=True)


class _Move:
    """Results that change hands; every step can be taken again after it was cut short."""

    def __init__(self, root, folder):
        self._root = root
        self._folder = folder
        self._new, self._old = folder / "new", folder / "old"
        journal = found_json(folder / _JOURNAL)
        try:
            self._seal = journal["seal"]
            self._incoming, self._outgoing = _entries(journal["new"]), _entries(journal["old"])
        except (KeyError, TypeError, ValueError) as error:
            raise WaftError(f"{folder}: a change of results was cut short, and how it was to go on cannot be read; `new` and "
                            "`old` in it hold the files") from error

    def go_on(self):
        """Puts the new results in place; where they are not whole any more, the old ones back."""
        waiting = [name for name in self._incoming if os.path.lexists(self._new / name)]
        if not all(self._incoming[name].fits(self._new / name) for name in waiting):
            self.undo()
            return
        if len(waiting) == len(self._incoming):
            for name in sorted(self._outgoing, key=lambda name: name != self._seal):  # the seal first
                self._hand_over(name, self._root, self._old, self._outgoing[name])
        for name in sorted(waiting, key=lambda name: name == self._seal):  # the seal last
            self._hand_over(name, self._new, self._root, self._incoming[name])
        self._end()

    def undo(self):
        """Puts the old results back as they were."""
        for name, entry in self._incoming.items():
            if not os.path.lexists(self._new / name):
                self._hand_over(name, self._root, self._new, entry)
        for name in sorted(self._outgoing, key=lambda name: name == self._seal):
            self._hand_over(name, self._old, self._root, self._outgoing[name])
        self._end()

    def _hand_over(self, name, source, target, entry):
        """Moves a file, unless it was moved before; raises WaftError where one of the user's came in between."""
        source, target = source / name, target / name
        if not os.path.lexists(source):
            return
        for path, is_free in ((source, entry.fits(source)), (target, not os.path.lexists(target))):
            if not is_free:
                raise WaftError(f"{path}: {_NOT_OURS}; the results that were changing hands wait in {self._folder}")
        target.parent.mkdir(parents=True, exist_ok=True)
        os.rename(source, target)

    def _end(self):
        for folder in {pathlib.PurePosixPath(name).parent for name in (*self._outgoing, *self._incoming)}:
            _remove_empty(self._root, folder)
        gone = _free_name(self._folder.parent)
        os.rename(self._folder, gone)  # from here on it is swept and not gone on with
        _sweep(gone)


def _remove_empty(root, folder):
    """Removes a folder of results and those above it while they are empty."""
    while folder.parts:
        try:
            (root / folder).rmdir()
        except OSError:
            return
        folder = folder.parent
