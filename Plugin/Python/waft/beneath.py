# SPDX-License-Identifier: BSD-3-Clause
"""What is below a folder that may be a stranger's: the system opens it beneath a descriptor of the folder and follows no link on the
way. So neither a name that a file in the folder holds nor a link that lies in it leads out of it."""
import contextlib
import ctypes
import errno
import os
import pathlib
import shutil
import stat
import struct
import weakref

from waft.failures import InputError, shortened
from waft.reading import LOOK, MOST, MOST_TEXT, blocks_of, content_of, found_in_words, json_of, kind_of, regular, rows_of, steps_of, text_of
from waft.renaming import move_new

_DEEPEST = 64  # folders, one in the other
_LONGEST = 255  # bytes of a name
_MOST_NAMES = 1 << 24  # bytes of a file that names others
_FOLDER = os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
_OPENAT2, _RESOLVE = 437, 0x04 | 0x08  # RESOLVE_NO_SYMLINKS, RESOLVE_BENEATH
_SYSTEM = ctypes.CDLL(None, use_errno=True)
_NOT_KNOWN = (errno.ENOSYS, errno.EPERM)  # by an older system, or in a container
_IN_WORDS = {errno.ELOOP: "it is a link, or below one", errno.ENOTDIR: "it, or what it is in, is no folder", errno.EISDIR: "it is a folder",
             errno.ENXIO: "it is a socket", errno.EACCES: "it may not be opened"}


def parts_of(name):
    """The parts of a name below a folder; raises InputError of an absolute one, and of one that leads above it."""
    text = os.fspath(name) if isinstance(name, (str, os.PathLike)) else None
    parts = pathlib.PurePosixPath(text).parts if text and "\0" not in text else ()
    if (not 0 < len(parts) <= _DEEPEST or ".." in parts or text.startswith("/")
            or any(len(part.encode("utf-8", "surrogateescape")) > _LONGEST for part in parts)):
        raise InputError(f"{shortened(repr(name), 100)}: expected the name of a file below the folder")
    return parts


def _opened(folder, parts, flags, mode):
    """A descriptor of what has these parts as its name below a descriptor of a folder."""
    how = struct.pack("QQQ", flags | os.O_NOFOLLOW | os.O_CLOEXEC, mode, _RESOLVE)
    descriptor = _SYSTEM.syscall(_OPENAT2, folder, os.fsencode("/".join(parts)), how, len(how))
    if descriptor >= 0:
        return descriptor
    if ctypes.get_errno() not in _NOT_KNOWN:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), "/".join(parts))
    with contextlib.ExitStack() as way:
        for part in parts[:-1]:
            folder = os.open(part, os.O_PATH | _FOLDER, dir_fd=folder)
            way.callback(os.close, folder)
        return os.open(parts[-1], flags | os.O_NOFOLLOW | os.O_CLOEXEC, mode, dir_fd=folder)


class Folder:
    """A folder, named through links or not; names are relative to it, with slashes. Raises InputError where there is none, where a
    part of a name is a link or no folder, and where a name leads out of it; FileNotFoundError where a part is missing, unless a
    function says otherwise."""

    def __init__(self, path, descriptor=None):
        self.path = pathlib.Path(path)
        try:
            self.descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC) if descriptor is None else descriptor
        except (OSError, ValueError) as error:
            raise InputError(f"{path}: {getattr(error, 'strerror', None) or error}; expected a folder") from error
        weakref.finalize(self, os.close, self.descriptor)

    def _open(self, name, flags, what="a folder", mode=0):
        try:
            return _opened(self.descriptor, parts_of(name), flags, mode)
        except OSError as error:
            if error.errno in _IN_WORDS:
                raise InputError(f"{self.path / name}: {_IN_WORDS[error.errno]}; expected {what}") from error
            raise

    @contextlib.contextmanager
    def _at(self, name):
        """(descriptor of the folder that a name is in, the last part of the name)"""
        *above, last = parts_of(name)
        folder = self._open("/".join(above), os.O_PATH | os.O_DIRECTORY) if above else os.dup(self.descriptor)
        try:
            yield folder, last
        finally:
            os.close(folder)

    def below(self, name):
        """The Folder of a folder below it."""
        descriptor = self._open(name, os.O_RDONLY | os.O_DIRECTORY)
        return Folder(self.path / name, descriptor)

    # What is there

    def about(self, name):
        """The os.stat_result of what has a name, be it a link; None where nothing has it."""
        try:
            with self._at(name) as (folder, last):
                return os.stat(last, dir_fd=folder, follow_symlinks=False)
        except FileNotFoundError:
            return None

    def is_file(self, name):
        """Whether there is a file; raises InputError where there is something else."""
        about = self.about(name)
        if about is not None and kind_of(about):
            raise InputError(f"{self.path / name}: expected a file, found {kind_of(about)}")
        return about is not None

    @staticmethod
    def is_regular(about):
        return about is not None and not kind_of(about)

    def is_folder(self, name):
        """Whether there is a folder; raises InputError where there is something else."""
        about = self.about(name)
        if about is not None and not stat.S_ISDIR(about.st_mode):
            raise InputError(f"{self.path / name}: expected a folder, found {found_in_words(about)}")
        return about is not None

    def names(self, name=None):
        """Names of what is in it, or in a folder below it; none where there is no such folder."""
        if name is not None:
            return self.below(name).names() if self.is_folder(name) else []
        return sorted(os.listdir(self.descriptor))

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

    def _look(self, name, what):
        """A descriptor of a file, to be read."""
        try:
            return regular(self._open(name, LOOK, what), self.path / name, what)
        except FileNotFoundError as error:
            raise InputError(f"{self.path / name}: {error.strerror}; expected {what}") from error

    def stream(self, name):
        """A binary stream of a file."""
        return os.fdopen(self._look(name, "a file"), "rb")

    def bytes(self, name, most=MOST, what="a file"):
        return content_of(self._look(name, what), self.path / name, most)

    def text(self, name, most=MOST_TEXT, what="a text"):
        return text_of(self.bytes(name, most, what), self.path / name, what)

    def json(self, name, what="a file of JSON"):
        return json_of(self.text(name, what=what), self.path / name)

    def rows(self, name, what="a table"):
        return rows_of(self.text(name, what=what), self.path / name, what)

    def steps(self, name):
        """[(time in seconds, name of a file)] of a ParaView collection; the files are there or not."""
        steps = steps_of(self.text(name, _MOST_NAMES, "a collection"), self.path / name)
        self._check_named(name, (inner for _, inner in steps))
        return steps

    def check_blocks(self, name):
        """Raises InputError where a .vtm names anything but files below the folder, be they there or not."""
        self._check_named(name, blocks_of(self.text(name, _MOST_NAMES, "a file of blocks"), self.path / name))

    def _check_named(self, name, named):
        """Looks at what a file names."""
        for inner in named:
            try:
                self.is_file(inner)
            except InputError as error:
                raise InputError(f"{self.path / name}: {error}") from error

    def file(self, name, what="a file"):
        """The path of a file, for a library to open."""
        os.close(self._look(name, what))
        return str(self.path / name)

    def found(self, name):
        """The same; None where nothing has this name."""
        return self.file(name) if self.is_file(name) else None

    # Changing

    def own(self, name):
        """A descriptor, to write, of an empty file that is made where nothing has its name; raises InputError where something else has."""
        descriptor = self._open(name, os.O_RDWR | os.O_CREAT | os.O_NONBLOCK, "an empty file, or none", 0o666)
        about = os.fstat(descriptor)
        if kind_of(about) or about.st_size:
            os.close(descriptor)
            raise InputError(f"{self.path / name}: expected an empty file, or none, found {kind_of(about) or 'another'}")
        return descriptor

    def make_folder(self, name):
        """A folder, and those that it is in, where they are not there yet."""
        parts = parts_of(name)
        for count in range(1, len(parts) + 1):
            with self._at("/".join(parts[:count])) as (folder, last), contextlib.suppress(FileExistsError):
                os.mkdir(last, dir_fd=folder)

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
        with contextlib.suppress(OSError, InputError):
            for part in (name, *map(str, list(pathlib.PurePosixPath(name).parents)[:-1])):
                with self._at(part) as (folder, last):
                    os.rmdir(last, dir_fd=folder)

    def remove_all(self, name):
        """Removes a folder in it and what is in that, as far as the system lets it; no link is followed."""
        with contextlib.suppress(RecursionError):
            shutil.rmtree(name, ignore_errors=True, dir_fd=self.descriptor)
