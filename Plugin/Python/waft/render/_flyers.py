# SPDX-License-Identifier: BSD-3-Clause
"""What flies: the objects, their shadows and the trails behind them."""

import math
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkTexture

from waft.failures import InputError
from waft.reading import read_picture
from waft.render._marks import colors_of
from waft.render._scenery import lines, texture
from waft.results._arrays import points_of, triangles_of
from waft.texts import warn

_MOST_TEXELS = 4096  # along a side
_STRETCH = 2.0  # over a triangle's longest side, by which its points' ways to a surface may differ
_NEAR = 5.0  # extents of a body, of height, in which its shadow's outline pales
_CUT_OUT = "//VTK::TCoord::Impl\n  if (gl_FragData[0].a < 0.5) discard;\n"
# VTK turns a normal towards the eye; what the first light, the sun, throws on the other side comes through.
_SHINE_THROUGH = (
    "//VTK::Light::Impl\n  fragOutput0.rgb += %.3f * diffuseColor * lightColor0"
    " * max(0.0, dot(normalVCVSOutput, lightDirectionVC0));\n"
)


def rotation(quaternion):
    """3 x 3 matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _set(matrix, linear, offset):
    rows = (*linear[0], offset[0], *linear[1], offset[1], *linear[2], offset[2])
    matrix.DeepCopy((*rows, 0.0, 0.0, 0.0, 1.0))


def _at_most(picture, side):
    """The picture, averaged over blocks where a side of it is longer: drawing takes
    many bytes for each pixel."""
    block = -(-max(picture.GetDimensions()) // side)
    if block <= 1:
        return picture
    shrink = vtkImageShrink3D()
    shrink.SetInputData(picture)
    shrink.SetShrinkFactors(block, block, 1)
    shrink.Update()
    return shrink.GetOutput()


def _load_texture(path):
    if not os.path.isfile(path):
        warn(f"{path}: texture missing, plain colour instead")
        return None
    try:
        picture = read_picture(path)
    except InputError as error:
        warn(f"{error}; plain colour instead")
        return None
    made = vtkTexture()
    made.SetInputData(_at_most(picture, _MOST_TEXELS))
    made.InterpolateOn()
    made.MipmapOn()
    return made


def _rim(points):
    """Of a body's points the farthest to eight sides in its plane, and half of the way there."""
    angles = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
    rim = points[np.unique((points[:, :2] @ np.array([np.cos(angles), np.sin(angles)])).argmax(axis=0))]
    return np.concatenate([rim, 0.5 * (rim + rim.mean(axis=0))])


class _Look:
    """Mapper, texture and surface properties that all objects of one shape share."""

    def __init__(self, body, style):
        normals = vtkPolyDataNormals()
        normals.SetInputData(body.surface)
        normals.SplittingOff()
        # The whole outline of an open sheet is kept as it is: consistency only.
        normals.ConsistencyOn()
        normals.Update()
        self.mapper = vtkPolyDataMapper()
        self.mapper.SetInputConnection(normals.GetOutputPort())
        self.mapper.ScalarVisibilityOff()
        self.extent = body.extent
        self._surface = normals.GetOutput()
        self.points = points_of(self._surface, body.name)
        self._triangles = triangles_of(self._surface, body.name)
        sides = self.points[self._triangles] - self.points[np.roll(self._triangles, 1, axis=1)]
        self._sides = np.linalg.norm(sides, axis=2).max(axis=1)
        self.rim = _rim(self.points)
        has_coordinates = body.surface.GetPointData().GetTCoords() is not None
        self.texture = _load_texture(body.texture) if body.texture and has_coordinates else None
        # VTK multiplies a texture by the surface's colour.
        self.color = body.tint if self.texture else body.color
        self.colors = np.array(self.color) * (colors_of(self.texture.GetInput()) if self.texture else np.ones((1, 3)))
        self.opacity = body.opacity
        self.ambient = style.ambient
        self.translucency = style.translucency if self.opacity == 1.0 else 0.0

    def object_actor(self):
        actor = self._actor()
        look = actor.GetProperty()
        film = self.opacity < 1.0
        look.SetColor(*self.color)
        look.SetAmbient(self.ambient)
        look.SetDiffuse(0.72)
        look.SetSpecular(0.9 if film else 0.12)
        look.SetSpecularPower(60.0 if film else 12.0)
        if film:
            look.SetOpacity(self.opacity)
        else:
            # Cut out by alpha rather than blended: right from every side without sorting.
            actor.ForceOpaqueOn()
            if self.texture:
                actor.GetShaderProperty().AddFragmentShaderReplacement(
                    "//VTK::TCoord::Impl", True, _CUT_OUT, False
                )
            if self.translucency > 0.0:
                actor.GetShaderProperty().AddFragmentShaderReplacement(
                    "//VTK::Light::Impl", True, _SHINE_THROUGH % self.translucency, False
                )
        return actor

    def shadow_actor(self):
        actor = self._actor()
        actor.GetProperty().SetColor(0.0, 0.0, 0.0)
        actor.GetProperty().LightingOff()
        actor.ForceTranslucentOn()
        return actor

    def laid(self, ways):
        """The body's surface for points that go so far along the sun's rays: without what would hang between a surface and one far
        behind it."""
        far = np.ptp(ways[self._triangles], axis=1) > _STRETCH * self._sides
        kept = self._triangles[~far]
        cells = vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(kept) + 1, 3), deep=True), numpy_to_vtkIdTypeArray(kept.ravel(), deep=True))
        surface = vtkPolyData()
        surface.ShallowCopy(self._surface)
        surface.SetPolys(cells)
        return surface

    @staticmethod
    def lay(actor, surface, points):
        """Gives a shadow's actor a surface with its points elsewhere."""
        laid = vtkPolyData()
        laid.ShallowCopy(surface)
        laid.SetPoints(vtkPoints())
        laid.GetPoints().SetData(numpy_to_vtk(points, deep=True))
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(laid)
        mapper.ScalarVisibilityOff()
        actor.SetMapper(mapper)

    def _actor(self):
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        if self.texture:
            actor.SetTexture(self.texture)
        return actor


class Objects:
    """One actor per object and more for its shadow: its outline cast along each of the sun's rays, which
    pales with height, and a soft spot that takes over. On what is not level the outline lies as that does."""

    def __init__(self, motion, renderer, scenery, style):
        self._motion = motion
        self._scenery = scenery
        self._shadow = style.shadow
        looks = [_Look(body, style) for body in motion.bodies]
        spot = self._spot()
        self._planes = {}
        self._items = []
        for index, shape in enumerate(motion.shapes):
            look = looks[shape]
            actors = [look.object_actor(), *(look.shadow_actor() for _ in scenery.rays), spot()]
            matrices = [vtkMatrix4x4() for _ in actors]
            for actor, matrix in zip(actors, matrices):
                actor.SetUserMatrix(matrix)
                renderer.AddActor(actor)
            self._items.append((index, look, actors, matrices))
        self.colors = np.concatenate([look.colors for look in looks])

    def move_to(self, time):
        """Shows all as they are at a time in frames."""
        for index, look, actors, matrices in self._items:
            is_present = self._motion.is_present(index, time)
            actors[0].SetVisibility(is_present)
            if not is_present:
                for actor in actors[1:]:
                    actor.VisibilityOff()
                continue
            place, quaternion = self._motion.pose(index, time)
            turn = rotation(quaternion)
            lifted = place + self._cast(place, turn, look, actors[1:], matrices[1:])
            _set(matrices[0], turn.tolist(), lifted.tolist())

    def _cast(self, place, turn, look, actors, matrices):
        """Casts a body's shadow; returns what the body is to be drawn off by, lest its shadow shows through it."""
        # From a little above, so that an object that lies on a surface finds it.
        lift = 0.02 * look.extent
        met = self._scenery.below(place - lift * self._scenery.sun)
        for actor in actors:
            actor.SetVisibility(met is not None)
        if met is None:
            return 0.0
        spot, normal, distance, off = met
        drawn_off = max(1.0 - distance / look.extent, 0.0) * off * normal
        nearness = distance / (_NEAR * look.extent)
        sharp = self._shadow * math.exp(-nearness)
        soft = 0.52 * self._shadow * (1.0 - math.exp(-nearness)) / (1.0 + (nearness / 2.5) ** 1.5)
        basis, flattened = self._plane(normal)
        # Where all rays' outlines lie on one another they are as dark as one alone.
        share = 1.0 - (1.0 - sharp) ** (1.0 / len(flattened))
        for actor in actors[:-1]:
            actor.GetProperty().SetOpacity(share)
            actor.SetVisibility(bool(sharp > 0.01))
        above = -lift * self._scenery.sun + place
        if off > 0.0 and sharp > 0.01 and not self._scenery.is_level(normal, above + look.rim @ turn.T):
            places, ways = self._scenery.cast(above + look.points @ turn.T, 0.5 * look.extent)
            surface = look.laid(ways)
            for actor, matrix, ray in zip(actors, matrices, self._scenery.rays):
                look.lay(actor, surface, places + np.maximum(ways - lift, 0.0)[:, None] * (ray - self._scenery.sun))
                _set(matrix, np.eye(3).tolist(), [0.0, 0.0, 0.0])
            actors[-1].VisibilityOff()
            return drawn_off
        for actor, matrix, ray, flatten in zip(actors, matrices, self._scenery.rays, flattened):
            actor.SetMapper(look.mapper)
            shift = ray * (normal @ spot) / (normal @ ray)
            _set(matrix, (flatten @ turn).tolist(), (flatten @ place + shift).tolist())
        actors[-1].GetProperty().SetOpacity(soft)
        actors[-1].SetVisibility(bool(soft > 0.01))
        width = look.extent * (1.0 + 0.35 * nearness)
        _set(matrices[-1], (width * basis).tolist(), spot.tolist())
        return drawn_off

    def _plane(self, normal):
        """Of a plane with that normal: axes whose third is the normal, and what casts onto it along each of the sun's rays s,
        x -> x - s (n . x) / (n . s). Few normals come, and often."""
        key = normal.tobytes()
        if key not in self._planes:
            side = np.cross(normal, [0.0, 1.0, 0.0] if abs(normal[1]) < 0.9 else [1.0, 0.0, 0.0])
            side /= np.linalg.norm(side)
            if len(self._planes) > 4096:
                self._planes.clear()
            self._planes[key] = (
                np.stack([side, np.cross(normal, side), normal], axis=1),
                [np.eye(3) - np.outer(ray, normal) / (normal @ ray) for ray in self._scenery.rays],
            )
        return self._planes[key]

    @staticmethod
    def _spot():
        """A maker of soft round spots of width 1 in the plane z = 0."""
        axis = np.linspace(-1.0, 1.0, 64)
        radius = np.hypot(*np.meshgrid(axis, axis))
        fall = np.where(radius < 1.0, np.exp(-4.0 * radius**2) * (1.0 - radius**2), 0.0)
        pixels = np.zeros((64, 64, 4), np.uint8)
        pixels[..., 3] = (255.0 * np.clip(fall, 0.0, 1.0) + 0.5).astype(np.uint8)
        shade = texture(pixels)
        plane = vtkPlaneSource()
        plane.SetOrigin(-1.0, -1.0, 0.0)
        plane.SetPoint1(1.0, -1.0, 0.0)
        plane.SetPoint2(-1.0, 1.0, 0.0)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(plane.GetOutputPort())

        def make():
            actor = vtkActor()
            actor.SetMapper(mapper)
            actor.SetTexture(shade)
            actor.GetProperty().SetColor(0.0, 0.0, 0.0)
            actor.GetProperty().LightingOff()
            actor.ForceTranslucentOn()
            return actor

        return make


def _ends(motion, frames):
    """Places of the last frames [object, frame, 3] of who goes on as each object; of nobody where it begins."""
    ends = np.repeat(motion.positions[:, :1], frames, axis=1)
    for before, goes_on in enumerate(motion.goes_on):
        if goes_on >= 0 and frames > 0:
            places = motion.positions[before, -frames:]
            ends[goes_on, frames - len(places):] = places
    return ends


class Trails:
    """Where each object was in the last second, fading; with at most three objects the whole way
    since the start, fainter; with more than a hundred shorter and fainter, lest they hide what flies.
    In a scene that loops the last second begins before the first frame, with those that go on."""

    def __init__(self, motion, renderer, color, width=1.5):
        self._motion = motion
        self._color = color
        objects = len(motion.positions)
        crowd = min(1.0, math.sqrt(100.0 / objects))
        self._length = max(int(round(crowd * motion.frames_per_second)), 1)
        self._strength = 90.0 * crowd
        self._whole = objects <= 3 and not motion.loops
        self._before = self._length if motion.loops else 0  # frames that places begin before the first one
        self._places = np.concatenate([_ends(motion, self._before), motion.positions], axis=1)
        self._actor = vtkActor()
        self._actor.SetMapper(vtkPolyDataMapper())
        self._actor.GetProperty().LightingOff()
        self._actor.GetProperty().SetLineWidth(width)
        self._actor.ForceTranslucentOn()
        renderer.AddActor(self._actor)

    def move_to(self, frame):
        first = 0 if self._whole else max(frame - self._length, -self._before)
        count = frame - first + 1
        self._actor.SetVisibility(count > 1)
        if count < 2:
            return
        points = self._places[:, self._before + first:self._before + frame + 1, :].reshape(-1, 3)
        objects = len(self._places)
        order = np.arange(objects * count).reshape(objects, count)
        data = lines(points, order)
        age = np.minimum((frame - np.arange(first, frame + 1)) / self._length, 1.0)
        shade = np.empty((objects, count, 4), np.uint8)
        shade[..., :3] = (255.0 * np.array(self._color)).astype(np.uint8)
        floor = 95.0 if self._whole else 0.0
        shade[..., 3] = (floor + (self._strength - floor) * (1.0 - age) ** 1.5).astype(np.uint8)
        data.GetPointData().SetScalars(numpy_to_vtk(shade.reshape(-1, 4), deep=True))
        self._actor.GetMapper().SetInputData(data)
