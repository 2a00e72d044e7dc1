# SPDX-License-Identifier: BSD-3-Clause
"""Drifters: bodies that sink through free air of the database's kind, the measure of style (Documentation/Measure.md)."""
import io
import os
import zipfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import InputError
from waft.files import number, whole_file, write_bytes
from waft.loading import data_file
from waft.marks import is_marked_zip, marked_zip
from waft.measuring._airfield import AirField, shells
from waft.measuring._flights import END, NEAR_GROUND, START, Flights
from waft.reading import read_bytes

QUANTUM = 2e-6  # places are whole numbers of this [m]
SHORTEST = 2.0  # flights that are kept [s]
JOIN = 3  # frames about the end of a glide that another follows
_ARRAYS = ("Bounds", "FramesPerSecond", "NumberOfFrames", "Seeds", "SettlingSpeeds")
_MOST_BYTES, _MOST_PLACES = 1 << 30, 20000000  # of a file, and of an air
RESOLUTION = 64  # voxels along the longest side
WARM_UP = 15.0  # from rest to air that goes on as it is, of a volume of 4 m: some three to four turnovers [s]
SHELL_FRAMES = 15  # between two whose energy by shell is taken


class Drifters:
    """A set of drifters: for each of some settling speeds the paths of bodies in several airs."""

    def __init__(self, path=None):
        self.path = path or data_file("Drifters/drifters.npz")
        if not os.path.isfile(self.path):
            raise InputError(f"{self.path}: no such file of drifters")
        content = read_bytes(self.path, what="a file of drifters")
        try:
            with zipfile.ZipFile(io.BytesIO(content)) as archive:
                if sum(member.file_size for member in archive.infolist()) > _MOST_BYTES:
                    raise ValueError(f"expected arrays of at most {_MOST_BYTES} bytes")
            with np.load(io.BytesIO(content)) as data:
                self._data = {name: data[name] for name in data.files}
            self.bounds, self.rate, self.frames, self.seeds, self.speeds = (self._data[name] for name in _ARRAYS)
            self.rate, self.frames = float(self.rate), int(self.frames)
            self.lattice = tuple(int(n) for n in self._data.get("Lattice", ()))
            self.shells = self._data.get("Shells")
            self._paths = [[_decoded(self._data, s, a) for a in range(len(self.seeds))] for s in range(len(self.speeds))]
            self._check()
        except Exception as error:  # archives and arrays that are none raise errors of many kinds
            raise InputError(f"{self.path}: not a file of drifters that Waft made: {error}") from error

    def _check(self):
        """Raises ValueError with what is wrong with the values."""
        for array, what, low, high, size in ((self.bounds, "Bounds", -1e9, 1e9, 6), (self.speeds, "SettlingSpeeds", 0.0, 1e9, None),
                                             (np.array([self.rate]), "FramesPerSecond", 1.0, 1000.0, 1)):
            is_right = array.ndim == 1 and len(array) == (size or max(len(array), 1)) and array.dtype.kind in "if"
            if not is_right or not (np.isfinite(array) & (array >= low) & (array <= high)).all():
                raise ValueError(f"{what}: expected {size or 'some'} numbers from {low:g} to {high:g}")
        if self.shells is not None and not (len(self.lattice) == 3 and self.shells.ndim == 1 and self.shells.dtype.kind == "f"
                                            and np.isfinite(self.shells).all() and (self.shells >= 0.0).all()):
            raise ValueError("Shells: expected numbers of at least 0 and a Lattice of three")
        if np.any(self.bounds[::2] >= self.bounds[1::2]):
            raise ValueError("Bounds: expected the least and the most of x, y and z in turn")
        counts = [len(paths) for airs in self._paths for paths in airs]
        if min(counts, default=0) < 1 or max(counts) * self.frames > _MOST_PLACES:
            raise ValueError(f"expected paths in each air, of at most {_MOST_PLACES} places")
        if any(not 3 <= len(path) <= self.frames for airs in self._paths for paths in airs for path in paths):
            raise ValueError(f"expected paths of 3 to {self.frames} frames")

    def airs(self, slips):
        """One Flights for each air, of bodies with the settling speeds nearest to these, in their shares."""
        slips = np.sort(np.asarray(slips, float))
        made = []
        for air in range(len(self.seeds)):
            paths = []
            most = min(len(each[air]) for each in self._paths)
            for body in range(most):
                wanted = slips[(2 * body + 1) * len(slips) // (2 * most)]
                kind = int(np.argmin(np.abs(self.speeds - wanted)))
                paths.append((self._paths[kind][air][body], self.speeds[kind]))
            made.append(self._flights(paths))
        return made

    def _flights(self, paths):
        positions = np.full((len(paths), self.frames, 3), np.nan)
        free = np.zeros(positions.shape[:2], bool)
        for body, (path, _) in enumerate(paths):
            positions[body, :len(path)] = path
            landed = path[-1, 2] - self.bounds[4] < NEAR_GROUND
            end = len(path) - (int(np.ceil(END * self.rate)) if landed else 0)
            free[body, int(np.ceil(START * self.rate)):max(end, 0)] = True
        return Flights(positions, self.rate, np.isfinite(positions[..., 0]), free, np.array([slip for _, slip in paths]))

    @staticmethod
    def fitting(slips, bounds, rate):
        """Of the sets that come with Waft one that was made for such bodies, else the one of the default volume."""
        default = Drifters()
        if not default.lacks(slips, bounds, rate):
            return default
        folder = os.path.dirname(default.path)
        others = (Drifters(os.path.join(folder, name)) for name in sorted(os.listdir(folder)) if name.endswith(".npz"))
        return next((made for made in others if not made.lacks(slips, bounds, rate)), default)

    def lacks(self, slips, bounds, rate):
        """Sentences on what the set was not made for."""
        words = []
        worst = max(np.min(np.abs(self.speeds - slip)) / max(slip, 0.1) for slip in slips)
        if worst > 0.15:
            words.append("other settling speeds than " + ", ".join(f"{speed:g}" for speed in self.speeds) + " m/s")
        if np.max(np.abs(np.asarray(bounds) - self.bounds)) > 1e-6:
            words.append("another volume")
        if abs(rate - self.rate) > 1e-6:
            words.append(f"another frame rate than {self.rate:g}")
        return [f"drifters: the scene has {' and '.join(words)}; `waft measure DIR --make-drifters FILE` makes a set for it, "
                "--drifters FILE takes it"] if words else []


def gliding(drifters, airs):
    """The drifters turned as the bodies of these airs are: each goes the way besides that a body of nearly its settling speed glides,
    frame by frame. The same where nothing glides."""
    bodies = [(flights, body) for flights in airs if flights.glide is not None for body in range(len(flights))
              if flights.flying[body].any()]
    if not bodies:
        return drifters
    speeds = np.array([flights.slip[body] for flights, body in bodies])
    return [_glided(each, bodies, speeds, np.random.RandomState(number)) for number, each in enumerate(drifters)]


def _flown(flights, body):
    """Its first frames of flight, after a release."""
    flying = flights.flying[body]
    begin = int(np.argmax(flying))
    after = flying[begin:]
    return slice(begin, begin + (len(after) if after.all() else int(np.argmin(after))))


def _glided(drifters, bodies, speeds, random):
    positions, free = drifters.positions.copy(), drifters.free.copy()
    frames = positions.shape[1]
    for drifter, speed in enumerate(drifters.slip):
        near = np.flatnonzero(np.abs(speeds - speed) <= np.abs(speeds - speed).min() + 1e-9)
        velocity = np.zeros((0, 3))
        joins = []
        while len(velocity) < frames:
            flights, body = bodies[near[random.randint(len(near))]]
            own = flights.glide[body, _flown(flights, body)] + [0.0, 0.0, flights.slip[body]]
            joins.append(len(velocity))
            velocity = np.concatenate([velocity, own])
        between = 0.5 * (velocity[1:frames] + velocity[:frames - 1]) / drifters.rate
        positions[drifter, 1:] += np.cumsum(between, axis=0)
        for join in joins[1:]:  # no way of flight
            free[drifter, max(join - JOIN, 0):join + JOIN] = False
    return Flights(positions, drifters.rate, drifters.flying, free, drifters.slip)


def make_drifters(path, speeds, bounds=(-2.0, 2.0, -2.0, 2.0, 0.0, 4.0), rate=30.0, frames=300, airs=6, seed=20001, bodies=150,
                  progress=None, scene=None, lattice=None):
    """Simulates airs of the database's kind, traces bodies that sink at these speeds [m/s] and writes PATH. scene: a file whose
    obstacles, winds and vortices act on air and bodies; none without. lattice: points (i, j, k) on which the air's energy by shell of
    wave number is kept besides. With a scene the air has warmed up to where it goes on as it is, like that of flights."""
    from vtkmodules.vtkFiltersGeneral import vtkPassArrays
    from vtkmodules.vtkFiltersHybrid import vtkTemporalDataSetCache
    from waft import vtkWaftFilters, vtkWaftSources

    content = dict(zip(_ARRAYS, (np.array(bounds, float), np.float64(rate), np.int64(frames), seed + np.arange(airs),
                                 np.array(speeds, float))))
    sides = np.array(bounds, float)[1::2] - np.array(bounds, float)[::2]
    spectra = []
    for air in range(airs):
        smoke = vtkWaftSources.vtkGridSmokeSource()
        smoke.SetBounds(list(bounds))
        smoke.SetResolution([max(int(round(side / sides.max() * RESOLUTION)), 4) for side in sides])
        smoke.SetFramesPerSecond(rate)
        smoke.SetNumberOfFrames(frames)
        smoke.SetNumberOfObstacles(0)
        smoke.SetNumberOfEmitters(0)
        smoke.SetSeed(seed + air)
        smoke.SetCacheLimit(64)
        if scene is not None:
            _warm_up(smoke, sides[:2].max())
            reader = vtkWaftSources.vtkMotionSceneReader()
            reader.SetFileName(os.fspath(scene))
            for port, given in enumerate((2, 5, 4), 1):  # obstacles, wind, vortices
                smoke.SetInputConnection(port, reader.GetOutputPort(given))
            reader.Update()
            breeze = reader.GetOutputDataObject(0).GetFieldData().GetArray("Breeze")
            if breeze is not None:
                smoke.SetBreeze(*(breeze.GetValue(axis) for axis in range(3)))
        velocity = vtkPassArrays()
        velocity.SetInputConnection(smoke.GetOutputPort())
        velocity.AddPointDataArray("Velocity")
        kept = vtkTemporalDataSetCache()  # each speed passes over all frames
        kept.SetInputConnection(velocity.GetOutputPort())
        kept.SetCacheSize(frames)
        if lattice is not None:
            spectra.append(_shells_of(kept, bounds, lattice, np.arange(0, frames, SHELL_FRAMES) / rate))
        for index, speed in enumerate(speeds):
            trace = vtkWaftFilters.vtkTrajectoryTraceFilter()
            trace.SetInputConnection(kept.GetOutputPort())
            if scene is not None:
                trace.SetInputConnection(2, smoke.GetOutputPort(2))
            trace.SetSettlingSpeed(speed)
            trace.Update()
            paths = _paths(trace.GetOutput(), int(np.ceil(SHORTEST * rate)))
            chosen = np.unique(np.linspace(0, len(paths) - 1, min(bodies, len(paths))).round().astype(int))
            if not len(chosen):
                raise InputError(f"settling speed {number(speed)}: no body flies for {SHORTEST:g} s in this volume")
            content.update(_encoded([paths[i] for i in chosen], index, air))
        if progress:
            progress((air + 1) / airs, f"air {air + 1} of {airs} simulated")
    if spectra:
        content.update(Lattice=np.array(lattice, np.int64), Shells=np.mean(spectra, axis=0))
    made = io.BytesIO()
    np.savez_compressed(made, **content)
    with whole_file(path, is_marked_zip) as part:
        write_bytes(part, marked_zip(made.getvalue()))


def _warm_up(smoke, width):
    """Has the air of a vtkGridSmokeSource come to rest no more, by its random forces at the rate at which they are."""
    felt = smoke.GetNumberOfFrames() / smoke.GetFramesPerSecond()
    longer = WARM_UP * np.sqrt(width / 4.0)
    rate = (longer + felt) / (smoke.GetWarmUpSeconds() + felt)
    smoke.SetNumberOfVortices(int(round(smoke.GetNumberOfVortices() * rate)))
    smoke.SetNumberOfWinds(int(round(smoke.GetNumberOfWinds() * rate)))
    smoke.SetWarmUpSeconds(longer)


def _shells_of(smoke, bounds, lattice, times):
    """Energy by shell of the velocity of a source of images, at points of a lattice over the volume."""
    low, high = np.array(bounds, float)[::2], np.array(bounds, float)[1::2]
    spacing = (high - low) / (np.array(lattice) - 1)
    axes = [low[axis] + spacing[axis] * np.arange(lattice[axis]) for axis in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).transpose(2, 1, 0, 3)
    fields = []
    for time in times:
        smoke.UpdateTimeStep(time)
        image = smoke.GetOutputDataObject(0)
        velocity = vtk_to_numpy(image.GetPointData().GetArray("Velocity")).reshape(*image.GetDimensions()[::-1], 3)
        field = AirField([time], [velocity], {}, image.GetOrigin(), image.GetSpacing())
        fields.append(field.within(velocity, points.reshape(-1, 3)).reshape(points.shape))
    return shells(fields, spacing)


def _paths(tracks, shortest):
    if tracks.GetNumberOfLines() == 0:
        return []
    points = vtk_to_numpy(tracks.GetPoints().GetData())
    order = vtk_to_numpy(tracks.GetLines().GetConnectivityArray())
    ends = vtk_to_numpy(tracks.GetLines().GetOffsetsArray())
    return [points[order[a:b]] for a, b in zip(ends, ends[1:]) if b - a >= shortest]


def _encoded(paths, speed, air):
    """Second differences, which are small."""
    whole = [np.rint(path / QUANTUM).astype(np.int64) for path in paths]
    bends = np.concatenate([np.diff(path, 2, axis=0) for path in whole])
    if np.abs(bends).max() > 32767:
        raise InputError("drifters: an acceleration beyond what the file holds")
    return {f"Lengths{speed}_{air}": np.array([len(path) for path in whole], np.int32),
            f"Starts{speed}_{air}": np.array([path[:2] for path in whole], np.int32),
            f"Bends{speed}_{air}": bends.astype(np.int16)}


def _decoded(data, speed, air):
    lengths, starts, bends = (data[f"{name}{speed}_{air}"] for name in ("Lengths", "Starts", "Bends"))
    paths, begin = [], 0
    for length, (first, second) in zip(lengths.tolist(), starts.astype(np.int64)):
        own = bends[begin:begin + length - 2].astype(np.int64)
        begin += length - 2
        steps = np.cumsum(np.concatenate([(second - first)[None], own]), axis=0)
        paths.append(QUANTUM * np.concatenate([first[None], first + np.cumsum(steps, axis=0)]))
    return paths
