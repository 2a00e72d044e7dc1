# SPDX-License-Identifier: BSD-3-Clause
"""Room that runs take beside what they are for: listed, and given back."""
import collections
import pathlib

from waft import failures
from waft.results.store import Store
from waft.results.writing import is_beyond_results, result_place
from waft.texts import say

_MEGABYTE = 1e6


def clean(folder=None, only_lists=False):
    """Removes what the store of this user holds or, of a results folder, the files of its manifest that nothing but a look at fields
    needs: series of fields and particles, pictures, kept states. Lists them first; with only_lists that is all. Returns their
    bytes. Raises InputError where the folder holds no results."""
    return _clean_store(only_lists) if folder is None else _clean_folder(folder, only_lists)


def _clean_store(only_lists):
    store = Store()
    entries = store.entries()
    for entry in entries:
        say(f"{store.path / entry.name}: {entry.size / _MEGABYTE:.1f} MB")
        if not only_lists:
            store.remove(entry.name)
    return _report(sum(entry.size for entry in entries), store.path, only_lists)


def _clean_folder(folder, only_lists):
    path = pathlib.Path(folder)
    if not path.is_dir():
        raise failures.InputError(f"{folder}: no such folder; `waft synthesize` makes it")
    sizes = collections.Counter()
    with result_place(path) as place:
        manifest = place.manifest()
        if not manifest:
            raise failures.InputError(f"{folder}: expected a folder of results with its report.json, found none")
        gone = {name: place.folder.about(name) for name in filter(is_beyond_results, manifest)}
        # What somebody changed is his.
        gone = {name: about for name, about in gone.items() if about is not None and manifest[name].fits(place.folder, name)}
        for name, about in gone.items():
            sizes[name.partition("/")[0]] += about.st_size
        for name, size in sizes.items():
            say(f"{path / name}: {size / _MEGABYTE:.1f} MB")
        for name in () if only_lists else gone:
            place.folder.remove(name)
            if "/" in name:
                place.folder.remove_empty(name.rpartition("/")[0])
    return _report(sum(sizes.values()), folder, only_lists)


def _report(size, where, only_lists):
    say(f"{where}: {size / _MEGABYTE:.1f} MB {'to remove' if only_lists else 'removed'}")
    return size
