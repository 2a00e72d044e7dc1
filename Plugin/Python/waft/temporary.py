# SPDX-License-Identifier: BSD-3-Clause
"""Files and folders that are there for a while. That one is temporary is in its name: whatever happens to its process, it is
known as one from the moment it is there until it is gone, and a file of the user's is none."""
import base64
import contextlib
import fcntl
import hashlib
import os
import re
import secrets
import stat
import string

_NAME = re.compile(r"\.waft-([0-9a-z]{4})([0-9a-z]{4})")  # the second half tells of the first that Waft made it
_NEW = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC


def temporary_name():
    """One of a million and more, by chance."""
    start = "".join(secrets.choice(string.ascii_lowercase + string.digits) for _ in range(4))
    return f".waft-{start}{_check_of(start)}"


def is_temporary(name):
    match = _NAME.fullmatch(name)
    return match is not None and match[2] == _check_of(match[1])


def _check_of(start):
    """Four letters and digits that go with four others."""
    return base64.b32encode(hashlib.sha256(f"temporary of waft: {start}".encode()).digest()).decode()[:4].lower()


@contextlib.contextmanager
def temporary_file(folder):
    """(path, descriptor) of a new, empty file in a folder, which goes at the end unless it was renamed; sweeps those of dead
    processes."""
    sweep_files(folder)
    path, descriptor = _new_file(folder)
    try:
        yield path, descriptor
    finally:
        if is_same(descriptor, path):
            with contextlib.suppress(OSError):
                os.unlink(path)
        os.close(descriptor)


def _new_file(folder):
    """Its path and a descriptor, whose lock says that its process lives."""
    while True:
        path = os.path.join(folder, temporary_name())
        try:
            descriptor = os.open(path, _NEW, 0o666)
        except FileExistsError:
            continue
        with contextlib.suppress(OSError):  # where nothing can be locked nothing is swept
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        if is_same(descriptor, path):  # not taken for a dead one's before it was locked
            return path, descriptor
        os.close(descriptor)


def is_same(descriptor, path):
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path, follow_symlinks=False))
    except OSError:
        return False


def sweep_files(folder):
    """Removes the temporary files that processes left in a folder when they died."""
    with contextlib.suppress(OSError):  # one that may be written in and not looked at
        for path in [os.path.join(folder, name) for name in os.listdir(folder) if is_temporary(name)]:
            with contextlib.suppress(OSError):
                if stat.S_ISREG(os.stat(path, follow_symlinks=False).st_mode):
                    _sweep_file(path)


def _sweep_file(path):
    with open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as stream:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if is_same(stream.fileno(), path):
            os.unlink(path)
