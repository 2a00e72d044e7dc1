# SPDX-License-Identifier: BSD-3-Clause
"""How soon each stage of a scene ends when it is asked to, and how long it says nothing.

    pvpython benchmark_aborts.py SCENE [QUALITY [SECONDS...]]

QUALITY: full by default. Each stage runs once to its end, and once for each of the moments SECONDS (of its processor time, by
default ten spread over that of the run to its end) at which it is asked to stop. A line a stage: processor seconds of the run,
the longest time without a progress event by the clock, and from the question to the end by processor and by the clock.
"""
import sys
import time

import waft


class Watch:
    """The times of a stage's progress events; it asks the stage to stop once its processor time has come."""

    def __init__(self, algorithm, moment=None):
        self.began = self.last = time.monotonic()
        self.processor = time.process_time()
        self.gap, self.asked, self.moment = 0.0, None, moment
        self.algorithm = algorithm
        self.tag = algorithm.AddObserver("ProgressEvent", self.see)

    def see(self, *_):
        now = time.monotonic()
        self.gap, self.last = max(self.gap, now - self.last), now
        if self.asked is None and self.moment is not None and time.process_time() - self.processor >= self.moment:
            self.asked = now, time.process_time()
            self.algorithm.SetAbortExecute(1)

    def close(self):
        self.algorithm.RemoveObserver(self.tag)
        self.gap = max(self.gap, time.monotonic() - self.last)
        self.algorithm.SetAbortExecute(0)
        return time.process_time() - self.processor


def run(algorithm, moment=None):
    algorithm.Modified()
    watch = Watch(algorithm, moment)
    algorithm.Update()
    return watch, watch.close()


def main(scene, quality="full", *seconds):
    made = waft.synthesize(scene, quality=quality)
    for name in ("planner", "assimilation", "spacetime", "rotation"):
        proxy = getattr(made, name, None)
        if proxy is None:
            continue
        algorithm = proxy.GetClientSideObject()
        if hasattr(algorithm, "Restart"):
            algorithm.Restart()
        whole, processor = run(algorithm)
        moments = [float(second) for second in seconds] or [processor * (k + 0.5) / 10 for k in range(10)]
        waits = []
        for moment in moments:
            if hasattr(algorithm, "Restart"):
                algorithm.Restart()
            watch, _ = run(algorithm, moment)
            if watch.asked:
                waits.append((time.process_time() - watch.asked[1], time.monotonic() - watch.asked[0]))
        waits = waits or [(float("nan"),) * 2]
        print(f"{name:14s} {processor:6.1f} CPU-s, longest silence {whole.gap:5.2f} s; ends {max(wait[0] for wait in waits):5.2f} CPU-s, "
              f"{max(wait[1] for wait in waits):5.2f} s after it is asked to (most of {len(waits)})", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
