# SPDX-License-Identifier: BSD-3-Clause
"""`waft measure`: its definitions on tracks whose figures are known, the command on a small folder, bad input.

    pvpython run.py test_measure.py WORK_FOLDER"""
import contextlib
import io
import json
import math
import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkMultiBlockDataSet  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkPlaneSource  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402

import sample_folder  # noqa: E402

import waft  # noqa: E402
from waft import cli  # noqa: E402
from waft.failures import BadInput  # noqa: E402
from datafiles import write_pvd, write_xml  # noqa: E402
from waft.measuring import _flights, _two_sample  # noqa: E402
from waft.measuring._airfield import AirField, shells  # noqa: E402
from waft.measuring._drifters import QUANTUM, Drifters, _decoded, _encoded, gliding, make_drifters  # noqa: E402
from waft.measuring._flights import Flights, rms  # noqa: E402
from waft.measuring._legibility import covered  # noqa: E402
from waft.measuring._runs import flight, held, read_run  # noqa: E402
from waft.measuring.rows import _control, _lacking, table  # noqa: E402
from waft.reading import read_picture, read_surface  # noqa: E402

WORK = sys.argv[1]
shutil.rmtree(WORK, ignore_errors=True)  # of a version whose files this one does not replace
RATE = 30.0
FRAMES = 90
COUNT = 24
BOUNDS = (-2.0, 2.0, -2.0, 2.0, 0.0, 4.0)
SLIP = 0.2
SPIN = 0.8  # of the air about the volume's middle [rad/s]
FEW = os.path.join(WORK, "few.npz")


def setUpModule():
    """Of the default drifters two airs of twelve bodies: most of what is measured is no matter of style."""
    default = Drifters()
    made = {"Bounds": default.bounds, "FramesPerSecond": default.rate, "NumberOfFrames": default.frames, "Seeds": default.seeds[:2],
            "SettlingSpeeds": default.speeds}
    for speed, airs in enumerate(default._paths):
        for air in range(2):
            made.update(_encoded(airs[air][:12], speed, air))
    os.makedirs(WORK)
    np.savez(FEW, **made)


def measure(folders, **options):
    return waft.measure(folders, **{"drifters": FEW, **options})


def sinking(count, slip, frames):
    """The velocity [body, frame, 3] of bodies that sink straight down through the air."""
    own = np.zeros((count, frames, 3))
    own[..., 2] = -slip
    return own


def flights(positions, slip=0.0):
    everywhere = np.ones(positions.shape[:2], bool)
    return Flights(positions, RATE, everywhere, everywhere, np.full(len(positions), slip))


def places(count, seed=3):
    return np.array([0.0, 0.0, 2.0]) + 2.4 * (np.random.RandomState(seed).random_sample((count, 3)) - 0.5)


def waves(count, frequency, amplitude=0.1, frames=300, seed=0):
    """Bodies that swing along x, each with a phase of its own."""
    random = np.random.RandomState(seed)
    time = np.arange(frames) / RATE
    positions = np.repeat(places(count, seed)[:, None], frames, axis=1)
    phase = 2.0 * np.pi * random.random_sample((count, 1))
    positions[..., 0] += amplitude * np.sin(2.0 * np.pi * frequency * time + phase)
    return positions


def turning_air(frames=FRAMES, nodes=9):
    """Solid rotation about the vertical axis, which a trilinear lattice holds exactly."""
    axis = np.linspace(-2.0, 2.0, nodes)
    z, y, x = np.meshgrid(np.linspace(0.0, 4.0, nodes), axis, axis, indexing="ij")
    one = np.stack([-SPIN * y, SPIN * x, 0.0 * z], axis=-1)
    spacing = np.full(3, 4.0 / (nodes - 1))
    return AirField(np.arange(frames) / RATE, np.repeat(one[None], frames, axis=0), None, [-2.0, -2.0, 0.0], spacing)


def write_folder(folder, positions, slip=SLIP, air=None, rest=None, said=None, mark=None, wind=0.0):
    """What `waft measure` reads of a result: rest is the frame from which all lie, mark one at which all have a ball to pass through,
    said what an optimiser says of it, wind the correction's force over the air's velocity, by step. All steps are free."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    count, frames = positions.shape[:2]
    tracks = sample_folder._vertices(positions.reshape(-1, 3))
    tracks.SetVerts(vtkCellArray())
    cells = vtkCellArray()
    for i in range(count):
        cells.InsertNextCell(frames)
        for k in range(frames):
            cells.InsertCellPoint(i * frames + k)
    tracks.SetLines(cells)
    sample_folder.add(tracks.GetCellData(), "ObjectId", np.arange(count), np.int32)
    sample_folder.add(tracks.GetFieldData(), "Bounds", [[value] for value in BOUNDS])
    sample_folder.add(tracks.GetFieldData(), "FramesPerSecond", [RATE])
    for name, value in (said or {}).items():
        sample_folder.add(tracks.GetFieldData(), name, [value])
    sample_folder.add(tracks.GetPointData(), "Free", np.ones(count * frames), np.uint8)
    for name in ("optimized", "planned", "assimilated"):
        write_xml(tracks, os.path.join(folder, f"{name}.vtp"))
    objects = sample_folder._vertices(positions[:, 0])
    sample_folder.add(objects.GetPointData(), "ObjectId", np.arange(count), np.int32)
    sample_folder.add(objects.GetPointData(), "SettlingSpeed", np.full(count, slip))
    write_xml(objects, os.path.join(folder, "objects.vtp"))
    if rest is not None or mark is not None:
        frame, what, until, radius = (mark, 0, mark, 0.02) if rest is None else (rest, 4, frames - 1, 0.0)
        write_folder_rows(folder, positions, frame, what, until, radius, range(count))
    if air is not None:
        for name, array, factor in (("air", "Velocity", np.ones(len(air.times))), ("air_wind", "Wind", np.broadcast_to(wind, len(air.times)))):
            os.makedirs(os.path.join(folder, name))
            entries = []
            for step, time in enumerate(air.times):
                image = vtkImageData()
                image.SetDimensions(air.velocity.shape[3:0:-1])
                image.SetOrigin(air.origin)
                image.SetSpacing(air.spacing)
                sample_folder.add(image.GetPointData(), array, factor[step] * air.velocity[step].reshape(-1, 3), np.float32)
                entries.append((float(time), f"{name}/{name}_{step:04d}.vti"))
                write_xml(image, os.path.join(folder, entries[-1][1]))
            write_pvd(os.path.join(folder, f"{name}.pvd"), entries)
    return folder


def write_folder_rows(folder, positions, frame, what, until, radius, which, facing=(0.0, 0.0, 0.0), tolerance=0.0):
    """constraints.vtp with a row for each of some bodies, where they are at that frame: targets of the scene's first."""
    which = np.array(list(which))
    rows = sample_folder._vertices(positions[which, frame])
    columns = rows.GetPointData()
    for name, value, kind in (("Frame", frame, np.int32), ("Kind", what, np.uint8), ("Until", until, np.int32), ("Radius", radius, float)):
        sample_folder.add(columns, name, np.full(len(which), value), kind)
    sample_folder.add(columns, "Row", np.zeros(len(which)), np.int32)
    sample_folder.add(columns, "Facing", np.tile(facing, (len(which), 1)))
    sample_folder.add(columns, "FacingTolerance", np.full(len(which), tolerance))
    sample_folder.add(columns, "ObjectId", which, np.int32)
    sample_folder.add(columns, "Value", np.pad(positions[which, frame], ((0, 0), (0, 1))))
    write_xml(rows, os.path.join(folder, "constraints.vtp"))


def write_poses(folder, orientations, length, width):
    """poses.vtp of a folder's tracks, whose bodies are sheets, with these orientations [body, frame, 4]; returns it."""
    poses = read_surface(os.path.join(folder, "planned.vtp"))
    sample_folder.add(poses.GetPointData(), "Orientation", orientations.reshape(-1, 4))
    write_xml(poses, os.path.join(folder, "poses.vtp"))
    objects = read_surface(os.path.join(folder, "objects.vtp"))
    sample_folder.add(objects.GetPointData(), "ShapeId", np.zeros(len(orientations)), np.int32)
    sample_folder.add(objects.GetPointData(), "ClearanceRadius", np.full(len(orientations), 0.5 * length))
    write_xml(objects, os.path.join(folder, "objects.vtp"))
    sheet = vtkPlaneSource()
    sheet.SetOrigin(-0.5 * length, -0.5 * width, 0.0)
    sheet.SetPoint1(0.5 * length, -0.5 * width, 0.0)
    sheet.SetPoint2(-0.5 * length, 0.5 * width, 0.0)
    sheet.Update()
    shapes = vtkMultiBlockDataSet()
    shapes.SetBlock(0, sheet.GetOutput())
    write_xml(shapes, os.path.join(folder, "shapes.vtm"))
    return poses


def write_drawing(folder):
    """A scene of one sheet that is to stand upright before the middle of a picture of 40 x 20 pixels of 2 cm, of which the middle
    20 x 10 are drawn; returns its file."""
    image = vtkImageData()
    image.SetDimensions(40, 20, 1)
    pixels = np.zeros((20, 40, 4), np.uint8)
    pixels[5:15, 10:30] = 255
    sample_folder.add(image.GetPointData(), "Colours", pixels.reshape(-1, 4), np.uint8)
    image.GetPointData().SetActiveScalars("Colours")
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(folder, "sheet.png"))
    writer.SetInputData(image)
    writer.Write()
    path = os.path.join(folder, "sheet.waft.json")
    target = {"image": "sheet.png", "origin": [0.0, 0.0, 1.0], "u": [1.0, 0.0, 0.0], "v": [0.0, 0.0, 1.0], "width": 0.8, "count": 1}
    with open(path, "w", encoding="utf-8") as stream:
        json.dump({"waft": 1, "shapes": {"sheet": {"builtin": "disc"}}, "objects": [{"shape": "sheet", "position": [0.0, 0.0, 3.0]}],
                   "constraints": [{"kind": "keyframe", "frame": 75, "targets": target}]}, stream)
    return path


class DefinitionTest(unittest.TestCase):
    def test_straight_lines_have_no_life(self):
        time = np.arange(FRAMES) / RATE
        moved = flights(places(COUNT)[:, None] + time[None, :, None] * np.array([0.4, 0.1, -0.3]))
        velocity, acceleration = _flights.variances([moved])
        self.assertLess(velocity, 1e-20)
        self.assertLess(acceleration, 1e-16)
        self.assertLess(_flights.band_energies([moved], 2.0).max(), 1e-20)

    def test_variances_are_those_of_the_formula(self):
        w = 2.0 * math.pi * 0.9
        moved = flights(waves(400, 0.9))
        velocity, acceleration = _flights.variances([moved])
        self.assertAlmostEqual(velocity / (0.5 * (0.1 * w) ** 2), 1.0, delta=0.02)
        self.assertAlmostEqual(acceleration / (0.5 * (0.1 * w * w) ** 2), 1.0, delta=0.02)
        own = _flights.variances([flights(waves(1, 0.9))], 10.0)[0]  # nine whole waves
        self.assertAlmostEqual(own / (0.5 * (0.1 * w) ** 2), 1.0, delta=0.03)

    def test_the_mean_of_a_frame_is_no_life(self):
        one = waves(1, 0.5)
        together = flights(one + places(COUNT, 5)[:, None])
        self.assertLess(_flights.variances([together])[0], 1e-20)
        self.assertGreater(_flights.variances([together], 4.0)[0], 0.01)

    def test_a_wave_has_its_energy_in_its_band(self):
        for band, frequency in enumerate((0.2, 0.45, 0.9, 1.8)):
            energies = _flights.band_energies([flights(waves(20, frequency))], 5.0)
            self.assertEqual(int(np.argmax(energies)), band)
            if band:
                self.assertAlmostEqual(energies.sum() / (0.5 * (0.2 * math.pi * frequency) ** 2), 1.0, delta=0.12)

    def test_s2_of_strangers_is_one_and_of_a_linear_flow_grows_with_the_distance(self):
        random = np.random.RandomState(1)
        position = np.repeat(places(300)[:, None], 5, axis=1) + random.normal(0.0, 0.01, (300, 5, 3))
        values, along = _flights.structure([flights(position)], every=1)
        self.assertLess(np.nanmax(np.abs(values - 1.0)), 0.1)
        self.assertAlmostEqual(along, 1.0, delta=0.15)
        path = turning_air(20).drift(places(300), sinking(300, 0.0, 20), 0, 20, RATE)
        values, along = _flights.structure([flights(path)])
        self.assertTrue(np.all(np.diff(values) > 0.0))
        self.assertLess(along, 1e-3)  # a solid body does not stretch

    def test_a_body_that_goes_by_its_slip_has_no_residual_control(self):
        air = turning_air()
        own = sinking(COUNT, SLIP, FRAMES)
        own[..., 0] = 0.4 * np.sin(2.0 * np.pi * np.arange(FRAMES) / 20.0)
        path = air.drift(places(COUNT), own, 0, FRAMES, RATE)
        moved = flights(path, SLIP)
        gliding = Flights(path, RATE, moved.flying, moved.free, moved.slip, own)
        control = _control(gliding, air)[gliding.inside]
        self.assertLess(np.abs(control).max(), 0.03)  # a central difference of a swing
        self.assertGreater(np.abs(_control(moved, air)[moved.inside]).max(), 0.35)

    def test_drifters_glide_as_the_bodies_do(self):
        still = [flights(np.repeat(places(5)[:, None], FRAMES, axis=1), SLIP)]
        own = sinking(COUNT, SLIP, FRAMES)
        own[..., 0] += 0.4 * np.sin(2.0 * np.pi * np.arange(FRAMES) / 20.0)
        moved = flights(np.repeat(places(COUNT)[:, None], FRAMES, axis=1), SLIP)
        glided = gliding(still, [Flights(moved.positions, RATE, moved.flying, moved.free, moved.slip, own)])[0]
        inside = glided.inside
        self.assertLess(np.abs(glided.velocity[inside] - (own[:5] + [0.0, 0.0, SLIP])[inside]).max(), 0.03)
        self.assertIs(gliding(still, [moved]), still)

    def test_a_passive_body_has_no_residual_control(self):
        air = turning_air()
        path = air.drift(places(COUNT), sinking(COUNT, SLIP, FRAMES), 0, FRAMES, RATE)
        moved = flights(path, SLIP)
        self.assertLess(np.abs(_control(moved, air)[moved.inside]).max(), 2e-4)
        radius = np.hypot(path[:, 0, 0], path[:, 0, 1])
        self.assertLess(np.abs(np.hypot(path[:, -1, 0], path[:, -1, 1]) - radius).max(), 1e-6)
        pushed = path + 0.1 * np.arange(FRAMES)[None, :, None] / RATE * np.array([0.0, 0.0, 1.0])
        control = _control(flights(pushed, SLIP), air)[:, 1:-1]
        self.assertLess(np.abs(control - [0.0, 0.0, 0.1]).max(), 1e-3)

    def test_the_model_residual_is_what_the_air_does_not_give(self):
        class Run:
            inertia = False
            flights = None
            arrays = {}

        time = np.arange(FRAMES) / RATE
        position = np.zeros((1, FRAMES, 3))
        position[0, :, 0] = 0.5 * 0.3 * time**2
        Run.flights = flights(position, SLIP)
        air = np.zeros_like(position)
        air[0, :, 0] = 0.2 * time
        Run.arrays = {"AirVelocity": air}
        self.assertTrue(np.allclose(_lacking(Run)[0, 2:-2], [0.1, 0.0, 0.0]))
        Run.inertia = True  # v' = k (U - v) - g e_z
        self.assertTrue(np.allclose(_lacking(Run)[0, 2:-2, 2], 9.81))

    def test_flight(self):
        rows = {"ObjectId": np.array([0, 0, 1, 2]), "Frame": np.array([60, 30, 0, 50]), "Kind": np.array([4, 0, 4, 4]),
                "Until": np.array([89, 30, 20, 89]), "TouchDown": np.array([-1, -1, -1, 40]), "LiftOff": np.array([-1, -1, -1, -1])}
        flying, free, touches = flight(rows, np.arange(3), FRAMES, RATE)
        self.assertEqual([list(np.flatnonzero(row)[[0, -1]]) for row in flying], [[0, 60], [20, 89], [0, 40]])
        self.assertEqual(list(np.flatnonzero(free[0])), [*range(15, 22)])
        self.assertEqual(list(np.flatnonzero(free[1])), [*range(35, 90)])
        self.assertEqual(list(np.flatnonzero(free[2])), [15])
        self.assertEqual(touches, [(0, 60), (2, 40)])

    def test_a_hold_and_what_is_beside_it_is_no_free_flight(self):
        rows = {"ObjectId": np.array([0]), "Frame": np.array([40]), "Kind": np.array([0]), "Until": np.array([60]),
                "TouchDown": np.array([-1]), "LiftOff": np.array([-1])}
        flying, free, _ = flight(rows, np.array([0]), 120, 30.0, np.array([10]))
        self.assertEqual([*range(10, 40), *range(61, 120)], np.flatnonzero(flying[0]).tolist())
        self.assertEqual([*range(75, 120)], np.flatnonzero(free[0]).tolist())  # 0.8 s before it is the start's still

    def test_drifters_glide_as_bodies_that_are_released(self):
        flying = np.arange(50) >= 20
        glide = np.where(flying[:, None], (1.0, 0.0, -0.5), 0.0)[None]
        body = Flights(np.zeros((1, 50, 3)), 10.0, flying[None], flying[None], np.array([0.5]), glide)
        drifter = Flights(np.zeros((1, 30, 3)), 10.0, np.ones((1, 30), bool), np.ones((1, 30), bool), np.array([0.5]))
        turned, = gliding([drifter], [body])
        np.testing.assert_allclose(np.diff(turned.positions[0], axis=0), np.broadcast_to((0.1, 0.0, 0.0), (29, 3)), atol=1e-12)

    def test_a_jump_at_a_mark_is_seen_and_told_by_its_size(self):
        frame, jump = 60, 0.2
        folder = os.path.join(WORK, "marks")

        def figures(positions):
            write_folder(folder, positions, mark=frame)
            measured = measure(folder)[0]
            return [measured[key] for key in ("mark_steps", "mark_pushes")]

        smooth = waves(COUNT, 0.5, frames=FRAMES)
        steps, pushes = figures(smooth)
        self.assertTrue(steps.met and pushes.met, (steps, pushes))
        jumping = smooth.copy()
        jumping[:, frame, 1] += jump  # there for the frame of the mark alone
        steps, pushes = figures(jumping)
        longest = 0.1 * math.pi / RATE  # of the waves
        self.assertAlmostEqual(steps.value, math.hypot(longest, jump) / longest, delta=0.2)
        self.assertGreater(pushes.value, 1.0)
        self.assertFalse(steps.met or pushes.met)
        jumping = smooth.copy()
        jumping[:, 20, 1] += jump  # the same away from marks
        self.assertTrue(all(row.met for row in figures(jumping)))

    def test_a_rope_of_bodies_before_a_common_mark_is_seen(self):
        frames, mark = 180, 150
        air = turning_air(frames)
        drifting = air.drift(places(COUNT), sinking(COUNT, SLIP, frames), 0, frames, RATE)

        def figures(name, positions):
            measured = measure(write_folder(os.path.join(WORK, name), positions, air=air, mark=mark))[0]
            return [measured[key] for key in ("approach_spacing", "approach_alignment")]

        spacing, alignment = figures("passing", drifting)
        self.assertAlmostEqual(alignment.value, 1.0, delta=0.01)  # they are as free as the free
        self.assertTrue(alignment.met)
        share = np.minimum(np.arange(frames) / mark, 1.0)[None, :, None]
        first, last = places(COUNT)[:, None], places(COUNT, 4)[:, None]
        straight = first + share * (last - first)
        spacing, _ = figures("straight", straight)
        self.assertAlmostEqual(spacing.value, 1.0, delta=1e-6)
        middle = straight.mean(axis=0, keepdims=True)
        spacing, _ = figures("roped", middle + (1.0 - 0.8 * np.sin(np.pi * share)) * (straight - middle))
        self.assertLess(spacing.value, 0.5)
        self.assertFalse(spacing.met)
        axis = np.linspace(-2.0, 2.0, 33)
        updraughts = np.zeros((1, 2, 2, 33, 3))
        updraughts[..., 2] = SLIP + np.cos(2.0 * np.pi * axis)  # a metre wide each
        air = AirField([0.0, frames / RATE], np.repeat(updraughts, 2, axis=0), None, [-2.0, -2.0, 0.0], [0.125, 4.0, 4.0])
        stream = places(COUNT)[:, None] + share * np.array([0.5, 0.0, 0.0])  # side by side, where the free part
        alignment = figures("stream", stream)[1]
        self.assertAlmostEqual(alignment.value * alignment.drifters, 1.0, delta=1e-6)
        self.assertFalse(alignment.met, alignment)

    def test_a_row_that_is_not_met_is_not_exact(self):
        folder, mark = os.path.join(WORK, "unmet"), 45
        positions = waves(COUNT, 0.5, frames=FRAMES)
        write_folder(folder, positions, mark=mark)
        path = os.path.join(folder, "constraints.vtp")
        rows = read_surface(path)
        wanted = np.pad(positions[:, mark], ((0, 0), (0, 1)))
        wanted[3, 1] += 0.42  # beyond its ball of 2 cm
        sample_folder.add(rows.GetPointData(), "Value", wanted)
        for status, miss in ((0, 0.1), (3, 0.0)):
            sample_folder.add(rows.GetPointData(), "Status", np.where(np.arange(COUNT) == 3, status, 0), np.int32)
            write_xml(rows, path)
            self.assertAlmostEqual(measure(folder)[0]["exact"].value, miss, msg=status)  # over the volume's width, 4 m

    def test_rows_of_position_hold_objects(self):
        rows = {"ObjectId": np.array([5, 5, 7, 9]), "Frame": np.array([10, 12, 30, 4]), "Kind": np.array([0, 1, 4, 0])}
        self.assertEqual([tuple(entry) for entry in np.argwhere(held(rows, np.array([5, 7]), FRAMES))], [(0, 10)])

    def test_a_landing_is_a_mark_of_its_own(self):
        folder, rest = os.path.join(WORK, "landings"), 60
        positions = waves(COUNT, 0.5, frames=FRAMES)
        positions[:, rest - 5:, 2] += 0.3  # all are thrown up before they come to lie
        measured = measure(write_folder(folder, positions, rest=rest))[0]
        self.assertGreater(measured["mark_steps"].value, 1.5)
        self.assertGreater(measured["landing_pushes"].value, 1.0)
        self.assertIsNone(measured["landing_pushes"].met)
        self.assertTrue(math.isnan(measured["mark_pushes"].value))

    def test_turning_that_frames_cannot_show_is_counted(self):
        folder = write_folder(os.path.join(WORK, "turning"), waves(COUNT, 0.5, frames=FRAMES))
        self.assertTrue(math.isnan(measure(folder)[0]["turning"].value))

        def shares(degrees, limit=None):
            poses = read_surface(os.path.join(folder, "planned.vtp"))
            angle = np.radians(np.concatenate([np.zeros((COUNT, 1)), np.cumsum(degrees, axis=1)], axis=1)).reshape(-1)
            zero = np.zeros_like(angle)
            sample_folder.add(poses.GetPointData(), "Orientation", np.stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)], axis=1))
            if limit is not None:
                sample_folder.add(poses.GetFieldData(), "TurningLimit", [limit])
            write_xml(poses, os.path.join(folder, "poses.vtp"))
            measured = measure(folder)[0]
            return [measured[key] for key in ("turning", "turning_peak")]

        degrees = 20.0 * np.random.RandomState(2).triangular(0.0, 0.3, 1.0, (COUNT, FRAMES - 1))
        self.assertTrue(all(row.met and row.value < 0.06 for row in shares(degrees)), "none is fast, few are at the end")
        degrees[:, ::10] = 40.0  # held there by a limit
        fast, peak = shares(degrees)
        self.assertAlmostEqual(fast.value, 9 / 89, delta=1e-3)
        self.assertAlmostEqual(peak.value, fast.value)
        self.assertFalse(fast.met or peak.met)
        self.assertAlmostEqual(shares(degrees, limit=40.5)[1].value, fast.value)
        self.assertEqual(shares(degrees, limit=60.0)[1].value, 0.0, "all turn freely, many at one rate")

    def test_how_bodies_come_to_face_is_measured(self):
        positions, mark = waves(COUNT, 0.5, frames=FRAMES), 60
        folder = write_folder(os.path.join(WORK, "facing"), positions)
        self.assertTrue(math.isnan(measure(folder)[0]["facing"].value))
        write_folder_rows(folder, positions, mark, 0, mark, 0.02, range(COUNT), facing=(0.0, 3.0, 0.0), tolerance=0.2)
        time = np.arange(FRAMES) / RATE

        def figures(late, missed=0.0):
            """Bodies swing about their x axis, with a largest acceleration of 1, and stand upright at their mark, but for some; the
            last third of a second turns them there and back."""
            part = np.clip((time - time[mark]) * 3.0 + 1.0, 0.0, 1.0)
            swing = np.sin(time - time[mark]) + late * (part * (1.0 - part)) ** 2
            angle = -0.5 * math.pi + np.tile(swing, (COUNT, 1))
            angle[::8] += missed
            zero = np.zeros_like(angle)
            write_poses(folder, np.stack([np.cos(angle / 2), np.sin(angle / 2), zero, zero], axis=2), 0.2, 0.1)
            measured = measure(folder)[0]
            return measured["facing"], measured["facing_pushes"]

        facing, pushes = figures(late=0.05)
        self.assertEqual(facing.value, 1.0)
        self.assertAlmostEqual(pushes.value, 0.8, delta=0.15)
        self.assertTrue(facing.met and pushes.met)
        facing, pushes = figures(late=1.0, missed=0.3)
        self.assertAlmostEqual(facing.value, 1.0 - math.ceil(COUNT / 8) / COUNT)
        self.assertGreater(pushes.value, 3.0)
        self.assertFalse(facing.met or pushes.met)

    def test_bodies_that_are_in_each_other_are_counted(self):
        """Two rows of sheets that stand still but for one, which passes through its neighbour at right angles."""
        positions = np.zeros((COUNT, FRAMES, 3))
        positions[..., 0], positions[..., 2] = 0.4 * np.arange(COUNT)[:, None] - 4.0, 1.0
        positions[1] = positions[0] + np.linspace([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], FRAMES)
        folder = write_folder(os.path.join(WORK, "cuts"), positions)
        self.assertIn("shapes.vtm", measure(folder)[0]["cuts"].why)

        def shares():
            return [measure(folder)[0][key].value for key in ("cuts", "cuts_marks")]

        turned = np.zeros((COUNT, FRAMES, 4))
        turned[..., 0] = 1.0
        turned[1] = math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0
        poses = write_poses(folder, turned, 0.2, 0.1)
        # They cross over 0.2 m along y, less the depth at either end; each counts.
        step = 2.0 / (FRAMES - 1)
        self.assertAlmostEqual(shares()[0], 2 * 0.192 / step / (COUNT * FRAMES), delta=2 * 2 / (COUNT * FRAMES))
        self.assertEqual(shares()[1], 0.0)
        write_folder_rows(folder, positions, frame=FRAMES // 2, what=0, until=FRAMES // 2, radius=0.02, which=[0, 1])
        self.assertEqual(shares()[0], 0.0, "their marks are in each other")
        self.assertGreater(shares()[1], 0.0)
        write_folder_rows(folder, positions, frame=0, what=4, until=FRAMES - 1, radius=0.0, which=[0])
        lying = shares()
        sample_folder.add(poses.GetCellData(), "TouchDown", np.where(np.arange(COUNT) == 1, 0, -1), np.int32)
        write_xml(poses, os.path.join(folder, "poses.vtp"))
        self.assertGreater(sum(lying), 0.0, "one flies through one that lies")
        self.assertEqual(sum(shares()), 0.0, "both lie")

    def test_bodies_that_glide_down_their_slope(self):
        positions = waves(COUNT, 0.5, frames=FRAMES)
        folder = write_folder(os.path.join(WORK, "gliding"), positions)
        random = np.random.RandomState(8)
        tilt = random.uniform(0.05, 3.09, (COUNT, FRAMES))  # past a right angle it is upside down
        way = random.uniform(0.0, 6.28, (COUNT, FRAMES))
        turned = np.stack([np.cos(tilt / 2), np.sin(tilt / 2) * np.cos(way), np.sin(tilt / 2) * np.sin(way), 0.0 * tilt], axis=2)
        rise = np.stack([-np.sin(way), np.cos(way)], axis=2) * np.tan(tilt)[..., None]  # of the plane, by metre along x and y
        steep = np.linalg.norm(rise, axis=2)
        along = -rise / steep[..., None]
        tracks = read_surface(os.path.join(folder, "optimized.vtp"))

        def figure(downhill):
            slip = np.zeros((COUNT, FRAMES, 3))
            aside = random.normal(size=(COUNT, FRAMES, 1)) * along[..., ::-1] * [1.0, -1.0]
            slip[..., :2] = downhill[..., None] * along + aside
            slip[..., 2] = -random.uniform(size=(COUNT, FRAMES))
            sample_folder.add(tracks.GetPointData(), "Slip", slip.reshape(-1, 3))
            write_xml(tracks, os.path.join(folder, "optimized.vtp"))
            return measure(folder)[0]["glide"].value

        self.assertIn("no body glides", measure(folder)[0]["glide"].why)
        poses = write_poses(folder, turned, 0.2, 0.1)
        self.assertAlmostEqual(figure(0.3 * np.sin(2.0 * np.arctan(steep)) + 0.1), 1.0)
        self.assertAlmostEqual(figure(-0.3 * np.sin(2.0 * np.arctan(steep))), -1.0)
        self.assertLess(abs(figure(random.normal(size=tilt.shape))), 0.1)
        self.assertIn("does not say", measure(folder)[0]["agreement"].why)
        sample_folder.add(poses.GetFieldData(), "Agreement", [12.0, 50.0])
        write_xml(poses, os.path.join(folder, "poses.vtp"))
        measured = measure(folder)[0]
        figures = [(measured[key].value, measured[key].met) for key in ("agreement", "agreement_90")]
        self.assertEqual(figures, [(12.0, True), (50.0, False)])

    def test_centres_nearer_than_bodies_are_wide(self):
        positions = np.zeros((3, FRAMES, 3))
        positions[..., 2] = 1.0
        positions[1, :, 0] = 0.05 * np.arange(FRAMES)  # it leaves the first, and never comes to the third
        positions[2, :, 1] = 1.0
        folder = write_folder(os.path.join(WORK, "near"), positions)
        self.assertIn("ClearanceRadius", measure(folder)[0]["pairs"].why)
        write_poses(folder, np.tile([1.0, 0.0, 0.0, 0.0], (3, FRAMES, 1)), 0.2, 0.1)
        near = 4  # frames with less than 0.19 m between them
        self.assertAlmostEqual(measure(folder)[0]["pairs"].value, 2 * near / (3 * FRAMES))

    def test_a_drawing_is_read_of_the_silhouette_of_its_bodies(self):
        """A sheet that is as large as what is drawn, and flies level until it stands upright at its mark."""
        positions = np.repeat(places(2)[:, None], FRAMES, axis=1)
        positions[0] = 0.0, 0.0, 1.0
        folder = write_folder(os.path.join(WORK, "legible"), positions)
        scene = write_drawing(folder)
        write_folder_rows(folder, positions, frame=75, what=0, until=75, radius=0.0, which=[0])

        def figures(orientation):
            turned = np.zeros((2, FRAMES, 4))
            turned[..., 0] = 1.0
            turned[0, 60:] = orientation
            write_poses(folder, turned, 0.4, 0.2)
            measured = measure(folder, scene=scene)[0]
            return [measured[key] for key in ("legibility", "legibility_facing")]

        half = math.sqrt(0.5)
        own, facing = figures((half, half, 0.0, 0.0))
        self.assertAlmostEqual(own.value, 1.0)
        self.assertAlmostEqual(facing.value, 1.0)
        self.assertLess(own.drifters, 0.3, "level, it is seen as a line")
        self.assertIsNone(own.met, "nothing is asked of it")
        # Turned by 60 degrees about the vertical it shows half of its width: of pixels in the picture and 0.23 m around it, 100 of the 200.
        about = math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)
        own, facing = figures((about[0] * half, about[0] * half, about[1] * half, about[1] * half))
        share = 200.0 / (64 * 44)
        self.assertAlmostEqual(own.value, math.sqrt(0.5 * (1.0 - share) / (1.0 - 0.5 * share)))
        self.assertAlmostEqual(facing.value, 1.0)
        write_folder_rows(folder, positions, frame=75, what=0, until=75, radius=0.0, which=[0], facing=(0.0, -1.0, 0.0))
        own, _ = figures((1.0, 0.0, 0.0, 0.0))
        self.assertAlmostEqual(own.wanted[0], 0.5 * (own.drifters + 1.0), delta=1e-3)
        self.assertIs(own.met, False, "it stays as it flew")
        self.assertIs(figures((half, half, 0.0, 0.0))[0].met, True)
        # From aside it is seen as wide as it is, and the drawing with it.
        write_folder_rows(folder, positions, frame=75, what=0, until=75, radius=0.0, which=[0], facing=(1.0, -1.0, 0.0))
        self.assertAlmostEqual(figures((half, half, 0.0, 0.0))[0].value, 1.0)
        write_folder_rows(folder, positions, frame=75, what=0, until=75, radius=0.0, which=[0], facing=(1.0, 0.0, 0.0))
        self.assertIn("edge-on", figures((half, half, 0.0, 0.0))[0].why)
        self.assertIn("--scene", measure(folder)[0]["legibility"].why)
        write_folder_rows(folder, positions, frame=75, what=1, until=75, radius=0.0, which=[0])
        with self.assertRaisesRegex(BadInput, "no object at a target of /constraints/0"):
            measure(folder, scene=scene)
        with self.assertRaisesRegex(BadInput, "none.waft.json: expected a scene file"):
            measure(folder, scene="none.waft.json")

    def test_pixels_under_triangles(self):
        random = np.random.RandomState(4)
        corners = random.uniform(0.0, 30.0, (12, 1, 2)) + random.uniform(-6.0, 6.0, (12, 3, 2))
        corners[:4] = corners[:4, :1]  # without an area
        y, x = np.mgrid[:20, :30]
        wanted = np.zeros((20, 30), bool)
        for a, b, c in corners:
            turns = [(q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) for p, q in ((a, b), (b, c), (c, a))]
            wanted |= np.all(np.array(turns) > 0.0, axis=0) | np.all(np.array(turns) < 0.0, axis=0)
        self.assertTrue(np.array_equal(covered(corners, wanted.shape), wanted))
        self.assertTrue(0 < covered(corners[4:6], wanted.shape).sum() < wanted.sum())

    def test_a_given_path_is_no_flight(self):
        frames = np.array([*range(30, 41), 60])
        rows = {"ObjectId": np.zeros(12, int), "Frame": frames, "Kind": np.zeros(12, int), "Until": frames,
                "TouchDown": np.full(12, -1), "LiftOff": np.full(12, -1)}
        flying, free, _ = flight(rows, np.arange(1), FRAMES, RATE)
        self.assertEqual(list(np.flatnonzero(~flying[0])), [*range(30, 41)], "a mark alone is flown through")
        self.assertEqual(list(np.flatnonzero(free[0])), [*range(15, 22), 49, 50, 51, *range(69, 90)])

    @unittest.skipUnless(_two_sample.is_there(), "scikit-learn is not installed")
    def test_two_sample_auc(self):
        one, same, other = (flights(waves(24, f, seed=s)) for f, s in ((0.5, 1), (0.5, 2), (1.2, 3)))
        self.assertLess(_two_sample.area([one], [same]), 0.7)
        self.assertGreater(_two_sample.area([one], [other]), 0.95)

    def test_a_steady_drift_changes_no_feature(self):
        still = waves(6, 0.7)
        carried = still + np.arange(300)[None, :, None] / RATE * np.array([0.6, -0.2, 0.1])
        self.assertLess(np.abs(_two_sample.windows([flights(still)])[0] - _two_sample.windows([flights(carried)])[0]).max(), 1e-6)

    def test_drifters_come_back_from_their_file(self):
        path = waves(3, 0.8)
        back = _decoded(_encoded(list(path), 0, 0), 0, 0)
        self.assertLess(max(np.abs(a - b).max() for a, b in zip(path, back)), 0.51 * QUANTUM)

    def test_a_scene_is_measured_by_the_set_of_its_volume(self):
        default = Drifters()
        self.assertEqual(Drifters.fitting([0.5], default.bounds, 30.0).path, default.path)
        pillar = Drifters.fitting([0.5], [-2, 2, -2, 2, 0, 3], 25.0)
        self.assertTrue(pillar.path.endswith("leaves-pillar.npz"), pillar.path)
        self.assertEqual(pillar.lacks([0.5], [-2, 2, -2, 2, 0, 3], 25.0), [])
        self.assertEqual(Drifters.fitting([0.5], [-2, 2, -2, 2, 0, 3], 24.0).path, default.path)

    def test_drifters_are_made(self):
        path = os.path.join(WORK, "made.npz")
        os.makedirs(WORK, exist_ok=True)
        import waft.measuring._drifters as module

        scene = os.path.join(WORK, "drifting.waft.json")
        drifting = waft.Scene("Drifting")
        drifting.set_time(80)
        drifting.add_object("leaf", (0, 0, 2))
        drifting.add_box((-0.5, -0.5, 0), (0.5, 0.5, 3))
        drifting.add_wind((1, 0, 0), 0.5, (0, 0, 2), 1.0, 1.0, 1.0)
        drifting.save(scene)
        kept, module.RESOLUTION = module.RESOLUTION, 16
        try:
            make_drifters(path, [0.1], frames=80, airs=2, bodies=10, scene=scene, lattice=(9, 9, 9))
        finally:
            module.RESOLUTION = kept
        made = Drifters(path).airs([0.1])
        self.assertEqual(len(made), 2)
        self.assertGreater(_flights.variances(made)[0], 0.01)
        inside = np.all(np.abs(np.concatenate([air.positions for air in made])[..., :2]) < 0.45, axis=2)
        self.assertFalse((inside & (np.concatenate([air.positions for air in made])[..., 2] < 2.9)).any(), "in the box")
        self.assertEqual(Drifters(path).lattice, (9, 9, 9))
        self.assertGreater(Drifters(path).shells[1], Drifters(path).shells[6])
        self.assertEqual(os.listdir(WORK).count("made.npz.part"), 0)


def _untouched(path):
    """What is other after a change of a file, and not after a look at it."""
    about = os.lstat(path)
    return (*about[:7], about.st_mtime_ns)


class FolderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.air = turning_air()
        cls.path = cls.air.drift(places(COUNT), sinking(COUNT, SLIP, FRAMES), 0, FRAMES, RATE)
        cls.folder = write_folder(os.path.join(WORK, "passive"), cls.path, air=cls.air)

    def test_a_passive_motion(self):
        measured = measure(self.folder)[0]
        self.assertEqual(measured.objects, COUNT)
        self.assertLess(measured["private_hand"].value, 1e-3)
        self.assertLess(measured["replay"].value, 1e-3)
        self.assertTrue(measured["private_hand"].met)
        self.assertEqual(measured["witnesses_wind"].value, 0.0)
        self.assertLess(measured["one_air_along"].value, 1e-2)
        self.assertTrue(math.isnan(measured["hidden_hand_gas"].value))
        self.assertIn("no optimised gas", measured["hidden_hand_gas"].why)
        text = "\n".join(table(measured))
        self.assertIn("not measured: no optimised gas", text)

    def test_what_the_air_alone_brings_to_marks(self):
        mark = FRAMES - 2
        rows = {}
        for name, push in (("carried", 0.0), ("pushed", 0.1)):
            path = self.path.copy()  # a control along x in the second before the mark
            path[:, mark - 30:, 0] += push * np.arange(FRAMES - mark + 30) / RATE
            folder = write_folder(os.path.join(WORK, name), path, air=self.air, mark=mark, wind=np.where(np.arange(FRAMES) < mark - 30, 1, 3))
            rows[name] = measure(folder, tracks="assimilated")[0]
        self.assertLess(rows["carried"]["replay_whole_90"].value, 1e-4)
        self.assertLess(rows["carried"]["replay_last"].value, 1e-4)
        self.assertTrue(rows["carried"]["replay_last"].met)
        for key in ("replay_last", "replay_whole"):
            self.assertAlmostEqual(rows["pushed"][key].value, 0.1 / 4.0, delta=0.005)
        self.assertFalse(rows["pushed"]["replay_last_90"].met)
        speed = rms(np.concatenate([self.air.at(self.path[:, k], k / RATE) for k in range(FRAMES)]))
        self.assertLess(rows["carried"]["control_all"].value, 1e-3)
        beside = 0.1 * (np.arange(31) + 0.5) / RATE  # where the air turns otherwise
        pushed = np.sqrt(np.sum(0.1**2 + (SPIN * beside) ** 2) / (FRAMES - 1)) / speed
        self.assertAlmostEqual(rows["pushed"]["control"].value, pushed, delta=0.05 * pushed)
        self.assertAlmostEqual(rows["carried"]["rush"].value, 3.0 / ((mark - 30 + 3.0 * 32) / FRAMES), delta=0.01)
        for step in (3, 5):
            os.remove(os.path.join(WORK, "pushed", "air", f"air_{step:04d}.vti"))
        series = os.path.join(WORK, "pushed", "air.pvd")
        with open(series, encoding="utf-8") as stream:
            kept = [line for line in stream if "air_0003" not in line and "air_0005" not in line]
        with open(series, "w", encoding="utf-8") as stream:
            stream.writelines(kept)
        self.assertIn("--keep air", measure(os.path.join(WORK, "pushed"), tracks="assimilated")[0]["replay_last"].why)

    def test_an_air_that_gains_strength_is_seen(self):
        air = turning_air()
        self.assertAlmostEqual(measure(self.folder)[0]["stationary"].value, 1.0, places=3)
        air.velocity = air.velocity * np.where(np.arange(FRAMES) < 60, 1.0, 2.0)[:, None, None, None, None]
        folder = write_folder(os.path.join(WORK, "gaining"), self.path, air=air)
        row = measure(folder)[0]["stationary"]
        self.assertAlmostEqual(row.value, 1.0 / np.sqrt(6.0), places=2, msg="of Du/Dt, which goes with the square")
        self.assertFalse(row.met)

    def test_shells_are_of_the_waves_that_a_field_has(self):
        axis = np.arange(32) / 31.0
        field = np.zeros((32, 32, 32, 3))
        field[..., 0] = np.sin(2.0 * np.pi * 6.0 * axis)[:, None, None]
        energies = shells([field], np.full(3, 1.0 / 31.0))
        self.assertEqual(6, int(np.argmax(energies)))
        self.assertGreater(energies[5:8].sum(), 0.95 * energies.sum())
        self.assertAlmostEqual(energies.sum(), 0.5, delta=0.02)  # the mean square

    def test_what_sinks_after_its_last_mark(self):
        path = np.repeat(places(COUNT)[:, None], FRAMES, axis=1)
        path[..., 2] = 3.0 - 0.15 * np.arange(FRAMES) / RATE
        row = measure(write_folder(os.path.join(WORK, "sinking"), path, slip=0.2, mark=20), tracks="assimilated")[0]["sinking"]
        self.assertAlmostEqual(row.value, 0.75, places=6)
        self.assertFalse(row.met)

    def test_an_optimised_motion_says_what_it_is(self):
        said = {"ReplayError": 0.2, "GasReplayError": -1.0, "GasHiddenHand": 0.3}
        measured = measure(write_folder(os.path.join(WORK, "said"), self.path, air=self.air, said=said))[0]
        self.assertAlmostEqual(0.2, measured["replay"].value)
        self.assertTrue(measured["replay"].met)
        self.assertEqual(measured["drift"].value, measure(self.folder)[0]["replay"].value)
        self.assertIsNone(measured["drift"].met)
        self.assertAlmostEqual(0.3, measured["hidden_hand_gas"].value)
        self.assertFalse(measured["hidden_hand_gas"].met)

    def test_a_landing(self):
        path = np.repeat(places(COUNT)[:, None], FRAMES, axis=1)
        fall = np.minimum(np.arange(FRAMES), 60) / RATE * 0.5
        path[..., 2] = 1.0 - fall
        folder = write_folder(os.path.join(WORK, "landing"), path, slip=0.4, rest=60)
        measured = measure(folder)[0]
        self.assertAlmostEqual(measured["landing"].value, 1.25, places=6)
        self.assertEqual(measured["landing_times"].value, 0.0)
        self.assertEqual(measured["exact"].value, 0.0)
        self.assertFalse(measured["landing"].met)
        # A body that touches before its centre lies is measured until it lies.
        folder = write_folder(os.path.join(WORK, "touching"), path, slip=0.4, rest=55)
        self.assertAlmostEqual(measure(folder)[0]["landing"].value, 1.25, places=6)

    def test_few_objects_are_measured_over_time_and_pooled(self):
        folders = [write_folder(os.path.join(WORK, f"seed{seed}"), waves(2, 0.5, seed=seed)) for seed in range(3)]
        measured = measure(folders)
        self.assertEqual([one.name for one in measured], [*folders, "pooled"])
        self.assertGreater(measured[-1]["life_velocity"].value, 0.0)
        self.assertIn("its own mean", measured[-1]["life_velocity"].text)
        self.assertTrue(math.isnan(measured[-1]["one_air"].value))

    def test_the_command(self):
        out, err = io.StringIO(), io.StringIO()
        file = os.path.join(WORK, "rows.json")
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            self.assertEqual(cli.main(["measure", self.folder, "--json", file]), 0)
        self.assertIn("residual control (private hand)", out.getvalue())
        with open(file, encoding="utf-8") as stream:
            rows = {row["key"]: row for row in json.load(stream)[0]["rows"]}
        self.assertTrue(rows["private_hand"]["met"])
        self.assertIsNone(rows["hidden_hand_gas"]["value"])
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(cli.main(["measure", self.folder, "--tracks", "planned", "--json"]), 0)
        self.assertEqual(json.loads(out.getvalue())[0]["tracks"], "planned")

    def test_only_what_measure_wrote_is_replaced(self):
        place = os.path.join(WORK, "mine")
        shutil.rmtree(place, ignore_errors=True)
        os.makedirs(os.path.join(place, "folder"))
        for name in ("scene.waft.json", "rows.json", "made.npz", "passive-optimized.png"):
            with open(os.path.join(place, name), "w", encoding="utf-8") as stream:
                stream.write('{"waft": 1}' if name.endswith("waft.json") else "[]")
        os.symlink("nowhere", os.path.join(place, "lost"))
        os.mkfifo(os.path.join(place, "pipe"))

        def called(*arguments):
            said = io.StringIO()
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
                return cli.main(["measure", self.folder, *arguments]), said.getvalue()

        before = {name: _untouched(os.path.join(place, name)) for name in os.listdir(place)}
        for option, name in (("--json", "scene.waft.json"), ("--json", "rows.json"), ("--json", "folder"), ("--json", "lost"), ("--json", "pipe"),
                             ("--json", "none/rows.json"), ("--plots", ""), ("--plots", "rows.json"), ("--make-drifters", "made.npz"),
                             ("--make-drifters", "scene.waft.json"), ("--make-drifters", "folder"), ("--make-drifters", "lost")):
            with self.subTest(option, name=name):
                status, said = called(option, os.path.join(place, name))
                self.assertEqual(2, status, said)
                self.assertIn(name or "passive-optimized.png", said)
                self.assertEqual(before, {name: _untouched(os.path.join(place, name)) for name in os.listdir(place)})
        own = os.path.join(place, "own.json")
        for _ in range(2):
            self.assertEqual(0, called("--json", own)[0])
        with open(own, encoding="utf-8") as stream:
            text = stream.read()
        with open(own, "w", encoding="utf-8") as stream:
            stream.write(text.replace("private", "public"))
        self.assertEqual(2, called("--json", own)[0])

    def test_plots(self):
        plots = os.path.join(WORK, "plots")
        measured = measure(self.folder, plots=plots)[0]
        if not any("matplotlib" in note for note in measured.notes):
            path = os.path.join(plots, "passive-optimized.png")
            self.assertEqual(read_picture(path).GetDimensions()[:2], (1200, 680))
            measure(self.folder, plots=plots)  # takes the place of its own
            with open(path, "ab") as stream:
                stream.write(b"mine")
            with self.assertRaisesRegex(BadInput, "passive-optimized.png: Waft did not write it"):
                measure(self.folder, plots=plots)

    def test_a_scene_of_drifters_that_is_none_is_named(self):
        words, place = io.StringIO(), os.path.join(WORK, "nowhere.json")
        with contextlib.redirect_stderr(words):
            self.assertEqual(cli.main(["measure", self.folder, "--make-drifters", os.path.join(WORK, "x.npz"), "--scene", place]), 2)
        self.assertIn(f"{place}: expected a scene file", words.getvalue())

    def test_bad_input_is_named(self):
        def cut(name):
            def damage(folder):
                path = os.path.join(folder, name)
                os.truncate(path, os.path.getsize(path) // 2)
            return damage

        def lose(name):
            return lambda folder: os.remove(os.path.join(folder, name))

        def empty(folder):
            data = sample_folder._vertices(np.zeros((0, 3)))
            write_xml(data, os.path.join(folder, "optimized.vtp"))

        def spoil(folder):
            with open(os.path.join(folder, "air.pvd"), "w", encoding="utf-8") as file:
                file.write("junk")

        cases = ((cut("optimized.vtp"), "optimized.vtp"), (lose("optimized.vtp"), "optimized.vtp: missing"),
                 (lose("objects.vtp"), "objects.vtp: missing"), (empty, "optimized.vtp: expected one polyline per object"),
                 (spoil, "air.pvd: not a collection"), (cut("air/air_0003.vti"), "air_0003.vti"),
                 (lose("air/air_0004.vti"), "air_0004.vti"), (cut("objects.vtp"), "objects.vtp"))
        for number, (damage, wanted) in enumerate(cases):
            folder = os.path.join(WORK, f"damaged{number}")
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(self.folder, folder)
            damage(folder)
            words = io.StringIO()
            with self.subTest(wanted), contextlib.redirect_stderr(words):
                self.assertEqual(cli.main(["measure", folder]), 2)
                self.assertIn(wanted, words.getvalue())
                self.assertEqual(words.getvalue().strip().count("\n"), 0)
        for folder, wanted in ((os.path.join(WORK, "nowhere"), "no such folder"), (WORK, "optimized.vtp: missing")):
            with self.subTest(wanted), self.assertRaisesRegex(BadInput, wanted):
                measure(folder)
        with self.assertRaisesRegex(BadInput, "at least one folder"):
            measure([])
        with self.assertRaisesRegex(BadInput, "flown"):
            measure(self.folder, tracks="flown")
        with self.assertRaisesRegex(BadInput, "not a file of drifters"):
            measure(self.folder, drifters=os.path.join(self.folder, "optimized.vtp"))

    def test_the_folder_is_read(self):
        run = read_run(self.folder)
        self.assertTrue(np.array_equal(run.flights.positions, self.path))
        self.assertEqual(run.width, 4.0)
