# SPDX-License-Identifier: BSD-3-Clause
"""A rename that replaces nothing."""
import contextlib
import ctypes
import errno
import os

HERE = -100  # AT_FDCWD: names are as the process sees them
_NO_REPLACE = 1
_NOT_KNOWN = (errno.ENOSYS, errno.EINVAL, errno.ENOTSUP)  # by the system, or by this file system


def move_new(source, target, source_folder=HERE, target_folder=HERE):
    """Renames a file or folder to a name that nothing has; raises FileExistsError where something has it. The folders are
    descriptors that relative names start from. Where the system cannot rename so, a file has both names for a moment, and of a
    folder it is looked first."""
    call = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if call is not None:
        if call(source_folder, os.fsencode(source), target_folder, os.fsencode(target), _NO_REPLACE) == 0:
            return
        if ctypes.get_errno() not in _NOT_KNOWN:
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), str(target))
    _move_by_link(source, target, *(None if folder == HERE else folder for folder in (source_folder, target_folder)))


def _move_by_link(source, target, source_folder, target_folder):
    try:
        os.link(source, target, src_dir_fd=source_folder, dst_dir_fd=target_folder, follow_symlinks=False)
    except FileExistsError:
        raise
    except OSError:  # of a folder, or where a file has one name alone
        with contextlib.suppress(FileNotFoundError):
            os.stat(target, dir_fd=target_folder, follow_symlinks=False)
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target)) from None
        os.rename(source, target, src_dir_fd=source_folder, dst_dir_fd=target_folder)
        return
    os.unlink(source, dir_fd=source_folder)
