# SPDX-License-Identifier: BSD-3-Clause
"""The air of a result folder (air.pvd): its velocity anywhere, and bodies that drift in it."""

import numpy as np

from waft.beneath import Folder
from waft.failures import InputError
from waft.measuring._flights import END, NEAR_GROUND, START, Flights, rms
from waft.reading import read_image
from waft.results._arrays import array_of, check_steps

WITNESSES = 200
AWAY = 0.3  # from every object, where a witness is let go [m]


class AirField:
    """Velocity [m/s] [step, k, j, i, 3] on a lattice; linear between its points and steps, that of the outermost point outside. wind:
    {step: the wind correction's force [m/s^2] there}, of some steps."""

    def __init__(self, times, velocity, wind, origin, spacing):
        self.times, self.velocity, self.wind = np.asarray(times, float), velocity, wind
        self.origin, self.spacing = np.asarray(origin, float), np.asarray(spacing, float)

    def at(self, places, time):
        """Velocity at places [n, 3] at one time [s]."""
        return self.over(self.within, places, time)

    def over(self, of, places, time):
        """What a function gives of the fields before and after a time [s] and of places, between them."""
        step = float(np.clip(np.interp(time, self.times, np.arange(len(self.times))), 0, len(self.times) - 1))
        before = min(int(step), max(len(self.times) - 2, 0))
        after = min(before + 1, len(self.times) - 1)
        share = step - before
        return (1.0 - share) * of(self.velocity[before], places) + share * of(self.velocity[after], places)

    def within(self, field, places):
        """A field [k, j, i, 3] of the lattice at places [n, 3]."""
        last = np.array(field.shape[2::-1]) - 1
        where = np.clip((places - self.origin) / self.spacing, 0.0, last)
        low = np.minimum(np.nan_to_num(where).astype(int), np.maximum(last - 1, 0))  # of no place the velocity is none
        part = where - low
        high = np.minimum(low + 1, last)
        total = 0.0
        for corner in range(8):
            bits = [(corner >> axis) & 1 for axis in range(3)]
            i, j, k = (high[:, axis] if bit else low[:, axis] for axis, bit in enumerate(bits))
            weight = np.prod([part[:, axis] if bit else 1.0 - part[:, axis] for axis, bit in enumerate(bits)], axis=0)
            total = total + weight[:, None] * field[k, j, i]
        return total

    def drift(self, places, own, first, frames, rate):
        """Places [body, frame, 3] of bodies that are let go at the frame first and go by their own velocity [body, frame, 3] relative
        to the air, frames from there on, by Runge-Kutta steps of fourth order."""
        path = np.empty((len(places), frames, 3))
        path[:, 0] = places
        dt = 1.0 / rate
        for frame in range(frames - 1):
            x, t = path[:, frame], (first + frame) * dt
            before, after = own[:, frame], own[:, frame + 1]
            between = 0.5 * (before + after)
            k1 = self.at(x, t) + before
            k2 = self.at(x + 0.5 * dt * k1, t + 0.5 * dt) + between
            k3 = self.at(x + 0.5 * dt * k2, t + 0.5 * dt) + between
            k4 = self.at(x + dt * k3, t + dt) + after
            path[:, frame + 1] = x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        return path

    def witnesses(self, flights, bounds):
        """Flights of passive bodies that are let go at the start where no object is."""
        random = np.random.RandomState(1)
        low, high = bounds[::2], bounds[1::2]
        tried = low + random.random_sample((10 * WITNESSES, 3)) * (high - low)
        apart = np.min(np.linalg.norm(tried[:, None] - flights.positions[None, :, 0], axis=2), axis=1)
        chosen = np.argsort(apart < AWAY, kind="stable")[:WITNESSES]
        slip = np.sort(flights.slip)[np.arange(len(chosen)) * len(flights.slip) // len(chosen)]
        frames = flights.positions.shape[1]
        sinking = np.zeros((len(chosen), frames, 3))
        sinking[..., 2] = -slip[:, None]
        path = self.drift(tried[chosen], sinking, 0, frames, flights.rate)
        out = np.cumsum(np.any((path < low) | (path > high), axis=2), axis=1) > 0
        free = ~out
        free[:, :int(np.ceil(START * flights.rate))] = False
        for body in np.flatnonzero(out.any(axis=1)):
            end = int(np.argmax(out[body]))
            if path[body, max(end - 1, 0), 2] - low[2] < NEAR_GROUND:
                free[body, max(end - int(np.ceil(END * flights.rate)), 0):] = False
        path[out] = np.nan
        return Flights(path, flights.rate, ~out, free, slip)

    def _gradients(self, step):
        """By component of x: the velocity's derivative [k, j, i, 3] along it at a step [1/s]."""
        v = self.velocity[step].astype(float)
        return [np.gradient(v, self.spacing[c], axis=2 - c) if v.shape[2 - c] > 1 else np.zeros_like(v) for c in range(3)]

    def _change(self, step, gradients):
        """Du/Dt [m/s^2] at a step that is neither the first nor the last."""
        v = self.velocity[step].astype(float)
        change = (self.velocity[step + 1].astype(float) - self.velocity[step - 1]) / (self.times[step + 1] - self.times[step - 1])
        return change + sum(v[..., c:c + 1] * gradients[c] for c in range(3))

    def strengths(self, interval=0.1):
        """Rms of u [m/s], vorticity [1/s] and Du/Dt [m/s^2] over the lattice in each second of the shot [second, 3]."""
        squares, last = {}, -np.inf
        for step in range(1, len(self.times) - 1):
            if self.times[step] - last < interval * (1.0 - 1e-6):
                continue
            last = self.times[step]
            x, y, z = gradients = self._gradients(step)
            curl = np.stack([y[..., 2] - z[..., 1], z[..., 0] - x[..., 2], x[..., 1] - y[..., 0]], axis=-1)
            fields = (self.velocity[step], curl, self._change(step, gradients))
            squares.setdefault(int(last - self.times[0]), []).append([rms(field.reshape(-1, 3)) ** 2 for field in fields])
        return np.sqrt([np.mean(of_second, axis=0) for _, of_second in sorted(squares.items())]).reshape(-1, 3)

    def shells(self, every=15):
        """Energy of the velocity [m^2/s^2] by shell of wave number (in waves along the longest side), under Hann's window along each
        axis, mean over frames."""
        return shells([self.velocity[step] for step in range(0, len(self.times), every)], self.spacing)

    def wind_share(self, every=10):
        """Rms of the wind correction's force over that of the acceleration that the air has of its own, Dv/Dt less the wind's;
        NaN without a wind."""
        steps = [step for step in sorted(self.wind) if 0 < step < len(self.times) - 1]
        if not steps:
            return float("nan")
        force, own = [], []
        for step in steps[::every if len(self.wind) == len(self.times) else 1]:
            wind = self.wind[step].astype(float)
            force.append(rms(wind.reshape(-1, 3)) ** 2)
            own.append(rms((self._change(step, self._gradients(step)) - wind).reshape(-1, 3)) ** 2)
        return float(np.sqrt(np.mean(force) / np.mean(own))) if np.mean(own) > 0.0 else float("nan")


def shells(fields, spacing):
    """As AirField.shells, of fields [k, j, i, 3] on one lattice."""
    shape = fields[0].shape[:3]
    sides = np.array(shape) * np.asarray(spacing)[::-1]
    numbers = [(np.fft.fftfreq(n) * n).reshape([-1 if axis == a else 1 for a in range(3)]) * (sides.max() / sides[axis])
               for axis, n in enumerate(shape)]
    shell = np.rint(np.sqrt(sum(number**2 for number in numbers))).astype(int).ravel()
    window = np.einsum("k,j,i->kji", *(np.hanning(n + 2)[1:-1] for n in shape))[..., None]
    total = 0.0
    for field in fields:
        own = field.astype(float)
        own = (own - np.sum(window * own, axis=(0, 1, 2)) / window.sum()) * window
        waves = np.abs(np.fft.fftn(own, axes=(0, 1, 2))) ** 2
        total = total + np.bincount(shell, weights=waves.sum(axis=-1).ravel())
    return total / (len(fields) * np.prod(shape) * np.sum(window**2))


def read_air(folder):
    """The AirField of a folder, None without air.pvd; raises InputError that names the file and the lack."""
    folder = Folder(folder)
    if folder.found("air.pvd") is None:
        return None
    times, velocity, frame_of = _series(folder, "air.pvd", "Velocity")
    wind = {}
    if folder.found("air_wind.pvd") is not None:
        when, force, _ = _series(folder, "air_wind.pvd", "Wind", frame_of)
        wind = {times.index(time): values for time, values in zip(when, force) if time in times}
    return AirField(times, velocity, wind, *frame_of[:2])


def lattice_of(folder):
    """Points (i, j, k) of the lattice of a folder's air, None without air.pvd or images in it."""
    below = Folder(folder)
    if below.found("air.pvd") is None:
        return None
    for _, file in below.steps("air.pvd"):
        return read_image(below.file(file, "an image that is whole")).GetDimensions()
    return None


def _series(folder, name, array, lattice=None):
    """Times [s], values [step, k, j, i, 3] and lattice (origin, spacing, shape) of an array of a series of images."""
    series = folder.found(name)
    steps = folder.steps(name)
    check_steps(steps, series)
    if not steps:
        raise InputError(f"{series}: expected a file for each frame, found none")
    values = []
    for _, file in steps:
        path = folder.file(file, "an image that is whole")
        found, field = _image(path, array)
        lattice = lattice or found
        if found[2] != lattice[2]:
            raise InputError(f"{path}: expected the lattice of the first frame")
        values.append(field.astype(np.float32))
    return [time for time, _ in steps], values, lattice


def _image(path, array):
    image = read_image(path)
    shape = image.GetDimensions()[::-1]
    if not np.prod(shape) > 0:
        raise InputError(f"{path}: expected an image with the point data {array}, found no points")
    values = array_of(image.GetPointData(), array, path, 3).reshape(*shape, 3)
    if not (np.isfinite(image.GetOrigin()).all() and np.isfinite(image.GetSpacing()).all() and min(image.GetSpacing()) > 0.0):
        raise InputError(f"{path}: expected a lattice with a finite origin and steps above 0")
    return (image.GetOrigin(), image.GetSpacing(), shape), values
