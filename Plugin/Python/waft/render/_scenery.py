# SPDX-License-Identifier: BSD-3-Clause
"""What does not fly: sky, ground, light and obstacles, and what lies below a point."""

import math

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the rendering back end)
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkImageData,
    vtkPolyData,
    vtkStaticCellLocator,
)
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkTexture

from waft.results._arrays import array_of, points_of
from waft.results._folder import ground_height

_OBSTACLE = (0.67, 0.65, 0.61)
_EDGE = (0.36, 0.36, 0.36)

# Layers that lie on the ground are this much apart, in parts of the volume's width: below what can
# be seen, above what the depth buffer mixes up.
LAYER = 1e-4


def image(pixels):
    """An image of bytes or floats [row from the bottom, column, channel]."""
    rows, columns, channels = pixels.shape
    data = vtkImageData()
    data.SetDimensions(columns, rows, 1)
    scalars = numpy_to_vtk(np.ascontiguousarray(pixels.reshape(-1, channels)), deep=True)
    data.GetPointData().SetScalars(scalars)
    return data


def texture(pixels):
    """Of bytes, or of floats from 0 to 1, which make no steps in what is nearly one colour."""
    made = vtkTexture()
    made.SetInputData(image(pixels))
    if pixels.dtype != np.uint8:
        made.SetColorModeToDirectScalars()
    made.InterpolateOn()
    made.RepeatOff()
    made.EdgeClampOn()
    return made


def lines(points, pieces):
    """Polylines through points; each piece is a list of indices."""
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    ends = np.cumsum([0, *(len(piece) for piece in pieces)])
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(ends, deep=True),
        numpy_to_vtkIdTypeArray(np.concatenate([np.asarray(piece) for piece in pieces]), deep=True),
    )
    data.SetPoints(places)
    data.SetLines(cells)
    return data


def _split_ground(surface, bounds):
    """The obstacles without the ground, and the ground's height (None: no ground)."""
    if not surface.GetPointData().HasArray("ObstacleId") or surface.GetNumberOfPolys() == 0:
        return surface, None
    ids = array_of(surface.GetPointData(), "ObstacleId", "obstacles", kind=int)
    points = points_of(surface, "obstacles")
    for number in np.unique(ids):
        height = ground_height(points[ids == number], bounds)
        if height is not None:
            return _without(surface, ids == number), height
    return surface, None


def _without(surface, left_out):
    """The surface without the polygons of the points that are left out."""
    cells = surface.GetPolys()
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    corners = vtk_to_numpy(cells.GetConnectivityArray())
    kept = vtkCellArray()
    for first, last in zip(offsets[:-1], offsets[1:]):
        if not left_out[corners[first]]:
            kept.InsertNextCell(int(last - first))
            for corner in corners[first:last]:
                kept.InsertCellPoint(int(corner))
    data = vtkPolyData()
    data.SetPoints(surface.GetPoints())
    data.SetPolys(kept)
    return data


def _edges_of(surface):
    """Where faces meet at more than 40 degrees."""
    finder = vtkFeatureEdges()
    finder.SetInputData(surface)
    finder.SetFeatureAngle(40.0)
    finder.ColoringOff()
    finder.NonManifoldEdgesOff()
    finder.Update()
    return finder.GetOutput()


class Scenery:
    """Fills a renderer with ground, obstacles and light, and answers what lies below a point."""

    # The sun: light travels along this direction, steep enough that a shadow stays near its object.
    sun = np.array([0.28, 0.34, -1.0]) / np.linalg.norm([0.28, 0.34, -1.0])

    def __init__(self, motion, renderer, style, line_width=1.0):
        self._motion = motion
        self._style = style
        self._sky, self._horizon, self._ground = (np.array(c) for c in (style.sky, style.horizon, style.ground))
        self._renderer = renderer
        self._line_width = line_width
        self.rays = self._rays(style)
        bounds = motion.bounds
        self.size = max(bounds[1] - bounds[0], bounds[3] - bounds[2])
        self._surface = None
        self._split = None
        self._locator = None
        self._normals = None
        self._skies = {}
        self._obstacle_actor = self._make_obstacles()
        self._edges = self._make_edges()
        self._obstacle_shadow = self._make_obstacle_shadow()
        self._light()
        self.ground = None
        self.move_to(0)
        if self.ground is not None and style.backdrop:
            self._make_ground()

    def _rays(self, style):
        """Directions from places spread evenly over the sun's disk; of one, its middle."""
        turns = np.arange(style.suns) * math.pi * (3.0 - math.sqrt(5.0))
        away = style.sun_radius * np.sqrt(np.arange(style.suns) / style.suns)
        return [self.sun + [x, y, 0.0] for x, y in zip(away * np.cos(turns), away * np.sin(turns))]

    def move_to(self, frame):
        """Shows the obstacles as they are in a frame."""
        surface = self._motion.obstacles_at(frame)
        if surface is None or surface is self._surface:
            return
        self._surface = surface
        self._split, self.ground = _split_ground(surface, self._motion.bounds)
        normals = vtkPolyDataNormals()
        normals.SetInputData(self._split)
        normals.SetFeatureAngle(40.0)
        normals.ComputeCellNormalsOn()
        normals.Update()
        shown = normals.GetOutput()
        self._obstacle_actor.GetMapper().SetInputData(shown)
        self._obstacle_actor.SetVisibility(shown.GetNumberOfPolys() > 0)
        self._edges.GetMapper().SetInputData(_edges_of(self._split))
        self._cast_obstacles(shown)
        self._locator = None
        if shown.GetNumberOfPolys() > 0:
            self._locator = vtkStaticCellLocator()
            self._locator.SetDataSet(shown)
            self._locator.BuildLocator()
            self._normals = vtk_to_numpy(shown.GetCellData().GetNormals())

    def below(self, point):
        """Where the sun's ray through a point meets a surface first: (place of the shadow just
        above what is drawn there, normal, distance, how far a body is to be drawn off the surface
        so that its shadow stays below it), or None."""
        best = None
        layer = LAYER * self.size
        if self.ground is not None and point[2] > self.ground - 0.05 * self.size:
            up = np.array([0.0, 0.0, 1.0])
            distance = max((self.ground - point[2]) / self.sun[2], 0.0)
            best = (point + self.sun * distance - layer * up, up, distance, 0.0)
        if self._locator is not None:
            hit, cell = self._hit(point, point + self.sun * (best[2] if best else 4.0 * self.size))
            if hit is not None:
                normal = np.array(self._normals[cell], float)
                # On a steep wall the flat shadow would mostly hang in the air.
                best = None
                if normal[2] > 0.5:
                    best = (hit + layer * normal, normal, float(np.linalg.norm(hit - point)), 3.0 * layer)
        return best

    def is_level(self, normal, points):
        """Whether the sun's rays through points meet one plane of the obstacles, with that normal."""
        for point in points:
            hit, cell = self._hit(point, point + self.size * self.sun)
            if hit is None or self._normals[cell] @ normal < 0.9999:
                return False
        return True

    def cast(self, points, higher):
        """(places just above the obstacles where the sun's rays through points [n, 3] meet them, how far that is along the rays [n]);
        of points within an obstacle those where their rays go in, when that is at most so much higher; of those that meet none as far as
        of the others together."""
        places, ways = np.empty_like(points), np.full(len(points), np.nan)
        for number, point in enumerate(points):
            hit, cell = self._hit(point, point + self.size * self.sun)
            if hit is not None and self._normals[cell] @ self.sun > 0.0:
                hit, cell = self._hit(point - higher * self.sun, point)
            if hit is not None:
                places[number] = hit + LAYER * self.size * self._normals[cell]
                ways[number] = (hit - point) @ self.sun
        missed = np.isnan(ways)
        ways[missed] = 0.0 if missed.all() else np.nanmean(ways)
        places[missed] = points[missed] + ways[missed, None] * self.sun
        return places, ways

    def _hit(self, start, end):
        """(place, cell) where a line meets an obstacle first, or (None, -1)."""
        along, sub, cell = mutable(0.0), mutable(0), mutable(0)
        hit, local = [0.0] * 3, [0.0] * 3
        is_met = self._locator.IntersectWithLine(list(start), list(end), 1e-9, along, hit, local, sub, cell)
        return (np.array(hit), int(cell)) if is_met else (None, -1)

    def hides(self, eye, point):
        """Whether an obstacle stands between two points."""
        return self._locator is not None and self._hit(eye, point)[0] is not None

    def show_obstacles(self, opacity):
        """Obstacles one sees through have their edges drawn."""
        self._obstacle_actor.GetProperty().SetOpacity(opacity)
        self._edges.SetVisibility(opacity < 1.0 and self._obstacle_actor.GetVisibility())

    def show_sky(self, horizon):
        """A sky whose colour meets the ground's at the horizon (its height in the picture)."""
        if not self._style.backdrop:
            self._renderer.SetBackground(0.0, 0.0, 0.0)
            self._renderer.SetBackgroundAlpha(0.0)
            return
        key = round(horizon, 4)
        if key not in self._skies:
            rows = np.linspace(0.0, 1.0, 256)
            above = np.clip((rows - horizon) / max(1.0 - min(horizon, 0.6), 0.2), 0.0, 1.0)[:, None]
            above = above**1.5
            color = self._horizon * (1.0 - above) + self._sky * above
            if self.ground is None:
                mix = rows[:, None]
                color = self._horizon * (1.0 - mix) + self._sky * mix
            pixels = np.repeat((255.0 * color + 0.5).astype(np.uint8)[:, None, :], 2, axis=1)
            # One sky is kept: a camera that follows has another horizon in each frame.
            self._skies = {key: texture(pixels)}
        self._renderer.SetBackgroundTexture(self._skies[key])
        self._renderer.TexturedBackgroundOn()

    def _make_obstacles(self):
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.VisibilityOff()
        actor.GetMapper().ScalarVisibilityOff()
        look = actor.GetProperty()
        look.SetColor(*_OBSTACLE)
        look.SetAmbient(0.38)
        look.SetDiffuse(0.68)
        self._renderer.AddActor(actor)
        return actor

    def _make_edges(self):
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.GetMapper().ScalarVisibilityOff()
        actor.VisibilityOff()
        look = actor.GetProperty()
        look.SetColor(*_EDGE)
        look.SetOpacity(0.5)
        look.SetLineWidth(self._line_width)
        look.LightingOff()
        self._renderer.AddActor(actor)
        return actor

    def _make_obstacle_shadow(self):
        """The obstacles flattened onto the ground, in the ground's colour, darker; opaque, because
        front and back fall on one another."""
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.GetMapper().ScalarVisibilityOff()
        actor.VisibilityOff()
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetColor(*(0.86 * self._ground))
        actor.SetUserMatrix(vtkMatrix4x4())
        self._renderer.AddActor(actor)
        return actor

    def _cast_obstacles(self, shown):
        actor = self._obstacle_shadow
        actor.SetVisibility(shown.GetNumberOfPolys() > 0 and self.ground is not None and self._style.backdrop)
        if not actor.GetVisibility():
            return
        actor.GetMapper().SetInputData(shown)
        height = self.ground - 2.5 * LAYER * self.size
        entries = np.eye(4)
        entries[:3, 2] = -self.sun / self.sun[2]
        entries[:3, 2] += [0.0, 0.0, 1.0]
        entries[:3, 3] = height * self.sun / self.sun[2]
        actor.GetUserMatrix().DeepCopy(entries.ravel().tolist())

    def _make_ground(self):
        size, bounds = self.size, self._motion.bounds
        middle = np.array([0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3])])
        far = 16.0 * size
        plane = vtkPlaneSource()
        height = self.ground - 3.0 * LAYER * size
        plane.SetOrigin(middle[0] - far, middle[1] - far, height)
        plane.SetPoint1(middle[0] + far, middle[1] - far, height)
        plane.SetPoint2(middle[0] - far, middle[1] + far, height)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(plane.GetOutputPort())
        near, gone = self._style.pool
        # Its colour passes into the horizon's, so that it has no edge.
        axis = np.linspace(-1.0, 1.0, 1024)
        radius = np.hypot(*np.meshgrid(axis, axis)) * far / size
        fade = np.clip((radius - near) / (gone - near), 0.0, 1.0)[..., None]
        fade = fade * fade * (3.0 - 2.0 * fade)
        color = self._ground * (1.0 - fade) + self._horizon * fade
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.SetTexture(texture(color.astype(np.float32)))
        actor.GetProperty().LightingOff()
        self._renderer.AddActor(actor)
        if self._style.grid > 0.0:
            self._renderer.AddActor(self._make_grid())

    def _make_grid(self):
        """A faint grid on the floor of the volume, for scale: eight cells in its width."""
        bounds = self._motion.bounds
        step = self.size / 8.0
        height = self.ground - 2.0 * LAYER * self.size
        points, pieces = [], []
        for axis in (0, 1):
            low, high = bounds[2 * axis], bounds[2 * axis + 1]
            other = bounds[2 * (1 - axis): 2 * (1 - axis) + 2]
            for place in np.arange(low, high + 0.01 * step, step):
                for end in other:
                    point = [0.0, 0.0, height]
                    point[axis], point[1 - axis] = place, end
                    points.append(point)
                pieces.append([len(points) - 2, len(points) - 1])
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(lines(np.array(points), pieces))
        actor = vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*(0.6 * self._ground))
        look.SetOpacity(self._style.grid)
        look.SetLineWidth(self._line_width)
        look.LightingOff()
        return actor

    def _light(self):
        self._renderer.AutomaticLightCreationOff()
        for direction, color, strength in (
            (-self.sun, (1.0, 0.97, 0.92), 1.0),
            (np.array([0.6, -0.8, 0.35]), (0.86, 0.92, 1.0), 0.40),
            # What the ground throws back, so that undersides are not black.
            (np.array([-0.2, -0.3, -1.0]), (1.0, 0.96, 0.90), 0.40),
        ):
            light = vtkLight()
            light.SetLightTypeToSceneLight()
            light.PositionalOff()
            light.SetPosition(*direction)
            light.SetFocalPoint(0.0, 0.0, 0.0)
            light.SetColor(*color)
            light.SetIntensity(strength)
            self._renderer.AddLight(light)
