# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and movies of a folder that `waft synthesize` wrote, drawn with plain VTK."""

import contextlib
import os
import time
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from vtkmodules.vtkRenderingCore import vtkMapper, vtkRenderer, vtkRenderWindow
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkToneMappingPass

from waft.failures import InputError, WaftError
from waft.render._cameras import Cameras
from waft.render._drawing import MOST_JOBS, pictures, widest_window
from waft.render._exposure import Exposure, Film, seen_through
from waft.render._flyers import Objects, Trails
from waft.render._loop import Loop
from waft.render._marks import Marks
from waft.render._output import AviMovie, Mp4Movie, OggMovie, finished, grab, reduced
from waft.render._scenery import Scenery
from waft.render._sheet import Sheet
from waft.render._styles import STYLES, VIEWS
from waft.results import ResultPlace
from waft.results._folder import load


Path = Union[str, "os.PathLike[str]"]
_SEAL = "pictures.json"
_PUT_EVERY = 2.0  # s of drawing after which pictures get their places
_HIDDEN = 0.1  # share of the motion behind obstacles from which on one sees through them
_GLASS = 0.22  # opacity of such obstacles
_ANY_WINDOW = 4096  # pixels a side that every window can draw
# Pixels that are drawn at once: a texture of them takes 1 GB, where software that draws ends; all of it 4 GB. With an exposure each
# is kept as light, too.
_MOST_DRAWN = 1 << 26


def parse_frames(text: Optional[str], count: int) -> range:
    """Frame numbers of "A:B:S": from A to B (B included), every S; "A" alone is one frame, and what
    is left out is the first frame, the last one, and 1. Raises InputError."""
    if text is None or text == "":
        return range(count)
    parts = str(text).split(":")
    try:
        numbers = [int(part) if part else None for part in parts]
    except ValueError:
        numbers = []
    if not 1 <= len(numbers) <= 3 or (len(numbers) == 1 and numbers[0] is None):
        raise InputError(f"frames '{text}': expected A, A:B or A:B:S with whole numbers")
    first = numbers[0] if numbers[0] is not None else 0
    last = first if len(numbers) == 1 else numbers[1]
    last = count - 1 if last is None else min(last, count - 1)
    step = numbers[2] if len(numbers) == 3 and numbers[2] is not None else 1
    if first < 0 or first >= count or last < first or step < 1:
        raise InputError(
            f"frames '{text}': expected 0 <= A <= B and S >= 1; the animation has frames 0 to {count - 1}"
        )
    return range(first, last + 1, step)


def _check_size(size, samples, exposure):
    """Refuses pictures that no memory holds, or no window draws."""
    each = samples * samples if exposure.is_plain else 2
    if size[0] * size[1] * each > _MOST_DRAWN:
        why = f"with {samples} x {samples} samples each" if exposure.is_plain else "with a shutter or an aperture"
        raise InputError(f"size {size[0]}x{size[1]}: expected pictures of at most {_MOST_DRAWN / each / 1e6:.1f} million pixels {why}, "
                         f"found {size[0] * size[1] / 1e6:.1f} million")
    across = max(size) * (samples if exposure.is_plain else 1)
    most = widest_window() if across > _ANY_WINDOW else across
    if across > most:
        raise InputError(f"size {size[0]}x{size[1]}: expected at most {most // (across // max(size))} pixels a side, found {max(size)}: the "
                         f"window draws {most}, and each pixel takes {across // max(size)} of them")


def _film(exposure):
    """A pass that keeps light above white as what nears it, by the curve of film."""
    made = vtkToneMappingPass()
    made.SetToneMappingType(vtkToneMappingPass.GenericFilmic)
    made.SetGenericFilmicDefaultPresets()
    made.SetUseACES(False)
    made.SetExposure(exposure)
    made.SetDelegatePass(vtkRenderStepsPass())
    return made


class Stage:
    """The drawn scene: `draw(view, frame)` leaves the picture in the window and returns it."""

    def __init__(self, motion: Any, size: Tuple[int, int] = (1280, 720), samples: int = 2, paths: bool = True, targets: Optional[bool] = None,
                 obstacle_opacity: Optional[float] = None, style: str = "day", exposure: Exposure = Exposure()) -> None:
        self._exposure = exposure
        # Pictures that are averaged lie apart by parts of a pixel.
        self._samples = samples = samples if exposure.is_plain else 1
        self._renderer = vtkRenderer()
        look = STYLES[style]
        if look.exposure is not None:
            self._renderer.SetPass(_film(look.exposure))
        self._window = vtkRenderWindow()
        self._window.SetOffScreenRendering(1)
        self._window.SetMultiSamples(0)
        self._window.SetAlphaBitPlanes(not look.backdrop)
        self._is_clear = not look.backdrop
        self._window.SetSize(size[0] * samples, size[1] * samples)
        self._window.AddRenderer(self._renderer)
        self._scenery = Scenery(motion, self._renderer, look, line_width=samples)
        self._cameras = Cameras(motion, size[0] / size[1])
        self._objects = Objects(motion, self._renderer, self._scenery, look)
        self._surroundings: List[Union[Scenery, Trails]] = [self._scenery]
        if paths:
            self._surroundings.append(Trails(motion, self._renderer, look.trail, width=1.2 * samples))
        seen = np.concatenate([self._objects.colors, [look.sky, look.horizon, look.ground]])
        self._marks = Marks(motion, self._renderer, self._scenery.size, seen)
        self._targets = targets
        self._motion = motion
        self._obstacle_opacity = obstacle_opacity
        self._opacities: Dict[str, float] = {}
        self._frame: Optional[int] = None
        self._time: Optional[float] = None

    def draw(self, view: str, frame: int) -> Any:
        opacity = self._opacity(view)  # which moves the obstacles about
        if frame != self._frame:
            for part in self._surroundings:
                part.move_to(frame)
            self._frame, self._time = frame, None
        self._scenery.show_obstacles(opacity)
        self._scenery.show_sky(self._cameras.horizon(view, frame))
        self._marks.show(view != "hero" if self._targets is None else self._targets)
        camera = self._cameras.at(view, frame)
        if self._exposure.is_plain:
            return finished(reduced(self._taken(camera, frame), self._samples))
        film, size = Film(), np.array(self._window.GetSize())
        for away, lens, pixel in self._exposure.moments():
            time = min(max(frame + away, 0.0), self._motion.number_of_frames - 1.0)
            film.add(self._taken(seen_through(camera, lens, pixel, size), time))
        return finished(film.mean())

    def _taken(self, camera, time):
        """Pixels of the window with all bodies as they are at a time in frames."""
        if time != self._time:
            self._objects.move_to(time)
            self._time = time
        # VTK turns the lights into the camera's axes only when the camera is newer than last time.
        camera.Modified()
        self._renderer.SetActiveCamera(camera)
        # A setting of the whole process that ParaView changes: pictures are not to depend on it.
        resolve = vtkMapper.GetResolveCoincidentTopology()
        vtkMapper.SetResolveCoincidentTopology(0)
        self._window.Render()
        vtkMapper.SetResolveCoincidentTopology(resolve)
        return grab(self._window, self._is_clear)

    def _opacity(self, view):
        """Of the obstacles in all frames of a view: the one asked for, or what lets objects be seen."""
        if self._obstacle_opacity is not None:
            return self._obstacle_opacity
        if view not in self._opacities:
            self._opacities[view] = _GLASS if self._hidden(view) > _HIDDEN else 1.0
        return self._opacities[view]

    def _hidden(self, view):
        """Share of the motion that obstacles hide from a view: some objects in some frames."""
        objects = range(0, len(self._motion.positions), max(len(self._motion.positions) // 25, 1))
        frames = range(0, self._motion.number_of_frames, max(self._motion.number_of_frames // 30, 1))
        hidden = 0
        for frame in frames:
            self._scenery.move_to(frame)
            self._frame = None
            camera = self._cameras.at(view, frame)
            eye = np.array(camera.GetPosition())
            along = np.array(camera.GetDirectionOfProjection())
            for place in self._motion.positions[list(objects), frame]:
                if camera.GetParallelProjection():
                    eye = place - ((place - eye) @ along) * along
                hidden += self._scenery.hides(eye, place)
        return hidden / (len(objects) * len(frames))


def render(
    folder: Path,
    frames: Optional[str] = None,
    size: Tuple[int, int] = (1280, 720),
    movie: bool = False,
    views: Sequence[str] = ("hero", "top"),
    paths: bool = True,
    targets: Optional[bool] = None,
    samples: int = 2,
    obstacle_opacity: Optional[float] = None,
    style: str = "day",
    loop: Optional[float] = None,
    shutter: float = 0.0,
    aperture: float = 0.0,
    subframes: int = 16,
    sheet: bool = False,
    jobs: int = 1,
    progress: Optional[Callable[[float, str], Any]] = None,
) -> List[str]:
    """Draws the motion of a folder.

    folder:   what `waft synthesize` wrote
    frames:   "A:B:S", from A to B (B included), every S; all frames if None
    size:     width and height in pixels; refused where they are more than can be drawn at once
    movie:    also FOLDER/<view>.ogv and <view>.avi, and <view>.mp4 where the program ffmpeg is found
    views:    of "hero" (near, goes along), "side" (still, on the whole motion), "top" (straight down, x to the right) and "follow"
    paths:    a faint trail of each object's last second (up to three objects: since the start)
    targets:  small rings where the scene wants objects to pass, in a colour that no body has; None: in all views but "hero"
    samples:  samples x samples pixels are drawn for each one (1: jagged, and the fastest)
    obstacle_opacity: 0 to 1; by itself 1, or where obstacles hide much of the motion from a view,
              little, with their edges drawn
    style:    "day", "studio", "paper", "dark" or "clear" (transparent, not for movies)
    shutter:  fraction of a frame's time in which the shutter is open (0 to 1; 0.5 is that of film): what moves is blurred
    aperture: width of the lens in millimetres (0 to 1000): blurred is what is nearer or farther than where the camera looks
              (not "top", which looks from no place)
    subframes: plain pictures that are averaged for one with a shutter or an aperture (2 to 256), in linear light
    sheet:    also FOLDER/<view>_sheet.png, up to 20 of the pictures with the numbers of their frames
    loop:     also FOLDER/<view>.webp, an animation without an end of at most so many megabytes (10^6 bytes)
    jobs:     processes that draw side by side (1 to 64), each with the memory of one; the pictures are the same
    progress: called with the part done (0..1) and a sentence after each picture

    Writes FOLDER/frames/<view>_0000.png and so on, each whole or not at all, and FOLDER/pictures.json with their
    sizes and digests; returns the list of files written. Raises InputError on a bad folder or argument and where a file
    that no run wrote stands in the way, and WaftError without a display.
    """
    views = (views,) if isinstance(views, str) else tuple(views)
    for view in views:
        if view not in VIEWS:
            raise InputError(f"view '{view}': expected one of {', '.join(VIEWS)}")
    if not views or samples < 1 or len(size) != 2 or min(size) < 16 or max(size) > 16384:
        raise InputError("expected at least one view, samples >= 1 and a size of 16 to 16384 pixels")
    if obstacle_opacity is not None and not 0.0 <= obstacle_opacity <= 1.0:
        raise InputError(f"obstacle opacity {obstacle_opacity}: expected a number from 0 to 1")
    if style not in STYLES:
        raise InputError(f"style '{style}': expected one of {', '.join(STYLES)}")
    if movie and not STYLES[style].backdrop:
        raise InputError(f"style '{style}': a movie has no transparency; expected a loop or pictures alone")
    if not 1 <= jobs <= MOST_JOBS:
        raise InputError(f"jobs {jobs}: expected a whole number from 1 to {MOST_JOBS}")
    exposure = Exposure(shutter, aperture, subframes)
    if loop is not None:
        Loop.require(loop)
    if not os.path.isdir(folder):
        raise InputError(f"{folder}: no such folder; `waft synthesize` makes it")
    with ResultPlace(folder, _SEAL) as place:
        motion = load(folder)
        numbers = parse_frames(frames, motion.number_of_frames)
        if loop is not None:
            Loop.check(len(numbers), size, len(views))
        makers = dict(_MOVIES) if movie else {}
        if loop is not None:
            makers[".webp"] = lambda path, rate: Loop(path, rate, loop, not motion.loops)
        if sheet:
            makers["_sheet.png"] = lambda path, rate: Sheet(path, numbers)
        movies = {view: {f"{view}{ending}": make for ending, make in makers.items()} for view in views}
        names = [_picture(view, frame) for view in views for frame in numbers]
        names += [name for own in movies.values() for name in own]
        place.check(names, replaces_all=False)
        if not os.environ.get("DISPLAY"):
            raise WaftError(
                "rendering needs a display; run it under: xvfb-run -a -s \"-screen 0 1280x1024x24\""
            )
        _check_size(size, samples, exposure)
        drawn = pictures(lambda: Stage(motion, size, samples, paths, targets, obstacle_opacity, style, exposure),
                         [(view, frame, place.path(_picture(view, frame))) for frame in numbers for view in views],
                         jobs, bool(makers))
        with contextlib.closing(drawn):
            written = _put(drawn, place, numbers, movies, motion.frames_per_second / numbers.step, progress)
    return [os.path.join(folder, name) for name in written]


_MOVIES: Dict[str, Callable[..., Any]] = {".ogv": OggMovie, ".avi": AviMovie, **({".mp4": Mp4Movie} if Mp4Movie.available() else {})}


def _picture(view, frame):
    return f"frames/{view}_{frame:04d}.png"


def _put(drawn, place, numbers, movies, rate, progress):
    """Puts pictures in their places soon after they are drawn, and movies ({view: {name: maker}}); returns the names of the files."""
    films = {name: make(place.path(name), rate) for own in movies.values() for name, make in own.items()}
    written, waiting = [], []
    due = time.monotonic() + _PUT_EVERY

    def put():
        written.extend(waiting)
        names, waiting[:] = waiting[:], []
        place.commit({}, names)

    try:
        for done, frame in enumerate(numbers):
            for view, own in movies.items():
                picture = next(drawn)
                waiting.append(_picture(view, frame))
                for film in own:
                    films[film].add(picture)
            if time.monotonic() > due:
                put()
                due = time.monotonic() + _PUT_EVERY
            if progress:
                progress((done + 1) / len(numbers), f"frame {frame} drawn")
        for name in list(films):
            films[name].close()
            del films[name]
            waiting.append(name)
    finally:
        for film in films.values():
            film.discard()
        if waiting:
            put()
    return written
