# SPDX-License-Identifier: BSD-3-Clause
"""The coverage curve of a motion database, from the table that `waft database` writes beside it.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_coverage_picture.py FILE.coverage.csv [coverage.png]
"""

import csv
import os
import sys

import numpy as np
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 (the rendering back end)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkViewsContext2D import vtkContextView

import waft  # noqa: F401 (its modules)
from waft.render._output import grab, write_png

GALLERY = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "gallery")
SIZE = (820, 420)
SAMPLES = 2  # pixels of the window, each way, that make one of the picture
NEIGHBOURS = 3  # each side, that the line is the mean of
EACH, MEAN, RULE = (0.16, 0.42, 0.66), (0.80, 0.33, 0.13), (0.45, 0.45, 0.45)
STOP = 5.0  # %, where the paper would stop


def read(path):
    """Simulations that were there before, and the share of the next one's segments that is new [%]."""
    with open(path, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return (np.array([float(row["Simulations"]) for row in rows]),
            100.0 * np.array([float(row["NewShare"]) for row in rows]))


def smoothed(values):
    """Means over as many neighbours on either side, fewer at the ends."""
    means = []
    for i in range(len(values)):
        reach = min(NEIGHBOURS, i, len(values) - 1 - i)
        means.append(values[i - reach:i + reach + 1].mean())
    return np.array(means)


def table_of(**columns):
    table = vtkTable()
    for name, values in columns.items():
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
        array.SetName(name)
        table.AddColumn(array)
    return table


def add(chart, kind, x, y, label, color, width):
    plot = chart.AddPlot(kind)
    plot.SetInputData(table_of(x=x, y=y), 0, 1)
    plot.SetLabel(label)
    plot.SetColorF(*color)
    plot.SetWidth(width * SAMPLES)
    return plot


def name_axis(axis, title, low, high):
    axis.SetTitle(title)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(low, high)
    axis.GetTitleProperties().SetFontSize(13 * SAMPLES)
    axis.GetTitleProperties().BoldOff()
    axis.GetLabelProperties().SetFontSize(12 * SAMPLES)
    axis.GetGridPen().SetColorF(0.9, 0.9, 0.9)


def main(source, target):
    before, share = read(source)
    chart = vtkChartXY()
    chart.SetShowLegend(True)
    points = add(chart, vtkChart.POINTS, before, share, "each simulation", EACH, 1.0)
    points.SetMarkerStyle(vtkPlotPoints.CIRCLE)
    points.SetMarkerSize(7 * SAMPLES)
    add(chart, vtkChart.LINE, before, smoothed(share), "mean of its neighbours", MEAN, 2.0)
    last = before[-1] + 1.0
    rule = add(chart, vtkChart.LINE, np.array([0.0, last]), np.full(2, STOP), "5 %", RULE, 1.0)
    rule.GetPen().SetLineType(2)  # dashes
    name_axis(chart.GetAxis(vtkAxis.BOTTOM), "simulations in the database", 0.0, last)
    name_axis(chart.GetAxis(vtkAxis.LEFT), "new segments of the next one [%]", 0.0, 100.0)
    chart.GetLegend().GetLabelProperties().SetFontSize(12 * SAMPLES)
    view = vtkContextView()
    view.GetRenderer().SetBackground(1.0, 1.0, 1.0)
    view.GetRenderWindow().SetOffScreenRendering(1)
    view.GetRenderWindow().SetMultiSamples(0)
    view.GetRenderWindow().SetSize(SIZE[0] * SAMPLES, SIZE[1] * SAMPLES)
    view.GetScene().AddItem(chart)
    view.GetRenderWindow().Render()
    write_png(grab(view.GetRenderWindow(), SAMPLES), target)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else os.path.join(GALLERY, "coverage.png"))
