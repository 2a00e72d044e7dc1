# SPDX-License-Identifier: BSD-3-Clause
"""What is below a folder that may be a stranger's: it is reached from a descriptor of the folder, part by part, and no link is
followed on the way. So neither a name that a file in the folder holds nor a link that lies in it leads out of it."""
import contextlib
import os
import pathlib
import stat
import weakref

from waft.failures import BadInput, shortened
from waft.reading import (MOST, MOST_TEXT, blocks_of, content_of, found_in_words, json_of, kind_of, open_file, rows_of, steps_of,
                          text_of)
from waft.renaming import move_new

_DEEPEST = 64  # folders, one in the other
_LONGEST = 255  # bytes of a name
_MOST_NAMES = 1 << 24  # bytes of a file that names others
_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
_PART = os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC


def parts_of(name):
    """The parts of a name below a folder; raises BadInput of an absolute one, and of one that leads above it."""
    text = os.fspath(name) if isinstance(name, (str, os.PathLike)) else None
    parts = pathlib.PurePosixPath(text).parts if text and "\0" not in text else ()
    if (not 0 < len(parts) <= _DEEPEST or ".." in parts or text.startswith("/")
            or any(len(part.encode("utf-8", "surrogateescape")) > _LONGEST for part in parts)):
        raise BadInput(f"{shortened(repr(name), 100)}: expected the name of a file below the folder")
    return parts


class Folder:
    """A folder, named through links or not; names are relative to it, with slashes. Raises BadInput where there is none, where a
    part of a name is a link or no folder, and where a name leads out of it; FileNotFoundError where a part is missing, unless a
    function says otherwise."""

    def __init__(self, path, descriptor=None):
        self.path = pathlib.Path(path)
        try:
            self.descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC) if descriptor is None else descriptor
        except (OSError, ValueError) as error:
            raise BadInput(f"{path}: {getattr(error, 'strerror', None) or error}; expected a folder") from error
        self.close = weakref.finalize(self, os.close, self.descriptor)

    @contextlib.contextmanager
    def _in(self, parts):
        """The descriptor of a folder below, for a while."""
        descriptor = os.dup(self.descriptor)
        try:
            for number, part in enumerate(parts, 1):
                descriptor = self._next(descriptor, part, parts[:number])
            yield descriptor
        finally:
            os.close(descriptor)

    @contextlib.contextmanager
    def _at(self, name):
        """(descriptor of the folder that a name is in, the last part of the name)"""
        *above, last = parts_of(name)
        with self._in(above) as descriptor:
            yield descriptor, last

    def _next(self, descriptor, part, way):
        """The descriptor of a folder in one, which is closed."""
        try:
            inner = os.open(part, os.O_RDONLY | _PART, dir_fd=descriptor)
        except NotADirectoryError as error:
            about = os.stat(part, dir_fd=descriptor, follow_symlinks=False)
            raise BadInput(f"{self.path.joinpath(*way)}: expected a folder, found {found_in_words(about)}") from error
        except PermissionError as error:
            raise BadInput(f"{self.path.joinpath(*way)}: expected a folder that may be read: {error.strerror}") from error
        os.close(descriptor)
        return inner

    def below(self, name):
        """The Folder of a folder below it."""
        *above, last = parts_of(name)
        with self._in(above) as descriptor:
            return Folder(self.path / name, self._next(os.dup(descriptor), last, parts_of(name)))

    def is_still_there(self):
        """Whether its path still leads to it."""
        try:
            return os.path.samestat(os.fstat(self.descriptor), os.stat(self.path))
        except OSError:
            return False

    # What is there

    def about(self, name):
        """The os.stat_result of what has a name, be it a link; None where nothing has it."""
        try:
            with self._at(name) as (folder, last):
                return os.stat(last, dir_fd=folder, follow_symlinks=False)
        except FileNotFoundError:
            return None

    def is_file(self, name):
        """Whether there is a file; raises BadInput where there is something else."""
        about = self.about(name)
        if about is not None and kind_of(about):
            raise BadInput(f"{self.path / name}: expected a file, found {kind_of(about)}")
        return about is not None

    @staticmethod
    def is_regular(about):
        return about is not None and not kind_of(about)

    def is_folder(self, name):
        """Whether there is a folder; raises BadInput where there is something else."""
        about = self.about(name)
        if about is not None and not stat.S_ISDIR(about.st_mode):
            raise BadInput(f"{self.path / name}: expected a folder, found {found_in_words(about)}")
        return about is not None

    def names(self, name=None):
        """Names of what is in it, or in a folder below it; none where there is no such folder."""
        if name is None:
            return sorted(os.listdir(self.descriptor))
        if not self.is_folder(name):
            return []
        with self._in(parts_of(name)) as folder:
            return sorted(os.listdir(folder))

    def everything(self, name=None):
        """{name: os.stat_result} of all below it that is no folder, or below a folder in it."""
        found = {}
        for entry in self.names(name):
            whole = entry if name is None else f"{name}/{entry}"
            about = self.about(whole)
            if about is not None and stat.S_ISDIR(about.st_mode):
                found.update(self.everything(whole))
            elif about is not None:
                found[whole] = about
        return found

    # Reading

    def open(self, name, what="a file"):
        """A descriptor of a file, to be read."""
        try:
            with self._at(name) as (folder, last):
                return open_file(last, what, folder, self.path / name)
        except FileNotFoundError as error:
            raise BadInput(f"{self.path / name}: {error.strerror}; expected {what}") from error

    def stream(self, name):
        """A binary stream of a file."""
        return os.fdopen(self.open(name), "rb")

    def bytes(self, name, most=MOST, what="a file"):
        return content_of(self.open(name, what), self.path / name, most)

    def text(self, name, most=MOST_TEXT, what="a text"):
        return text_of(self.bytes(name, most, what), self.path / name, what)

    def json(self, name, what="a file of JSON"):
        return json_of(self.text(name, what=what), self.path / name)

    def found_json(self, name):
        """The same; None where there is none that can be read."""
        try:
            return self.json(name)
        except BadInput:
            return None

    def rows(self, name, what="a table"):
        return rows_of(self.text(name, what=what), self.path / name, what)

    def steps(self, name):
        """[(time in seconds, name of a file)] of a ParaView collection; the files are there or not."""
        steps = steps_of(self.text(name, _MOST_NAMES, "a collection"), self.path / name)
        self._check_named(name, (inner for _, inner in steps))
        return steps

    def check_blocks(self, name):
        """Raises BadInput where a .vtm names anything but files below the folder, be they there or not."""
        self._check_named(name, blocks_of(self.text(name, _MOST_NAMES, "a file of blocks"), self.path / name))

    def _check_named(self, name, named):
        """Looks at what a file names."""
        for inner in named:
            try:
                self.is_file(inner)
            except BadInput as error:
                raise BadInput(f"{self.path / name}: {error}") from error

    def file(self, name, what="a file"):
        """The path of a file, for a library to open."""
        os.close(self.open(name, what))
        return str(self.path / name)

    def found(self, name):
        """The same; None where nothing has this name."""
        return self.file(name) if self.is_file(name) else None

    # Changing

    def new_stream(self, name):
        """A binary stream that writes a new file; raises FileExistsError where something has its name."""
        with self._at(name) as (folder, last):
            return os.fdopen(os.open(last, _NEW, 0o666, dir_fd=folder), "wb")

    def make_folder(self, name):
        """A folder, and those that it is in, where they are not there yet."""
        parts = parts_of(name)
        for count in range(1, len(parts) + 1):
            part = "/".join(parts[:count])
            if not self.is_folder(part):
                with self._at(part) as (folder, last):
                    os.mkdir(last, dir_fd=folder)

    def make_new_folder(self, name):
        """A folder for this user alone; raises FileExistsError where something has its name."""
        with self._at(name) as (folder, last):
            os.mkdir(last, 0o700, dir_fd=folder)

    def move(self, name, target, new_name, replaces=False):
        """Renames a file or folder to a name below another Folder; raises FileExistsError where something has it, unless that
        is to be replaced."""
        with self._at(name) as (source_folder, source), target._at(new_name) as (target_folder, last):
            if replaces:
                os.rename(source, last, src_dir_fd=source_folder, dst_dir_fd=target_folder)
            else:
                move_new(source, last, source_folder, target_folder)

    def remove(self, name):
        """Removes a file, or a link itself."""
        with self._at(name) as (folder, last):
            os.unlink(last, dir_fd=folder)

    def remove_empty(self, name):
        """Removes a folder and those that it is in while they are empty."""
        for part in (name, *map(str, list(pathlib.PurePosixPath(name).parents)[:-1])):
            try:
                with self._at(part) as (folder, last):
                    os.rmdir(last, dir_fd=folder)
            except (OSError, BadInput):
                return

    def remove_all(self, name):
        """Removes a folder and what is in it, as far as the system lets it: a later call goes on with that. It takes a descriptor
        for each level, and two."""
        with contextlib.suppress(OSError, BadInput, RecursionError), self._at(name) as (folder, last):
            _remove(folder, last)


def _remove(folder, name):
    with contextlib.suppress(IsADirectoryError, PermissionError):
        os.unlink(name, dir_fd=folder)
        return
    inner = os.open(name, os.O_RDONLY | _PART, dir_fd=folder)
    try:
        for entry in os.listdir(inner):
            with contextlib.suppress(OSError):
                _remove(inner, entry)
    finally:
        os.close(inner)
    os.rmdir(name, dir_fd=folder)
