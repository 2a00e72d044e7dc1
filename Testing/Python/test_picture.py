# SPDX-License-Identifier: BSD-3-Clause
"""The comparisons of pictures themselves: what they take for equal and what not."""

import os
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import baseline  # noqa: E402
import picture  # noqa: E402


def write(pixels, path):
    data = vtkImageData()
    data.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    flat = np.ascontiguousarray(pixels.reshape(-1, 3), np.uint8)
    data.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.Write()


class PictureTest(unittest.TestCase):
    def setUp(self):
        self.plain = np.full((50, 100, 3), 100)

    def changed(self, count, by):
        other = self.plain.copy()
        other.reshape(-1, 3)[:count, 1] += by
        return other

    def test_small_differences_everywhere_agree(self):
        self.assertTrue(picture.agree(self.plain, self.changed(5000, 8)))
        self.assertFalse(picture.agree(self.plain, self.changed(5000, -9)))

    def test_large_differences_in_few_pixels_agree(self):
        self.assertTrue(picture.agree(self.plain, self.changed(5, 100)))
        self.assertFalse(picture.agree(self.plain, self.changed(6, 100)))

    def test_sizes_must_be_equal(self):
        self.assertFalse(picture.agree(self.plain, self.plain[:49]))
        self.assertFalse(picture.agree(self.plain, self.plain.transpose(1, 0, 2)))

    def test_mirrored(self):
        self.assertTrue(picture.agree(self.plain, picture.mirrored(self.plain)))
        striped = self.plain.copy()
        striped[:, :10] = 0
        self.assertFalse(picture.agree(striped, picture.mirrored(striped)))
        self.assertTrue(np.array_equal(picture.mirrored(striped)[0, -1], striped[0, 0]))

    def test_files_and_exit_status(self):
        with tempfile.TemporaryDirectory() as folder:
            first, same, other = (os.path.join(folder, n) for n in ("a.png", "b.png", "c.png"))
            write(self.plain, first)
            write(self.changed(5000, 3), same)
            write(self.changed(50, 60), other)
            self.assertTrue(np.array_equal(picture.read(first), self.plain))
            for path, status in ((same, 0), (other, 1)):
                self.assertEqual(picture.main(first, path), status)
        with self.assertRaises(FileNotFoundError):
            picture.read(os.path.join(folder, "a.png"))

    def test_baselines_and_their_alternatives(self):
        moved = self.plain.copy()
        moved[10:30, 10:14] = 255
        with tempfile.TemporaryDirectory() as folder:
            drawn, kept, other = (os.path.join(folder, n) for n in ("drawn.png", "kept.png", "kept_1.png"))
            write(moved, drawn)
            self.assertEqual(baseline.error(drawn, kept), float("inf"), "a baseline that is not there")
            write(self.changed(5000, 20), kept)
            self.assertFalse(baseline.agree(drawn, kept))
            self.assertAlmostEqual(baseline.error(drawn, kept), 12.9, delta=0.1)  # 2 x 18 of 4 x 20 pixels are no shift's
            write(np.roll(moved, 1, axis=1), other)
            self.assertTrue(baseline.agree(drawn, kept), "the alternative, of a pixel's shift")
            write(np.roll(moved, 4, axis=1), other)
            self.assertFalse(baseline.agree(drawn, kept))
            write(self.plain[:25], kept)
            os.remove(other)
            self.assertFalse(baseline.agree(drawn, kept), "another size")
