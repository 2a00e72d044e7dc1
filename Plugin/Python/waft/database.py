# SPDX-License-Identifier: BSD-3-Clause
"""A motion database from simulations of smoke."""
import pathlib

from paraview import simple

from waft import failures
from waft.files import check_folder, replaced, write_xml
from waft.synthesis import set_threads
from waft.watching import Clock, StageWatch


def make_database(path, simulations=8, frames=300, resolution=64, seed=1, threads=None, quiet=True):
    """Simulates, traces, cuts and clusters; writes PATH (.vtm and the folder beside it), whole or not at all.

    The same seed gives the same bytes on any number of threads.
    """
    if not str(path).endswith(".vtm"):
        raise failures.BadInput(f"{path}: expected a file name that ends with .vtm")
    check_folder(pathlib.Path(path).parent)
    set_threads(threads)
    source = simple.MotionDatabaseSource()
    source.NumberOfSimulations = simulations
    source.NumberOfFrames = frames
    source.Resolution = resolution
    source.Seed = seed
    with Clock(quiet=quiet) as clock:
        watch = StageWatch("database", source, clock)
        source.UpdatePipeline()
    if watch.was_aborted:
        raise failures.Interrupted("stopped before the database was whole")
    if watch.errors:
        raise failures.BadInput(watch.errors[0])
    with replaced(path) as staging:
        write_xml(source.GetClientSideObject().GetOutputDataObject(0), staging)
    return source
