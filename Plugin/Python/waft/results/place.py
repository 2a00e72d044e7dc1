# SPDX-License-Identifier: BSD-3-Clause
"""Where a run's files go: which of those there an earlier run wrote, one run at a time, all files at once.

A file is Waft's when a manifest names it and its content is still what the run wrote; everything else is the user's, and is
neither replaced nor removed. The manifest is part of one file of the results, their seal, which goes first and comes last when
results change hands: where there is no seal the results are not whole. Documentation/Developer.md has the order of the steps.

The folder may be a stranger's: all that is below it is reached by beneath.Folder, by names alone, and what seals and staged
manifests say is looked at like any input.
"""
import contextlib
import dataclasses
import fcntl
import hashlib
import os
import pathlib
import stat
import time

from waft.beneath import Folder, parts_of
from waft.failures import InputError, WaftError
from waft.files import write_json
from waft.results._records import CHANGE, SEALED, checked
from waft.temporary import is_same, is_temporary, sweep_files, temporary_name

LOCK = ".waft-lock"
_STAGED = "manifest.json"
_FORMER = (".waft-move", ".waft-put")
_PATIENCE = 20.0  # s that results may take to change hands

_STAYS = "it stays as it is: move it away, or choose another place for the results"
_NOT_OURS = f"no run of waft wrote it: {_STAYS}"


class Busy(InputError):
    """Another run holds the place."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """What a run wrote under a name."""

    size: int
    digest: str

    @classmethod
    def of(cls, stream):
        """Of a binary stream, which is closed."""
        with stream:
            digest = hashlib.file_digest(stream, "sha256").hexdigest()
            return cls(stream.tell(), f"sha256:{digest}")

    @classmethod
    def below(cls, folder, name):
        """Of a file in a Folder."""
        return cls.of(folder.stream(name))

    def fits(self, folder, name):
        """Whether it is what a Folder has under a name."""
        try:
            return folder.is_file(name) and folder.about(name).st_size == self.size and self == Entry.below(folder, name)
        except InputError:
            return False


def manifest_of(folder):
    """{name: Entry} of all files in a folder."""
    folder = Folder(folder)
    return {name: Entry.below(folder, name) for name, about in sorted(folder.everything().items()) if folder.is_regular(about)}


def manifest_rows(manifest):
    """As they stand in a seal."""
    return [{"name": name, **dataclasses.asdict(entry)} for name, entry in sorted(manifest.items())]


def _entries(content, field, path):
    """{name: Entry} of a manifest's rows, right by their schema; raises InputError where a name leads out of the folder."""
    found = {}
    for number, row in enumerate(content[field]):
        try:
            found["/".join(parts_of(row["name"]))] = Entry(int(row["size"]), row["digest"])
        except InputError as error:
            raise InputError(f"{path}: /{field}/{number}/name: {error}") from error
    return found


def manifest_in(folder, name):
    """{name: Entry} of the manifest in a JSON file of a Folder; None where the file has none, or there is no such file. Raises
    InputError where it is malformed."""
    try:
        content = folder.json(name)
    except InputError:
        return None
    if not isinstance(content, dict) or "manifest" not in content:
        return None
    return _entries(checked(content, SEALED, folder.path / name), "manifest", folder.path / name)


def check_folder(folder):
    """Raises InputError unless files can be written in the folder, or it can be made; makes nothing."""
    try:
        place = pathlib.Path(folder).absolute()
        while (about := _about(place)) is None and place != place.parent:
            place = place.parent
    except (OSError, ValueError) as error:
        raise InputError(f"{str(folder)[:200]}: expected the name of a folder: {getattr(error, 'strerror', error)}") from error
    if about is not None and not stat.S_ISDIR(about.st_mode):
        raise InputError(f"{place}: expected a folder for the results, found a file")
    if not os.access(place, os.W_OK | os.X_OK):
        if _about(place) is None:  # the folder of a run that ended meanwhile, which took it away
            return check_folder(folder)
        raise InputError(f"{place}: expected a folder that may be written in")


def _about(path):
    """What the system says of a path, links followed; None where there is nothing, or a link to nothing."""
    try:
        return path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return None


def is_at_work(folder):
    """Whether a run holds a Folder."""
    try:
        with folder.stream(LOCK) as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except InputError:
        return False
    except BlockingIOError:
        return True
    return False


def _stagings(room):
    """Names of the folders in a Folder in which runs stage, or staged, their files."""
    about = {name: room.about(name) for name in room.names() if is_temporary(name)}
    return [name for name, found in about.items() if found is not None and stat.S_ISDIR(found.st_mode)]


def _is_cut_short(room):
    """Whether results that are staged whole in a Folder wait for their places. Raises InputError of what former versions left."""
    for name in _FORMER:
        if room.about(name) is not None:
            raise InputError(f"{room.path / name}: an earlier build of Waft 0.1.0 was cut short while its results changed hands: move the files "
                             "of its folder `new` (or, for the results before, `old`) to their places by hand, then remove it")
    return any(room.about(f"{name}/{_STAGED}") is not None for name in _stagings(room))


class ResultPlace:
    """Held by one run from enter to exit: what was cut short is finished first, and what dead processes staged goes.

    root: the folder that names are relative to. seal: name of the JSON file that holds the manifest. room: name below root of
    the folder that has the lock and what is staged (none: root itself); it goes when it is empty. owns: whether a name may be one
    of these results at all. folder: the Folder of root, None unless it is held. Raises InputError when another run is at work there.
    """

    def __init__(self, root, seal, room=None, owns=lambda name: True):
        self.root = pathlib.Path(root)
        self.seal = seal
        self.room = self.root / room if room else self.root
        self._owns = owns
        self._made = []  # folders to remove when they are empty in the end, the innermost first
        self.folder = self._room = self._lock = self._staging = None

    def __enter__(self):
        check_folder(self.root)
        while self._lock is None:
            self._try_to_lock()
        try:
            _is_cut_short(self._room)
            for name in _stagings(self._room):
                if self._room.about(f"{name}/{_STAGED}") is not None:
                    self._finish(name)
                self._room.remove_all(name)
            sweep_files(self.room)
        except BaseException:
            self._release()
            raise
        return self

    def __exit__(self, *_):
        if self._lock is not None:
            self._release()

    def _try_to_lock(self):
        """The system takes the lock from a process that dies. Does nothing where a run that ended meanwhile took lock or folder away."""
        self._made = [folder for folder in (self.root, *self.root.parents) if not folder.exists()] or self._made
        try:
            self.root.mkdir(parents=True, exist_ok=True)
            folder = room = Folder(self.root)
        except (FileExistsError, FileNotFoundError, InputError) as error:
            if self.root.is_symlink() or not isinstance(error.__cause__ or error, (FileExistsError, FileNotFoundError)):
                raise
            return
        try:
            if self.room != self.root:
                folder.make_folder(self.room.name)
                room = folder.below(self.room.name)
            lock = room.own(LOCK)
        except FileNotFoundError:
            return
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if is_same(lock, self.room / LOCK):
                self.folder, self._room, self._lock = folder, room, lock
        except BlockingIOError as error:
            raise Busy(f"{self.room}: another run of waft is at work there") from error
        except OSError as error:
            raise WaftError(f"{self.room}: cannot be locked: {error.strerror}") from error
        finally:
            if self._lock is None:
                os.close(lock)

    def _release(self):
        if self._staging is not None:
            self._room.remove_all(self._staging)
        if is_same(self._lock, self.room / LOCK):
            self._room.remove(LOCK)
        os.close(self._lock)
        self.folder = self._room = self._lock = self._staging = None
        with contextlib.suppress(OSError):  # something is in it
            for folder in ([self.room] if self.room != self.root else []) + self._made:
                folder.rmdir()

    def settle(self):
        """Finishes a change of results that was cut short where they are to be read; one that goes on there is waited for."""
        end = time.monotonic() + _PATIENCE
        while self.room.is_dir() and _is_cut_short(Folder(self.room)):
            if not os.access(self.room, os.W_OK | os.X_OK):
                raise InputError(f"{self.room}: a change of results was cut short there: it waits for a command of waft that may "
                                 "write in the folder")
            try:
                with self:
                    return
            except Busy:
                if time.monotonic() > end:
                    raise
                time.sleep(0.05)

    def check(self, names, replaces_all=True):
        """Raises InputError where something that no run wrote, or that was changed since, stands in the way of files of these
        names (with a slash at their end: of folders of them), or, if all results are replaced, among the earlier ones; returns
        the manifest of those."""
        manifest = self.manifest()
        found = [inner for name in names for inner in self._found(name)]
        for name in [*found, *(manifest if replaces_all else ())]:
            self._check_own(name, manifest)
        return manifest

    def manifest(self):
        """{name: Entry} of the results that are there, their seal included."""
        manifest = manifest_in(self.folder, self.seal)
        if manifest is None and self.folder.about(self.seal) is None:
            return {}
        if manifest is None or not all(map(self._owns, manifest)):
            raise InputError(f"{self.root / self.seal}: {_NOT_OURS}")
        return {**manifest, self.seal: Entry.below(self.folder, self.seal)}

    def _found(self, name):
        """Names of what is there under a name that is to be written."""
        try:
            return self.folder.everything(name.rstrip("/")) if name.endswith("/") else [name] if self.folder.about(name) is not None else []
        except InputError as error:
            raise InputError(f"{self.root / name}: {_NOT_OURS}") from error

    def _check_own(self, name, manifest):
        """Raises InputError where what has a name is no file that a manifest has."""
        about = self.folder.about(name)
        if about is None or name in manifest and manifest[name].fits(self.folder, name):
            return
        is_changed = name in manifest and self.folder.is_regular(about)
        raise InputError(f"{self.root / name}: {f'it was changed since a run wrote it: {_STAYS}' if is_changed else _NOT_OURS}")

    def _stage(self):
        """The name of the folder in the room in which this run stages its files; it goes with the run, also when that dies."""
        while self._staging is None:
            name = temporary_name()
            with contextlib.suppress(FileExistsError):
                os.mkdir(name, 0o700, dir_fd=self._room.descriptor)
                self._staging = name
        return self._staging

    def path(self, name):
        """Where to write the file of this name for now; its folder is there."""
        staged = f"{self._stage()}/new/{name}"
        self._room.make_folder(os.path.dirname(staged))
        return self.room / staged

    def commit(self, content, names=None):
        """The files at the paths that were given take the place of those of the earlier run, all or none. content: what the seal is to
        say beside the manifest. names: these alone are whole, and stand beside those of the earlier run that have other names."""
        staging = self._stage()
        staged = [name[len(staging) + 5:] for name in self._room.everything(f"{staging}/new")] if names is None else names
        new = {name: Entry.below(self._room, f"{staging}/new/{name}") for name in staged}
        try:
            before = self.check(new, replaces_all=names is None)
        except InputError as error:  # it came there while the run was computing
            raise WaftError(str(error)) from error
        kept = {name: entry for name, entry in before.items() if names is not None and name not in new and name != self.seal
                and self.folder.about(name) is not None}
        write_json(self.path(self.seal), {**content, "manifest": manifest_rows({**kept, **new})})
        new[self.seal] = Entry.below(self._room, f"{staging}/new/{self.seal}")
        old = {name: entry for name, entry in before.items() if name not in kept}
        write_json(self.room / staging / "part", {"seal": self.seal, "new": manifest_rows(new), "old": manifest_rows(old)})
        self._room.move(f"{staging}/part", self._room, f"{staging}/{_STAGED}", replaces=True)
        self._staging = None  # from here on it is finished, by whomever
        try:
            self._finish(staging)
        except InputError as error:
            raise WaftError(str(error)) from error
        if names is None:
            self._room.remove_all(staging)
        else:
            self._room.remove(f"{staging}/{_STAGED}")
            self._staging = staging

    def _finish(self, staging):
        """Takes a change of results that is staged whole to its end, from wherever it was cut short."""
        path = f"{staging}/{_STAGED}"
        change = checked(self._room.json(path), CHANGE, self._room.path / path)
        seal = change["seal"]
        new, old = (_entries(change, which, self._room.path / path) for which in ("new", "old"))
        if seal not in new or not all(map(self._owns, (*new, *old))):
            raise InputError(f"{self._room.path / path}: expected names of these results alone, with that of their seal in /new")
        waiting = {name: f"{staging}/new/{name}" for name in new if self._room.about(f"{staging}/new/{name}") is not None}
        if seal not in waiting:  # which comes last
            return
        for name, staged in waiting.items():
            if not new[name].fits(self._room, staged):
                raise InputError(f"{self._room.path / staged}: expected the file that a run left there for {self.root / name}, found another: "
                                 f"remove {self._room.path / staging} and do anew what was cut short")
            try:
                self._check_own(name, old)
            except InputError as error:
                raise InputError(f"{error}; the results that are to come there wait in {self._room.path / staging}") from error
        with contextlib.suppress(FileNotFoundError):
            self.folder.remove(seal)
        for name in [name for name in waiting if name != seal]:
            self._move_in(waiting[name], name, old)
        for name in old.keys() - new.keys():
            if old[name].fits(self.folder, name):
                self.folder.remove(name)
                self.folder.remove_empty(os.path.dirname(name))
        self._move_in(waiting[seal], seal, {})

    def _move_in(self, staged, name, old):
        if os.path.dirname(name):
            self.folder.make_folder(os.path.dirname(name))
        self._room.move(staged, self.folder, name, replaces=name in old)
