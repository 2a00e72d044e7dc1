# SPDX-License-Identifier: BSD-3-Clause
"""Pictures compared by VTK's own means: vtkTesting with a baseline (-V), or one of its alternatives NAME_1.png, NAME_2.png...

Its error sums what is left of a pixel's difference beyond 105 of 765, within a pixel's shift. Renderers that cover the edges of
the same thing in different ways differ by nothing, and a body that has gone on differs once it has by two pixels and more: a camera
that is to see a frame go by is near."""
import os
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (vtkTesting reads pictures through it)
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkTestingRendering import vtkTesting

THRESHOLD = 1.0  # of the error, in whole pixels from black to white

# The default of VTK 9.4 is another error, which VTK 9.2 does not have.
os.environ["VTK_TESTING_IMAGE_COMPARE_METHOD"] = "LEGACY_VALID"


def error(drawn, kept):
    """Of a picture's file against a baseline; where it is over THRESHOLD, the picture, under the baseline's name, and their difference
    are in the folder `rejected` beside it. A baseline that is missing, or of another size, is an error without bound."""
    if not os.path.isfile(kept):
        return float("inf")
    rejected = os.path.join(os.path.dirname(os.path.abspath(drawn)), "rejected")
    os.makedirs(rejected, exist_ok=True)
    reader = vtkPNGReader()
    reader.SetFileName(str(drawn))
    testing = vtkTesting()
    for word in ("-V", os.path.abspath(kept), "-T", rejected):
        testing.AddArgument(word)
    sys.stdout.flush()
    passed = testing.RegressionTest(reader, THRESHOLD) == vtkTesting.PASSED
    found = testing.GetImageDifference()
    return found if passed or found > THRESHOLD else float("inf")


def agree(drawn, kept):
    return error(drawn, kept) <= THRESHOLD
