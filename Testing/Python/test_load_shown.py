# SPDX-License-Identifier: BSD-3-Clause
"""A flight that waft.load gave in ParaView's views, and in its states, which show it again without flying.

    pvbatch run.py test_load_shown.py         on a screen
"""
import numpy as np
import test_load
import waft
from paraview import simple


class ShownTest(test_load.Base):
    def test_in_paraview_and_in_its_states(self):
        folder = self.copy()
        run = waft.load(folder)
        view = run.show()
        self.addCleanup(lambda: [simple.Delete(one) for one in simple.GetRenderViews()])
        self.assertEqual([view], waft.show(run))  # the same sources
        reader, = (source for source in simple.GetSources().values() if source not in self.stages())
        self.assertEqual({"Skins", "Faint Paths", "Scenery", "Rings"}, {str(one.Representation[0]) for one in view.Representations if one.Visibility})
        animation = simple.GetAnimationScene()
        self.assertEqual((41, run.times[-1]), (animation.NumberOfFrames, animation.EndTime))
        for frame in (0, 40):
            bodies = waft.fetch(reader, "Meshes", time=run.times[frame])
            posed = waft.fetch(self.flown.rotation, "Meshes", time=run.times[frame])
            np.testing.assert_allclose(bodies.GetBounds(), posed.GetBounds(), atol=1e-6)
            self.assertEqual(posed.GetNumberOfPoints(), bodies.GetNumberOfPoints())
        heights = [waft.fetch(reader, "Obstacles", time=run.times[frame]).GetBounds()[5] for frame in (0, 40)]
        self.assertAlmostEqual(0.4, heights[1] - heights[0], places=5)
        state = self.folder / "state.pvsm"
        simple.SaveState(str(state))
        run.delete()
        self.assertEqual(set(), {source for source in simple.GetSources().values() if source not in self.stages()})
        simple.LoadState(str(state))
        back, = (source for source in simple.GetSources().values() if source.SMProxy.GetXMLName() == "MotionResultsReader")
        again = waft.fetch(back, "Meshes", time=run.times[40])
        np.testing.assert_allclose(again.GetBounds(), bodies.GetBounds(), atol=1e-9)

    def stages(self):
        return [self.flown.reader, self.flown.planner, self.flown.assimilation, self.flown.rotation]
