# SPDX-License-Identifier: BSD-3-Clause
"""A flight for other libraries: pandas and PyVista, which are there or not."""
import importlib
import os
from typing import Any, Dict

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import WaftError
from waft.run._bodies import marked, posed

_DEBIAN = {"pandas": "apt-get install python3-pandas", "pyvista": "pip install pyvista"}
_OBSTACLE, _MARK = (0.5, 0.5, 0.52), (0.86, 0.25, 0.16)


def _library(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise WaftError(f"{name} was not found ({error}): {_DEBIAN[name]}") from error


def frame_of(run: Any, poses: Any) -> Any:
    """See Run.to_pandas."""
    pandas = _library("pandas")
    positions, orientations = run.positions, run.orientations
    objects, frames, _ = positions.shape
    order = vtk_to_numpy(poses.GetLines().GetConnectivityArray())
    velocities, turns = (vtk_to_numpy(poses.GetPointData().GetArray(name))[order].astype(float) for name in ("Velocity", "AngularVelocity"))
    columns = {"object": np.repeat(run.object_ids, frames), "frame": np.tile(np.arange(frames), objects),
               "time": np.tile(run.times, objects)}
    for names, values in ((("x", "y", "z"), positions), (("qw", "qx", "qy", "qz"), orientations), (("vx", "vy", "vz"), velocities),
                          (("wx", "wy", "wz"), turns)):
        columns.update(zip(names, values.reshape(objects * frames, -1).T))
    if not run.present.all():
        columns["present"] = run.present.ravel().astype(int)
    return pandas.DataFrame(columns)


def blocks_of(motion: Any, frame: int) -> Any:
    """See Run.to_pyvista."""
    pyvista = _library("pyvista")
    blocks = pyvista.MultiBlock()
    blocks["bodies"] = bodies = pyvista.MultiBlock()
    for number, name in enumerate(_names(motion)):
        surface = posed(motion, frame, number)
        if surface.GetNumberOfPoints():
            bodies[name] = pyvista.wrap(surface)
    blocks["paths"] = pyvista.wrap(motion.poses)
    obstacles = motion.obstacles_at(frame)
    if obstacles is not None and obstacles.GetNumberOfPoints():
        blocks["obstacles"] = pyvista.wrap(obstacles)
    marks = marked(motion)
    if marks.GetNumberOfPoints():
        blocks["marks"] = pyvista.wrap(marks)
    return blocks


def plot(motion: Any, frame: int, options: Dict[str, Any]) -> Any:
    """See Run.plot."""
    pyvista = _library("pyvista")
    blocks = blocks_of(motion, frame)
    plotter = pyvista.Plotter()
    for name, body in zip(_names(motion), motion.bodies):
        if name not in blocks["bodies"].keys():
            continue
        if body.texture and os.path.isfile(body.texture):
            plotter.add_mesh(blocks["bodies"][name], texture=pyvista.read_texture(body.texture), color=body.tint, opacity=body.opacity)
        else:
            plotter.add_mesh(blocks["bodies"][name], color=body.color, opacity=body.opacity)
    plotter.add_mesh(blocks["paths"], color=_OBSTACLE, opacity=0.3)
    if "obstacles" in blocks.keys():
        plotter.add_mesh(blocks["obstacles"], color=_OBSTACLE, opacity=0.5)
    if "marks" in blocks.keys():
        plotter.add_mesh(blocks["marks"], color=_MARK, point_size=8.0, render_points_as_spheres=True)
    return plotter.show(**options)


def _names(motion):
    """Of the shapes, each once."""
    names = [body.name or f"shape {number}" for number, body in enumerate(motion.bodies)]
    return [name if names.count(name) == 1 else f"{name} {number}" for number, name in enumerate(names)]
