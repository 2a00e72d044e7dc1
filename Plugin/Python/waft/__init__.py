# SPDX-License-Identifier: BSD-3-Clause
"""Waft: motion of light things in air that hits the artist's marks, for pvpython.

Importing the package loads the ParaView plugin. Then

    import waft
    run = waft.synthesize("scene.waft.json", output="out")
    run.planner.Seed = 7        # change one property ...
    run.rotation.UpdatePipeline()   # ... and update: only what depends on it is computed again

The VTK classes themselves are in waft.vtkWaftSources and waft.vtkWaftFilters.
"""
from waft.loading import data_file, load_plugin, version

load_plugin()

# Before the first object of a class is seen from Python: what has no class then keeps that of its nearest base.
from waft import vtkWaftFilters, vtkWaftSources  # noqa: E402, F401
from waft.failures import BadInput, WaftError  # noqa: E402
from waft.measuring import measure  # noqa: E402
from waft.synthesis import synthesize  # noqa: E402

__version__ = version()
__all__ = ["BadInput", "WaftError", "data_file", "load_plugin", "measure", "synthesize", "version"]
