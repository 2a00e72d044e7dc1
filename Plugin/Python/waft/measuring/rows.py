# SPDX-License-Identifier: BSD-3-Clause
"""How good motion is, from the files of a result alone, beside drifters in free air (Documentation/Measure.md)."""
import math
import os
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from waft.failures import InputError
from waft.files import check_target
from waft.marks import is_marked_zip
from waft.measuring import _flights, _two_sample
from waft.measuring._airfield import lattice_of, read_air
from waft.measuring._approach import FIRST, LAST, LEAST_BODIES, approach
from waft.measuring._drifters import Drifters, gliding, make_drifters
from waft.measuring._facings import facings
from waft.measuring._flights import rms
from waft.measuring._gliding import APART, glides, near_pairs
from waft.measuring._letgo import NEAR, control, misses, rush, sinking
from waft.measuring._legibility import FILES as READABLE, legibility, read_drawings
from waft.measuring._meshcuts import FILES
from waft.measuring._runs import TRACKS, largest_residual, read_run
from waft.measuring._slipping import slips

MANY = 20  # objects from which figures about each frame's mean and about pairs mean something
START_FRAMES = 10
MARK_STEPS, MARK_FRAMES = 5, 10  # frames about a mark whose steps, and whose accelerations, are held against the rest of the flight
FAST_TURN, AT_LIMIT = 25.0, 1.0  # degrees a frame at 30 frames a second, that an eye can follow; and within which of a limit one lies
REPLAYED = (30, 90, 150)  # frames from which bodies drift on
GRAVITY = 9.81
LENGTHS = (4.0, 3.0, 2.0, 1.0)  # of the pieces of a spectrum, the longest that both have [s]
UNKNOWN = float("nan")

Path = Union[str, "os.PathLike[str]"]


@dataclass
class Row:
    """One figure: its name, value (NaN where it is not measured, and why), the range that is wanted, and the drifters' own."""

    key: str
    text: str
    value: float = UNKNOWN
    wanted: Tuple[float, float] = (-math.inf, math.inf)
    drifters: float = UNKNOWN
    why: str = ""

    @property
    def met(self) -> Optional[bool]:
        """None where there is nothing to be met."""
        if math.isnan(self.value) or self.wanted == (-math.inf, math.inf):
            return None
        return bool(self.wanted[0] <= self.value <= self.wanted[1])

    def wanted_text(self) -> str:
        low, high = self.wanted
        if low == -math.inf:
            return "" if high == math.inf else f"<= {high:g}"
        return f">= {low:g}" if high == math.inf else f"{low:g} to {high:g}"

    def as_json(self) -> Dict[str, Any]:
        def plain(number):
            return float(number) if math.isfinite(number) else None

        return {"key": self.key, "row": self.text, "value": plain(self.value), "wanted": [plain(end) for end in self.wanted],
                "drifters": plain(self.drifters), "met": self.met, "why": self.why}


@dataclass
class Measured:
    """The rows of a folder, or of several pooled."""

    name: str
    tracks: str
    objects: int
    rows: List[Row]
    notes: List[str] = field(default_factory=list)
    airs: List[Any] = field(default_factory=list)  # Flights of the motion
    others: List[Any] = field(default_factory=list)  # and of the drifters

    def __getitem__(self, key: str) -> Row:
        return next(row for row in self.rows if row.key == key)

    def as_json(self) -> Dict[str, Any]:
        return {"folder": self.name, "tracks": self.tracks, "objects": self.objects, "notes": self.notes,
                "rows": [row.as_json() for row in self.rows]}


def measure(folders: Union[Path, Sequence[Path]], tracks: str = "optimized", drifters: Optional[Path] = None, plots: Optional[Path] = None,
            progress: Optional[Callable[[float, str], None]] = None, scene: Optional[Path] = None) -> "List[Measured]":
    """Measures the motion of folders that `waft synthesize` wrote.

    folders:  one, or a list; with several, what is of the same scene is measured pooled, too
    tracks:   "optimized", "assimilated", "planned" or "poses": FOLDER/<tracks>.vtp
    drifters: a file that make_drifters wrote; if None one that comes with Waft, for the scene's volume where there is one
    plots:    a folder for pictures beside the drifters' (needs matplotlib)
    progress: called with the part done (0..1) and a sentence
    scene:    the scene file that was flown, whose texts and pictures are looked for in the motion

    Returns a list of Measured: one a folder, and last "pooled" where there are several. Raises InputError that names the file and
    the lack.
    """
    folders = [folders] if isinstance(folders, (str, os.PathLike)) else list(folders)
    if tracks not in TRACKS:
        raise InputError(f"tracks: expected one of {', '.join(TRACKS)}, found '{tracks}'")
    if not folders:
        raise InputError("expected at least one folder")
    if plots is not None:
        from waft.measuring._measureplots import check_pictures

        check_pictures([str(folder) for folder in folders] + ["pooled"] * (len(folders) > 1), tracks, plots)
    runs = [read_run(folder, tracks) for folder in folders]  # what is malformed is reported before anything is computed
    given = drifters and Drifters(drifters)
    drawings = None if scene is None else read_drawings(scene)
    done = []
    for run in runs:
        done.append(_measured([run], given, tracks, drawings, read_air(run.folder) if tracks != "planned" else None))
        if progress:
            progress(len(done) / (len(runs) + 1), f"{run.folder} measured")
    if len(runs) > 1:
        done.append(_measured(runs, given, tracks, drawings, None))
    if plots is not None:
        from waft.measuring._measureplots import draw

        for measured in done:
            measured.notes += draw(measured, plots)
    return done


def make_drifters_for(folders: Sequence[Path], path: Path, speeds: Optional[Sequence[float]] = None, airs: int = 6, seed: int = 20001,
                      progress: Optional[Callable[[float, str], Any]] = None, scene: Optional[Path] = None) -> None:
    """Makes a set of drifters for the volume, frame rate and settling speeds of folders; without a folder for the default volume
    and rate. speeds: instead of theirs [m/s]. scene: the file that was flown, whose obstacles, winds and vortices are theirs, too."""
    check_target(path, is_marked_zip)
    if scene is not None:
        read_drawings(scene)  # what is malformed is reported before anything is computed
    if not folders:
        if not speeds:
            raise InputError("drifters: expected a folder, or settling speeds")
        make_drifters(path, speeds, airs=airs, seed=seed, progress=progress)
        return
    runs = [read_run(folder, "planned") for folder in folders]
    first = runs[0]
    for run in runs:
        if np.any(run.bounds != first.bounds) or run.flights.rate != first.flights.rate:
            raise InputError(f"{run.folder}: expected the volume and frame rate of {first.folder}")
    speeds = speeds or sorted({float(slip) for run in runs for slip in run.flights.slip})
    make_drifters(path, speeds, first.bounds.tolist(), first.flights.rate, max(run.flights.positions.shape[1] for run in runs),
                  airs, seed, progress=progress, scene=scene, lattice=lattice_of(first.folder))


def _measured(runs, given, tracks, drawings, air):
    airs = [run.flights for run in runs]
    slips = np.concatenate([flights.slip for flights in airs])
    reference = given or Drifters.fitting(slips, runs[0].bounds, runs[0].flights.rate)
    others = reference.airs(slips)
    fewest = min(len(flights) for flights in airs)
    name = runs[0].folder if len(runs) == 1 else "pooled"
    notes = reference.lacks(slips, runs[0].bounds, runs[0].flights.rate)
    plain, others = others, gliding(others, airs)
    style = _Style(airs, others, fewest, plain)
    rows = [*_residuals(runs, air), *_replay(runs, air), *_let_go(runs, air), *_air(runs, air, reference), *style.rows(""),
            *_start(airs, others)]
    rows += _marks(runs) + _approaches(runs, air) + _witnesses(runs, air, plain) + _landing(runs, fewest)
    rows += _gliding(runs) + _slips(runs, air) + _turning(runs) + _contacts(runs) + _cuts(runs) + _legible(runs, drawings) + _facings(runs)
    residuals = [largest_residual(run) for run in runs]
    rows.append(Row("exact", "exact constraints: largest residual", _largest(residuals), (0.0, 1e-9)))
    return Measured(name, tracks, sum(len(flights) for flights in airs), rows, notes, airs, others)


def _largest(values):
    known = [value for value in values if not math.isnan(value)]
    return max(known) if known else UNKNOWN


class _Style:
    """Life, bands, one air and two-sample AUC of a motion beside its drifters; one air by what the air gives bodies, beside drifters
    that sink straight down."""

    def __init__(self, airs, others, fewest, plain=None):
        self._airs, self._others, self._many, self._plain = airs, others, fewest >= MANY, others if plain is None else plain

    def rows(self, of):
        key, text = (f"{of}_", f"{of}: ") if of else ("", "")
        rows = self._life(key, text)
        if not of:
            rows += self._bands()
        return rows + self._one_air(key, text) + [self._two_sample_auc(key, text)]

    def _life(self, key, text):
        seconds = None if self._many else min(_flights.flight_seconds(self._airs), _flights.flight_seconds(self._others))
        about = "each frame's mean" if self._many else "its own mean"
        if seconds is not None and math.isnan(seconds):
            own, theirs = (UNKNOWN, UNKNOWN), (UNKNOWN, UNKNOWN)
        else:
            own, theirs = (_flights.variances(airs, seconds) for airs in (self._airs, self._others))
        return [Row(f"{key}life_{name}", f"{text}life: variance of {name} about {about}", _ratio(mine, other), (0.7, 1.4), other,
                    "no free flight")
                for name, mine, other in zip(("velocity", "acceleration"), own, theirs)]

    def _bands(self):
        for seconds in LENGTHS:
            own, theirs = (_flights.band_energies(airs, seconds) for airs in (self._airs, self._others))
            if np.isfinite(own).all() and np.isfinite(theirs).all():
                break
        return [Row(f"band_{low:g}", f"energy at {low:g} to {high:g} Hz", _ratio(mine, other), (0.5, 2.0), other,
                    "no free flight of a second")
                for (low, high), mine, other in zip(_flights.BANDS, own, theirs)]

    def _one_air(self, key, text):
        rows = [Row(f"{key}one_air", f"{text}one air: mean |ln| of S2(r) over the drifters'", wanted=(0.0, 0.2)),
                Row(f"{key}one_air_along", f"{text}one air: 3 S_L / S below {_flights.NEAR:g} m", wanted=(0.45, 0.85))]
        if not self._many:
            for row in rows:
                row.why = f"fewer than {MANY} objects"
            return rows
        (own, rows[1].value), (theirs, rows[1].drifters) = (_flights.structure(airs) for airs in (self._airs, self._plain))
        rows[0].value = _flights.distance_of(own, theirs)
        rows[0].drifters = _flights.distance_of(*(_flights.structure(self._plain[half::2])[0] for half in (0, 1)))
        for row in rows:
            row.why = "too few pairs"
        return rows

    def _two_sample_auc(self, key, text):
        row = Row(f"{key}told_apart", f"{text}two-sample AUC (told apart): area under the ROC curve", wanted=(0.0, 0.75))
        if not _two_sample.is_there():
            row.why = "scikit-learn (python3-sklearn) is not installed"
            return row
        row.value = _two_sample.area(self._airs, self._others)
        if not key:
            row.drifters = _two_sample.area(self._others[::2], self._others[1::2])
        row.why = "too little free flight"
        return row


def _ratio(value, other):
    return value / other if other > 0.0 else UNKNOWN


def _spread(flights, mask):
    """Root of the variance of velocity: about each frame's mean, below MANY objects about each path's own."""
    many = len(flights) >= MANY
    squares = (_flights.about_frames(flights.velocity, mask) if many else
               _flights.about_paths(flights.velocity, mask, mask.shape[1]))
    return float(np.sqrt(squares.mean())) if len(squares) else UNKNOWN


def _residuals(runs, air):
    hidden = Row("hidden_hand", "model residual (hidden hand): acceleration the model does not give", wanted=(0.0, 0.2),
                 why="the tracks have no array AirVelocity or Residual")
    private = Row("private_hand", "residual control (private hand): velocity the air does not give", wanted=(0.0, 0.1),
                  why="no air.pvd")
    gas = Row("hidden_hand_gas", "model residual (hidden hand) of the gas", wanted=(0.0, 0.25), why="no optimised gas")
    rows = [hidden, private, gas]
    if len(runs) > 1:
        for row in rows:
            row.why = "see each folder"
        return rows
    run = runs[0]
    flights = run.flights
    inside = flights.inside
    own = rms(flights.acceleration[inside])
    gas.value = run.figures.get("GasHiddenHand", UNKNOWN)
    if "Residual" in run.arrays:
        hidden.value = _ratio(rms(run.arrays["Residual"][inside]), own)
    elif "AirVelocity" in run.arrays and "Control" not in run.arrays:
        hidden.value = _ratio(rms(_lacking(run)[inside]), own)
    elif "Control" in run.arrays:
        hidden.why = "an assimilated motion: see the residual control"
    if air is not None:
        control = _control(flights, air)
        private.value = _ratio(rms(control[inside]), _spread(flights, inside))
        private.why = "no flight"
    return rows


def _lacking(run):
    """Dv/Dt less what the air at the body gives: d/dt (U(x(t), t) - slip) for bodies without inertia, k (U - v) - g e_z with it."""
    flights = run.flights
    air = run.arrays["AirVelocity"].astype(float)
    if run.inertia:
        rate = GRAVITY / np.maximum(flights.slip, 1e-6)
        given = rate[:, None, None] * (air - flights.velocity)
        given[..., 2] -= GRAVITY
    else:
        given = np.gradient(air + flights.own(), 1.0 / flights.rate, axis=1)
    return flights.acceleration - given


def _control(flights, air):
    """c = x' - (U(x, t) + slip) of all objects at all frames, with their own slip where they glide, else straight down."""
    given = np.stack([air.at(flights.positions[:, frame], frame / flights.rate) for frame in range(flights.positions.shape[1])],
                     axis=1)
    return flights.velocity - given - flights.own()


def _replay(runs, air):
    """Forward replay, and of an optimised motion besides what it would be by the air alone."""
    why = "see each folder" if len(runs) > 1 else "no air.pvd; with particles, not measured" if air is None else "no flight of a second"
    value = _drift(runs[0].flights, air) if len(runs) == 1 and air is not None else UNKNOWN
    if len(runs) == 1 and "ReplayError" in runs[0].figures:
        return [Row("replay", "forward replay: velocity 1 s after gas and objects are let go", runs[0].figures["ReplayError"], (0.0, 0.25)),
                Row("drift", "forward replay: of the bodies alone, in the output Air", value, why=why)]
    return [Row("replay", "forward replay: velocity after 1 s of free drift in the output Air", value, (0.0, 0.15), why=why)]


def _drift(flights, air):
    """What bodies that are let go drift to within a second beside how they fly: rms of the difference of velocities over theirs."""
    later = int(round(flights.rate))
    wrong, all_ = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for first in REPLAYED:
        if first + later + 1 >= flights.positions.shape[1]:
            continue
        flown = np.flatnonzero(flights.inside[:, first:first + later + 1].all(axis=1))
        slips = flights.own()[flown, first:first + later + 1]
        path = air.drift(flights.positions[flown, first], slips, first, later + 1, flights.rate)
        drifting = air.at(path[:, -1], (first + later) / flights.rate) + slips[:, -1]
        own = flights.velocity[flown, first + later]
        wrong.append(drifting - own)
        all_.append(own)
    return _ratio(rms(np.concatenate(wrong)), rms(np.concatenate(all_)))


def _let_go(runs, air):
    """Whether the air alone brings bodies to their marks, and what it was given so that it does; of the assimilated motion."""
    rows = [Row("replay_last", "let go a second before each mark: miss over L, median", wanted=(0.0, 1e-3)),
            Row("replay_last_90", "let go a second before each mark: 90th percentile", wanted=(0.0, 1e-2)),
            Row("replay_whole", "let go at the start and at lift-offs: miss over L, median"),
            Row("replay_whole_90", "let go at the start and at lift-offs: 90th percentile"),
            Row("rush", "rush: correction in the last second before marks over its mean", wanted=(-math.inf, 1.8)),
            Row("sinking", "sinking: speed down 0.5 to 2 s after the last mark over settling", wanted=(0.8, 1.2)),
            Row("poses_off", "poses.vtp off these tracks in flight: largest over L"),
            Row("control", f"control half way through steps over the flow, {NEAR:g} m off others and floor", wanted=(0.0, 0.02)),
            Row("control_all", "control half way through steps over the flow: of all free steps"),
            Row("control_near", "control: share of free steps that are nearer")]
    run, frames = runs[0], runs[0].flights.positions.shape[1]
    why = ("see each folder" if len(runs) > 1 else "the tracks have no array Free: --tracks assimilated" if "Free" not in run.arrays else
           "no air.pvd" if air is None else "air.pvd has not every frame: fly with --keep air" if len(air.times) != frames else "")
    for row in rows:
        row.why = why or "no mark in free flight"
    if len(runs) == 1 and "Free" in run.arrays:
        falls = sinking(run)
        if len(falls):
            rows[5].value = _ratio(falls[:, 0].mean(), falls[:, 1].mean())
        rows[5].why = "nothing flies on after its last mark"
        rows[6].value = run.poses_off / run.width
        rows[6].why = "no poses.vtp"
    if why:
        return rows
    last, whole = misses(run, air)
    for row, (of, share) in zip(rows, ((last, 50), (last, 90), (whole, 50), (whole, 90))):
        row.value = float(np.percentile(of, share)) if len(of) else UNKNOWN
    late, mean = rush(run, air)
    rows[4].value = _ratio(late, mean)
    rows[4].why = "the Air has no array Wind" if not air.wind else rows[4].why
    rows[8].value, rows[7].value, rows[9].value = control(run, air)
    return rows


def _air(runs, air, drifters):
    """Whether the air is of one strength over the shot, and has the eddies that smoke has on its lattice."""
    steady = Row("stationary", "stationary: rms of u, vorticity, Du/Dt of the second farthest from the shot's", wanted=(0.7, 1.35))
    slope = Row("slope", "slope of the air's energy by shell, less that of free smoke", wanted=(-0.4, 0.4))
    for row in (steady, slope):
        row.why = "see each folder" if len(runs) > 1 else "no air.pvd"
    if len(runs) > 1 or air is None:
        return [steady, slope]
    strengths = air.strengths()
    steady.why = "air.pvd has less than a second"
    if len(strengths):
        shares = (strengths / np.sqrt(np.mean(strengths**2, axis=0))).ravel()
        steady.value = float(shares[np.argmax(np.abs(np.log(np.maximum(shares, 1e-9))))])
    slope.why = "the drifters have no energies on this lattice: --make-drifters FILE DIR --scene SCENE"
    if drifters.lattice == tuple(air.velocity[0].shape[2::-1]) and drifters.shells is not None:
        slope.value = _slope(air.shells(), drifters.lattice) - _slope(drifters.shells, drifters.lattice)
    return [steady, slope]


def _slope(energies, lattice):
    """Of the logarithms of energies by shell, from the fourth to those of three spacings."""
    shell = np.arange(4, max(max(lattice) // 3 + 1, 6))
    shell = shell[shell < len(energies)]
    known = shell[energies[shell] > 0.0]
    return float(np.polyfit(np.log(known), np.log(energies[known]), 1)[0]) if len(known) > 1 else UNKNOWN


def _start(airs, others):
    first = [flights.acceleration[:, 1:START_FRAMES][flights.inside[:, 1:START_FRAMES]] for flights in airs]
    flown = [flights.acceleration[flights.free] for flights in airs]
    jerks = [flights.jerk[:, 2:START_FRAMES][flights.inside[:, 2:START_FRAMES]] for flights in airs]
    theirs = [np.linalg.norm(flights.jerk[flights.free], axis=1) for flights in others]
    sizes = np.linalg.norm(np.concatenate(jerks), axis=1)
    theirs = np.concatenate(theirs)
    jerk = float(np.percentile(theirs, 99)) if len(theirs) else UNKNOWN
    return [Row("start", f"start: rms |a| of the first {START_FRAMES} frames over that of free flight",
                _ratio(rms(np.concatenate(first)), rms(np.concatenate(flown))), (0.0, 1.3), why="no flight at the start"),
            Row("start_jerk", "start: 99th percentile of jerk there over the drifters'",
                _ratio(float(np.percentile(sizes, 99)), jerk) if len(sizes) else UNKNOWN, (0.0, 1.3), jerk, "no flight at the start")]


def _marks(runs):
    """Whether bodies jump at their marks: the longest step there, and how hard they are pushed."""
    steps, pushes, landings = _Beside(), _Beside(), _Beside()
    for run in runs:
        flights = run.flights
        touched = np.zeros_like(run.placed)
        for index, frame in run.touches:
            touched[index, frame] = True
        step = np.linalg.norm(np.diff(flights.positions, axis=1), axis=2)
        near = _flights.widened(run.placed | touched, MARK_STEPS)
        steps.add(step, flights.flying[:, 1:] & flights.flying[:, :-1] & np.isfinite(step), near[:, 1:] | near[:, :-1])
        push = np.linalg.norm(flights.acceleration, axis=2)
        placed, landed = (_flights.widened(mask, MARK_FRAMES) for mask in (run.placed, touched))
        pushes.add(push, flights.inside & ~landed, placed)
        landings.add(push, flights.inside & ~placed, landed)
    where, why = f"within {MARK_FRAMES} frames over the 99th elsewhere", "no flight beside a mark"
    return [Row("mark_steps", f"marks: longest step within {MARK_STEPS} frames over the 99.9th percentile elsewhere",
                steps.ratio(100.0, 99.9), (0.0, 1.5), why=why),
            Row("mark_pushes", f"marks: 90th percentile of |a| {where}", pushes.ratio(90.0, 99.0), (0.0, 1.0), why=why),
            Row("landing_pushes", f"landing: 90th percentile of |a| {where}", landings.ratio(90.0, 99.0), why="nothing lands")]


def _approaches(runs, air):
    """Whether bodies come to a common mark spread out and each its own way, or poured in ropes."""
    figures = [approach(run, air) for run in runs]
    own, straight, aligned, free = (np.concatenate([np.array(of_run[k]) for of_run in figures]) for k in range(4))
    times = f"{FIRST:g} to {LAST:g} s before a common mark"
    why = f"no {LEAST_BODIES} bodies fly to one mark" if not len(own) else "see each folder" if len(runs) > 1 else "no air.pvd"
    return [Row("approach_spacing", f"approach: distance to the nearest {times} over straight paths'",
                _ratio(own.mean(), straight.mean()) if len(own) else UNKNOWN, (0.7, math.inf), why=why),
            Row("approach_alignment", "approach: alignment of neighbours there over that of free bodies",
                _ratio(aligned.mean(), free.mean()) if len(free) else UNKNOWN, (-math.inf, 1.5),
                float(free.mean()) if len(free) else UNKNOWN, why)]


class _Beside:
    """Values near to something, and those elsewhere."""

    def __init__(self):
        self._near, self._far = [np.zeros(0)], [np.zeros(0)]

    def add(self, values, mask, near):
        self._near.append(values[mask & near])
        self._far.append(values[mask & ~near])

    def ratio(self, near, far):
        """A percentile of the former over one of the latter; NaN without either."""
        close, away = np.concatenate(self._near), np.concatenate(self._far)
        return _ratio(float(np.percentile(close, near)), float(np.percentile(away, far))) if len(close) and len(away) else UNKNOWN


def _witnesses(runs, air, others):
    if len(runs) > 1 or air is None:
        why = "see each folder" if len(runs) > 1 else "no air.pvd"
        return [Row("witnesses", "witnesses: passive bodies in the output Air", why=why)]
    flights = air.witnesses(runs[0].flights, runs[0].bounds)
    rows = _Style([flights], others, len(flights)).rows("witnesses")
    return rows + [Row("witnesses_wind", "witnesses: force of the wind correction over the air's own Dv/Dt", air.wind_share(),
                       (0.0, 0.5), why="the Air has no array Wind")]


def _lies(path, touch):
    """The frame from which the centre of a body lies, which touches with an edge or a tip before."""
    still = np.flatnonzero((path[touch + 1:] == path[touch:-1]).all(axis=1))
    return touch + int(still[0]) if len(still) else touch


def _landing(runs, fewest):
    falls, times = [], []
    for run in runs:
        flights = run.flights
        half = int(round(0.5 * flights.rate))
        for index, touch in run.touches:
            lies = _lies(flights.positions[index], touch)
            if lies >= half and flights.flying[index, lies - half:touch + 1].all() and flights.slip[index] > 0.0:
                drop = flights.positions[index, lies - half, 2] - flights.positions[index, lies, 2]
                falls.append(drop * flights.rate / half / flights.slip[index])
                times.append(touch / flights.rate)
    return [Row("landing", "landing: mean speed down over the last 0.5 s, over settling", float(np.mean(falls)) if falls else UNKNOWN,
                (-math.inf, 1.0), why="nothing lands"),
            Row("landing_times", "landing: standard deviation of touch-down times [s]",
                float(np.std(times)) if len(times) > 1 and fewest >= MANY else UNKNOWN, (0.3, math.inf),
                why="nothing lands" if fewest >= MANY else f"fewer than {MANY} objects")]


def _gliding(runs):
    """Whether paths know of poses: bodies glide to where they lean, and turn as the air along their paths turns them."""
    tilts, speeds = (np.concatenate(values) for values in zip(*map(glides, runs)))
    known = len(tilts) > 1 and tilts.std() > 0.0 and speeds.std() > 0.0
    agreement = np.max([run.agreement for run in runs], axis=0).tolist()
    why = "poses.vtp does not say"
    return [Row("glide", "glide: correlation of the horizontal Slip downhill with sin(2 tilt)",
                float(np.corrcoef(tilts, speeds)[0, 1]) if known else UNKNOWN, why="no body glides in free flight"),
            Row("agreement", "agreement: poses off what the air turns in half a second, median [deg]", agreement[0], (0.0, 15.0), why=why),
            Row("agreement_90", "agreement: 90th percentile [deg]", agreement[1], (0.0, 45.0), why=why)]


def _slips(runs, air):
    """Whether Slip is what the poses in this air say by the law of a plate."""
    row = Row("slip", "slip: off the law of a plate in free flight, rms over rms", wanted=(-math.inf, 0.1),
              why="see each folder" if len(runs) > 1 else "no air.pvd" if air is None else "the tracks have no Slip with Orientation")
    found = slips(runs[0], air) if len(runs) == 1 and air is not None else None
    if found is not None and len(found[0]):
        row.value = _ratio(rms(found[0] - found[1]), rms(found[1]))
    return [row]


def _contacts(runs):
    """How often the centres of flying bodies are nearer than balls that hold them would be."""
    flown = sum(int(run.flights.flying.sum()) for run in runs)
    known = flown > 0 and all(np.isfinite(run.radii).all() for run in runs)
    return [Row("pairs", f"contact: share of body-frames with a centre within {APART:g} of the two radii",
                sum(map(near_pairs, runs)) / flown if known else UNKNOWN, why="objects.vtp has no ClearanceRadius")]


def _turning(runs):
    """Whether an eye can follow how bodies turn: how many steps are too fast, and how many lie at a limit."""
    turned, peaks = [np.zeros(0)], [np.zeros(0, bool)]
    for run in runs:
        turns = run.turns
        turns = turns[run.flights.flying[:, 1:] & run.flights.flying[:, :-1] & np.isfinite(turns)] * run.flights.rate / 30.0
        turned.append(turns)
        limit = run.limit * run.flights.rate / 30.0 if np.isfinite(run.limit) else turns.max(initial=0.0)
        peaks.append(turns > limit - AT_LIMIT)
    turns, peak = np.concatenate(turned), np.concatenate(peaks)
    shares = (float((turns > FAST_TURN).mean()), float(peak.mean())) if len(turns) else (UNKNOWN, UNKNOWN)
    return [Row("turning", f"turning: share of steps of more than {FAST_TURN:g} degrees at 30 frames a second", shares[0], (0.0, 0.05),
                why="no poses.vtp"),
            Row("turning_peak", f"turning: share of steps within {AT_LIMIT:g} degree of the limit", shares[1], (0.0, 0.05),
                why="no poses.vtp")]


def _facings(runs):
    """Whether bodies face where marks ask them to, and come to it as they turn in flight."""
    within, there, elsewhere = (np.concatenate(values) for values in zip(*map(facings, runs)))
    usual = np.percentile(elsewhere, 99) if len(elsewhere) else 0.0
    why = "no mark asks where its body faces, or no poses.vtp"
    return [Row("facing", "facing: share of bodies within the cone of their mark", float(within.mean()) if len(within) else UNKNOWN,
                (0.95, math.inf), why=why),
            Row("facing_pushes", "facing: largest angular acceleration in the 0.4 s before, over the 99th percentile elsewhere",
                float(there.max() / usual) if len(there) and usual > 0.0 else UNKNOWN, (-math.inf, 1.5), why=why)]


def _cuts(runs):
    """How often bodies are in each other: for want of room at marks, and where there is room."""
    found = [run.cuts for run in runs]
    flown = sum(int(run.flights.flying.sum()) for run in runs)
    known = flown > 0 and all(masks is not None for masks in found)
    shares = [sum(int(masks[kind].sum()) for masks in found) / flown for kind in (0, 1)] if known else [UNKNOWN, UNKNOWN]
    why = f"no {' or '.join(FILES)}"
    return [Row("cuts", "interpenetration: share of body-frames in flight, 2 % of the length", shares[0], (0.0, 0.001), why=why),
            Row("cuts_marks", "interpenetration beside marks nearer than bodies are wide", shares[1], why=why)]


def _legible(runs, drawings):
    """Whether texts and pictures are to be read of the bodies: half way at least from bodies that fly as they do to bodies that all
    face the reader, where the scene asks them to. Of drawings that ask so, where some do, the others do not count."""
    rows = [Row("legibility", "legibility: correlation of the silhouette with the drawing"),
            Row("legibility_facing", "legibility, were all bodies to face the reader")]
    found = [] if drawings is None else [legibility(run, drawings) for run in runs]
    known = [one for of_run in found if of_run is not None for one in of_run]
    why = ("no scene (--scene)" if drawings is None else "the scene draws no text or picture" if not drawings else
           f"no {' or '.join(READABLE)}" if None in found else "it is seen edge-on")
    for row in rows:
        row.why = why
    asking = [one for one in known if one[0]]
    if known:
        rows[0].value, flown, rows[1].value = np.mean([one[1:] for one in asking or known], axis=0).tolist()
        rows[0].drifters = flown
        if asking and not math.isnan(flown):
            rows[0].wanted = (round(0.5 * (flown + rows[1].value), 3), math.inf)
    return rows


def table(measured: Measured) -> List[str]:
    """The rows as lines of text."""
    def figure(number):
        return "" if math.isnan(number) else "0" if number == 0.0 else f"{number:.3g}" if abs(number) >= 1e-3 else f"{number:.1e}"

    lines = [f"{measured.name}: {measured.tracks}, {measured.objects} object{'s' * (measured.objects != 1)}",
             f"{'row':<66}{'value':>9}  {'wanted':<13}{'drifters':>9}"]
    for row in measured.rows:
        lost = f"  not measured: {row.why}" if math.isnan(row.value) else "" if row.met in (True, None) else "  missed"
        lines.append(f"{row.text:<66}{figure(row.value) or '-':>9}  {row.wanted_text():<13}{figure(row.drifters):>9}{lost}".rstrip())
    return lines + [f"note: {note}" for note in measured.notes]
