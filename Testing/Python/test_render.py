# SPDX-License-Identifier: BSD-3-Clause
"""`waft render` on a small fixed folder: pictures equal to the ones kept in Data/Baseline, and
unlike the pictures one frame later and mirrored; files, movies and errors.

    pvbatch test_render.py BASELINE_FOLDER WORK_FOLDER [--update | --update=DRAWER]"""

import multiprocessing
import os
import pathlib
import shutil
import signal
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkCubeSource  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter  # noqa: E402

import picture  # noqa: E402
import sample_folder  # noqa: E402

from waft.failures import BadInput, WaftError  # noqa: E402
from waft.reading import read_surface  # noqa: E402
from waft.render import Stage, parse_frames, render  # noqa: E402
from waft.render._drawing import pictures, widest_window  # noqa: E402
from waft.render._flyers import _at_most  # noqa: E402
from waft.render._scenery import image  # noqa: E402
from waft.results._folder import load  # noqa: E402

BASELINE, WORK = sys.argv[1:3]
UPDATE = next((word for word in sys.argv[3:] if word.startswith("--update")), None)
DRAWER = f".{UPDATE.partition('=')[2]}" if UPDATE and "=" in UPDATE else ""
SIZE = (480, 270)
FRAME = 36
VIEWS = ("side", "top", "follow")


class RenderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        sample_folder.write(WORK)
        cls.written = render(WORK, frames=f"{FRAME}:{FRAME + 1}", size=SIZE, views=VIEWS, samples=1)

    def frame(self, view, frame):
        return os.path.join(WORK, "frames", f"{view}_{frame:04d}.png")

    def test_pictures_are_as_kept(self):
        for view in VIEWS:
            if UPDATE:
                shutil.copyfile(self.frame(view, FRAME), os.path.join(BASELINE, f"render_{view}{DRAWER}.png"))
            drawn = picture.read(self.frame(view, FRAME))
            wanted = picture.kept(os.path.join(BASELINE, f"render_{view}.png"), drawn)
            self.assertLessEqual(picture.differing(drawn, wanted), picture.FRACTION, view)
            later = picture.read(self.frame(view, FRAME + 1))
            self.assertFalse(picture.agree(later, wanted), f"{view}: one frame later passes")
            self.assertFalse(picture.agree(picture.mirrored(drawn), wanted), f"{view}: mirrored passes")

    def test_files(self):
        wanted = sorted(self.frame(view, k) for view in VIEWS for k in (FRAME, FRAME + 1))
        self.assertEqual(sorted(self.written), wanted)
        self.assertEqual(sorted(os.listdir(os.path.join(WORK, "frames"))),
                         [os.path.basename(path) for path in wanted])

    def test_a_frame_alone_equals_the_frame_in_a_row(self):
        place = WORK + "-alone"
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(WORK, place)
        shutil.rmtree(os.path.join(place, "frames"))
        render(place, frames=str(FRAME + 1), size=SIZE, views=VIEWS, samples=1)
        for view in VIEWS:
            alone = picture.read(os.path.join(place, "frames", f"{view}_{FRAME + 1:04d}.png"))
            row = picture.read(self.frame(view, FRAME + 1))
            self.assertEqual(abs(alone - row).max(), 0, view)

    def test_several_processes_draw_the_same_files(self):
        contents = []
        for jobs in (1, 3):
            place = f"{WORK}-jobs{jobs}"
            shutil.rmtree(place, ignore_errors=True)
            sample_folder.write(place)
            written = render(place, frames=f"{FRAME}:{FRAME + 4}", size=SIZE, views=VIEWS, samples=1, sheet=True, jobs=jobs)
            contents.append({os.path.relpath(path, place): pathlib.Path(path).read_bytes() for path in written})
        self.assertEqual(len(contents[0]), 5 * len(VIEWS) + len(VIEWS))
        self.assertEqual(contents[0], contents[1])

    def test_a_process_that_ends_before_its_time_is_reported(self):
        place = WORK + "-dies"
        os.makedirs(place, exist_ok=True)

        class Dying:
            def draw(self, view, frame):
                if frame == FRAME + 3:
                    os.kill(os.getpid(), signal.SIGKILL)
                if frame == FRAME + 4:
                    raise WaftError("no paint")
                return image(np.full((4, 4, 3), frame, np.uint8))

        def drawn(*frames):
            return pictures(Dying, [("side", frame, os.path.join(place, f"{frame}.png")) for frame in frames], 2, True)

        made = drawn(FRAME, FRAME + 1, FRAME + 2, FRAME + 3)
        for _ in range(3):
            next(made)
        with self.assertRaisesRegex(WaftError, "ended before its time .*-9"):
            next(made)
        with self.assertRaisesRegex(WaftError, "no paint"):
            list(drawn(FRAME, FRAME + 4))
        self.assertEqual(multiprocessing.active_children(), [])

    def test_samples_smooth_and_keep_the_picture(self):
        place = WORK + "-smooth"
        shutil.rmtree(place, ignore_errors=True)
        sample_folder.write(place)
        render(place, frames=str(FRAME), size=SIZE, views="side", samples=2)
        smooth = picture.read(os.path.join(place, "frames", f"side_{FRAME:04d}.png"))
        jagged = picture.read(self.frame("side", FRAME))
        self.assertEqual(smooth.shape, jagged.shape)
        # Outlines differ, surfaces do not.
        self.assertLess(picture.differing(smooth, jagged), 0.05)
        self.assertFalse(picture.agree(smooth, jagged))

    def test_movie(self):
        shutil.rmtree(WORK + "-movie", ignore_errors=True)
        os.makedirs(WORK + "-movie")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(WORK + "-movie")
        place = "take:1"  # a name that programs would take for a protocol
        sample_folder.write(place)
        written = render(place, frames="0::12", size=(160, 90), views="top", movie=True, samples=1)
        self.assertIn(os.path.join(place, "top.ogv"), written)
        with open(os.path.join(place, "top.ogv"), "rb") as movie:
            self.assertEqual(movie.read(4), b"OggS")
        self.assertIn(os.path.join(place, "top.avi"), written)
        with open(os.path.join(place, "top.avi"), "rb") as movie:
            head = movie.read(12)
        self.assertEqual((head[:4], head[8:]), (b"RIFF", b"AVI "))
        left = [name for _, _, names in os.walk(place) for name in names if name.endswith(".part")]
        self.assertEqual(left, [])

    def test_frames(self):
        self.assertEqual(list(parse_frames(None, 4)), [0, 1, 2, 3])
        self.assertEqual(list(parse_frames("1:3", 4)), [1, 2, 3])
        self.assertEqual(list(parse_frames("0:99:2", 4)), [0, 2])
        self.assertEqual(list(parse_frames("2", 4)), [2])
        self.assertEqual(list(parse_frames("::3", 4)), [0, 3])
        for bad in ("4", "-1:2", "3:1", "0:3:0", "a:b", "0:1:2:3", "0:3:-1", "1.5"):
            with self.assertRaises(BadInput, msg=bad) as caught:
                parse_frames(bad, 4)
            self.assertIn(bad, str(caught.exception))

    def test_bad_folders_and_arguments(self):
        empty = WORK + "-empty"
        shutil.rmtree(empty, ignore_errors=True)
        os.makedirs(empty)
        with self.assertRaisesRegex(BadInput, "poses.vtp"):
            render(empty)
        self.assertEqual(os.listdir(empty), [])
        with self.assertRaisesRegex(BadInput, "below"):
            render(WORK, views=("below",))
        with self.assertRaisesRegex(BadInput, "size"):
            render(WORK, size=(0, 100))
        screen = os.environ.pop("DISPLAY")
        try:
            with self.assertRaisesRegex(WaftError, "xvfb-run"):
                render(WORK)
        finally:
            os.environ["DISPLAY"] = screen

    def test_sizes_that_cannot_be_drawn_are_refused_before_anything_is_touched(self):
        before = sorted(os.listdir(WORK))
        widest = widest_window()
        for size, samples, shutter, wanted in (
                ((16384, 16384), 2, 0.0, "16384x16384: expected pictures of at most 16.8 million pixels with 2 x 2 samples each, found 268"),
                ((16384, 8192), 1, 0.0, "at most 67.1 million pixels with 1 x 1"), ((8192, 8192), 2, 0.5, "at most 33.6 million"),
                ((16384, 16), widest // 16384 + 1, 0.0, f"at most {widest // (widest // 16384 + 1)} pixels a side, found 16384")):
            with self.subTest(wanted), self.assertRaisesRegex(BadInput, wanted):
                render(WORK, size=size, samples=samples, shutter=shutter)
        self.assertEqual(sorted(os.listdir(WORK)), before)

    def test_a_sheet_of_pictures_of_any_form(self):
        place = WORK + "-sheet"
        shutil.rmtree(place, ignore_errors=True)
        sample_folder.write(place)
        for size in ((4096, 16), (16, 2000)):
            written = render(place, frames="0:1", size=size, views="side", samples=1, sheet=True, targets=False)
            self.assertGreater(os.path.getsize(written[-1]), 100)

    def test_damaged_folders_are_named_by_file(self):
        def lose_blocks(place):
            shutil.rmtree(os.path.join(place, "shapes"))

        def spoil(name):
            def damage(place):
                with open(os.path.join(place, name), "w", encoding="utf-8") as file:
                    file.write("junk")
            return damage

        cases = ((spoil("poses.vtp"), "poses.vtp: expected a VTK"), (spoil("objects.vtp"), "objects.vtp: expected a VTK"),
                 (spoil("shapes.vtm"), "shapes.vtm: expected"), (lose_blocks, "shapes.vtm: block leaf: no such file"),
                 (spoil("obstacles.pvd"), "obstacles.pvd: not a collection"))
        for number, (damage, wanted) in enumerate(cases):
            place = f"{WORK}-damaged{number}"
            shutil.rmtree(place, ignore_errors=True)
            sample_folder.write(place)
            damage(place)
            with self.subTest(wanted), self.assertRaisesRegex(BadInput, wanted):
                render(place)

    def test_files_of_a_folder_that_are_cut_are_named(self):
        names = ("poses.vtp", "objects.vtp", "shapes.vtm", "obstacles.vtp", "constraints.vtp")
        for number, name in enumerate(names):
            place = f"{WORK}-cut{number}"
            shutil.rmtree(place, ignore_errors=True)
            sample_folder.write(place)
            path = os.path.join(place, name)
            os.truncate(path, os.path.getsize(path) // 2)
            with self.subTest(name), self.assertRaisesRegex(BadInput, f"{name}: "):
                render(place)

    def test_obstacles_of_points_that_are_not_there_are_named(self):
        place = WORK + "-beyond"
        shutil.rmtree(place, ignore_errors=True)
        sample_folder.write(place)
        path = os.path.join(place, "obstacles.vtp")
        surface = read_surface(path)
        beyond = surface.GetNumberOfPoints()
        surface.GetPolys().GetConnectivityArray().SetComponent(4, 0, beyond)
        writer = vtkXMLPolyDataWriter()
        writer.SetDataModeToBinary()
        writer.SetInputData(surface)
        writer.SetFileName(path)
        self.assertTrue(writer.Write())
        with self.assertRaisesRegex(BadInput, f"obstacles.vtp: .*found {beyond}$"):
            render(place)

    def test_a_tint_colours_the_texture(self):
        def drawn(name, **changes):
            place = f"{WORK}-{name}"
            shutil.rmtree(place, ignore_errors=True)
            sample_folder.write(place, **changes)
            written = render(place, frames=str(FRAME), size=SIZE, views="follow", samples=1, targets=False)
            return picture.read(written[0]).astype(float)

        plain, blue = drawn("plain"), drawn("tint", tint=(0.1, 0.1, 1.0))
        leaf = abs(plain - blue).max(axis=2) > 30.0
        self.assertGreater(leaf.sum(), 50)
        # Red and green fall, blue stays; light that is thrown back has no tint.
        self.assertLess(blue[leaf][:, 0].mean(), 0.5 * plain[leaf][:, 0].mean())
        self.assertAlmostEqual(blue[leaf][:, 2].mean(), plain[leaf][:, 2].mean(), delta=3.0)

    def test_a_large_texture_is_averaged_down(self):
        image = vtkImageData()
        image.SetDimensions(9000, 10, 1)
        image.AllocateScalars(VTK_UNSIGNED_CHAR, 1)
        image.GetPointData().GetScalars().Fill(200)
        small = _at_most(image, 4096)
        self.assertEqual(small.GetDimensions(), (3000, 3, 1))
        self.assertEqual(small.GetScalarRange(), (200.0, 200.0))
        self.assertIs(_at_most(image, 9000), image)

    def test_one_sees_through_obstacles_that_hide_the_motion(self):
        motion = load(WORK)
        low, high = motion.positions.min(axis=(0, 1)), motion.positions.max(axis=(0, 1))
        wall = vtkCubeSource()  # in front of all, as the side view looks along y
        wall.SetBounds(low[0] - 1.0, high[0] + 1.0, low[1] - 0.5, low[1] - 0.4, 0.0, high[2] + 1.0)
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(wall.GetOutputPort())
        triangles.Update()
        motion.obstacles = [(0.0, triangles.GetOutput())]

        def drawn(view, **options):
            taken = Stage(motion, SIZE, 1, **options).draw(view, FRAME).GetPointData().GetScalars()
            return vtk_to_numpy(taken).astype(int)

        clear = abs(drawn("side") - drawn("side", obstacle_opacity=1.0)).max(axis=1)
        self.assertGreater((clear > 8).mean(), 0.3)
        same = abs(drawn("top") - drawn("top", obstacle_opacity=1.0))
        self.assertEqual(same.max(), 0)
        with self.assertRaisesRegex(BadInput, "opacity"):
            render(WORK, obstacle_opacity=1.5)

    def test_a_missing_texture_is_named_and_replaced(self):
        place = WORK + "-plain"
        shutil.rmtree(place, ignore_errors=True)
        sample_folder.write(place)
        os.remove(os.path.join(place, "leaf.png"))
        render(place, frames="0", size=(160, 90), views="side", samples=1)
        self.assertTrue(os.path.isfile(os.path.join(place, "frames", "side_0000.png")))

    def test_nothing_half_written_when_it_breaks(self):
        place = WORK + "-broken"
        shutil.rmtree(place, ignore_errors=True)
        sample_folder.write(place)

        def stop(part, text):
            if part > 0.5:
                raise InterruptedError(text)

        with self.assertRaises(InterruptedError):
            render(place, frames="0:9:3", size=(160, 90), views="top", movie=True, samples=1,
                   progress=stop)
        self.assertFalse(os.path.exists(os.path.join(place, "top.ogv")))
        left = [name for _, _, names in os.walk(place) for name in names if name.endswith(".part")]
        self.assertEqual(left, [])


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    # pvbatch keeps its own exit status unless told.
    sys.stdout.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)
