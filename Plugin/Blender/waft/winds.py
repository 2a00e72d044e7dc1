# SPDX-License-Identifier: BSD-3-Clause
"""Force fields as winds and vortices of a scene: see Documentation/Blender.md for the factors."""
import math

import numpy as np

FIELDS = ("WIND", "VORTEX")
VORTEX_FACTOR = 2.0 * math.pi  # m: a long vortex of strength S accelerates by S / (2 pi r)
_CORE = 0.2  # share of a vortex's half length within which it turns like a wheel
_ALWAYS = 1000.0  # durations of the shot: as good as constant
_EVERYWHERE = 100.0  # sides of the volume


def field_of(thing):
    """The force field of an object that is a wind or a vortex, or None."""
    return thing.field if thing.field is not None and thing.field.type in FIELDS else None


def add_fields(stage, fields):
    """Adds winds and vortices to the scene of a stage (stage.py)."""
    for thing in fields:
        strengths = np.array([stage.numbers(thing, frame)[0] for frame in stage.frames])
        if not np.abs(strengths).max() > 0.0:
            continue
        peak, center_time, duration = _pulse(strengths, stage.rate)
        at_peak = stage.frames[0] + int(np.argmax(np.abs(strengths)))
        _, most, size = stage.numbers(thing, at_peak)
        matrix = np.array(stage.matrix(thing, at_peak), float)
        axis = matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
        place = matrix[:3, 3] * stage.unit
        times = {"centerTime": center_time, "duration": duration}
        if thing.field.type == "WIND" and thing.waft.is_front:
            start = stage.own_frame(thing, thing.waft.frame)
            if start is not None:
                stage.add("winds", thing, kind="front", direction=(np.sign(peak) * axis).tolist(), strength=float(abs(peak)), speed=thing.waft.front_speed,
                          width=thing.waft.front_width * stage.unit, startFrame=start, origin=place.tolist())
        elif thing.field.type == "WIND":
            reach = most * stage.unit / 2.0 if thing.field.use_max_distance else 0.0
            stage.add("winds", thing, direction=axis.tolist(), strength=float(peak), center=place.tolist(),
                      radius=reach or _EVERYWHERE * stage.widest, **times)
        else:
            half = np.linalg.norm(matrix[:3, 2]) * size * stage.unit
            stage.add("vortices", thing, p1=(place - half * axis).tolist(), p2=(place + half * axis).tolist(),
                      strength=float(VORTEX_FACTOR * peak), coreRadius=_CORE * half, **times)


def _pulse(strengths, rate):
    """(peak, centre [s], standard deviation [s]) of the Gaussian that a strength over the frames is taken for."""
    peak = strengths[np.argmax(np.abs(strengths))]
    times = np.arange(len(strengths)) / rate
    if np.ptp(strengths) <= 1e-6 * abs(peak):
        return peak, float(times[-1] / 2.0), float(_ALWAYS * times[-1])
    weights = np.abs(strengths)
    center = np.average(times, weights=weights)
    return peak, float(center), max(float(np.sqrt(np.average((times - center) ** 2, weights=weights))), 1.0 / rate)
