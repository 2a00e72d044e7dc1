# SPDX-License-Identifier: BSD-3-Clause
"""The marks that objects aim at."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkActor, vtkPointGaussianMapper, vtkPolyDataMapper

from waft.render._scenery import lines

_SMALL = 0.006  # radius of a mark's ring, in widths of the volume
_COLORS = np.array([[0.95, 0.15, 0.75], [0.1, 0.95, 0.95], [1.0, 0.95, 0.1], [0.25, 0.95, 0.2], [1.0, 0.2, 0.1]])
_MOST_COLORS = 4096  # of a texture, that a mark's is compared with
# Offsets are in radii. The colour is as it is told, whatever the light.
_RING = """//VTK::Color::Impl
  float away = length(offsetVCVSOutput.xy);
  if (away > 1.0 || away < %g) discard;
  ambientColor = ambientColorUniform;
  diffuseColor = vec3(0.0);
"""


def colors_of(picture):
    """Some colours [color, 3] of what is to be seen of a picture."""
    channels = picture.GetPointData().GetScalars()
    pixels = vtk_to_numpy(channels).reshape(picture.GetNumberOfPoints(), -1)
    pixels = pixels[::len(pixels) // _MOST_COLORS + 1] / float(channels.GetDataTypeMax())
    seen = pixels[pixels[:, -1] >= 0.5] if pixels.shape[1] in (2, 4) else pixels
    return seen[:, :3] if pixels.shape[1] > 2 else seen[:, [0, 0, 0]]


class Marks:
    """Small rings where objects pass, a thin one of the given radius where one is given, a line for a partial trajectory, in a colour
    that is far from `colors` [color, 3]. Marks of objects that come to rest lie below them and are left out."""

    def __init__(self, motion, renderer, size, colors):
        self._color = _apart_from(colors)
        self._actors = []
        places = [point for point, _ in motion.marks.flying]
        self._add_rings(places, [_SMALL * size] * len(places), 0.6)
        wide = [(point, radius) for point, radius in motion.marks.flying if radius > _SMALL * size]
        self._add_rings([point for point, _ in wide], [radius for _, radius in wide], 0.96)
        for points in motion.marks.paths:
            mapper = vtkPolyDataMapper()
            mapper.SetInputData(lines(points, [range(len(points))]))
            look = self._add(mapper).GetProperty()
            look.SetColor(*self._color)
            look.SetOpacity(0.6)
            look.SetLineWidth(2.0)
            look.LightingOff()
        for actor in self._actors:
            renderer.AddActor(actor)

    def show(self, is_shown):
        for actor in self._actors:
            actor.SetVisibility(is_shown)

    def _add(self, mapper):
        actor = vtkActor()
        actor.SetMapper(mapper)
        self._actors.append(actor)
        return actor

    def _add_rings(self, places, radii, hole):
        """hole: the part of a radius that is clear."""
        if not places:
            return
        data = lines(np.array(places), [[place] for place in range(len(places))])
        widths = numpy_to_vtk(np.array(radii, np.float32), deep=True)
        widths.SetName("Radius")
        data.GetPointData().AddArray(widths)
        mapper = vtkPointGaussianMapper()
        mapper.SetInputData(data)
        mapper.SetScaleArray("Radius")
        mapper.SetScaleFactor(1.0)
        mapper.EmissiveOff()
        mapper.SetSplatShaderCode(_RING % hole)
        self._add(mapper).GetProperty().SetColor(*self._color)


def _apart_from(colors):
    """That of the marks' colours which is farthest from all of these, however they are lit."""
    brightest = colors.max(axis=1, keepdims=True)
    hues = colors[brightest[:, 0] > 0.0] / brightest[brightest[:, 0] > 0.0]
    away = np.linalg.norm(_COLORS[:, None] - hues, axis=2)
    return _COLORS[np.argmax(np.percentile(away, 1.0, axis=1))] if len(hues) else _COLORS[0]
