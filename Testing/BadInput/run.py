# SPDX-License-Identifier: BSD-3-Clause
"""Every case of bad input, two processes side by side; a table by group, and each case that failed with its reason.

    run.py PVPYTHON GROUPS [PATTERN [EVERY]]      GROUPS: of json,values,...; PATTERN: only cases whose "group: name" it finds;
                                                  EVERY: of these every so many-th
"""
import collections
import json
import pathlib
import subprocess
import sys
import time

from judge import FAULTS

HERE = pathlib.Path(__file__).resolve().parent
WORKERS = 2


def results(pvpython, groups, pattern, every):
    """What became of each case; raises RuntimeError when a worker did not come to its end."""
    workers = [subprocess.Popen([pvpython, str(HERE / "worker.py"), str(first), str(WORKERS), groups, pattern, every],
                                stdout=subprocess.PIPE, text=True) for first in range(WORKERS)]
    found = []
    for worker in workers:
        text, _ = worker.communicate()
        found += [json.loads(line) for line in text.splitlines() if line.startswith("{")]
        if worker.returncode != 0:
            raise RuntimeError(f"a worker ended with {worker.returncode} after {len(found)} cases")
    return found


def table(found):
    groups = collections.defaultdict(list)
    for one in found:
        groups[one["group"]].append(one)
    groups["all"] = list(found)
    print(f"{'group':<13}{'cases':>7}{'passed':>8}" + "".join(f"{name:>12}" for name in FAULTS) + f"{'seconds':>9}")
    for group, members in groups.items():
        worst = collections.Counter(one["faults"][0][0] for one in members if one["faults"])
        print(f"{group:<13}{len(members):>7}{sum(not one['faults'] for one in members):>8}" +
              "".join(f"{worst[name] or '':>12}" for name in FAULTS) + f"{sum(one['seconds'] for one in members):>9.0f}")


def main(pvpython, groups, pattern=".", every="1"):
    began = time.monotonic()
    found = results(pvpython, groups, pattern, every)
    failed = [one for one in found if one["faults"]]
    for one in failed:
        for fault, why in one["faults"]:
            print(f"{one['group']}: {one['name'][:100]}: {fault}: {' '.join(why.split())[:400]}".encode(
                "ascii", "backslashreplace").decode())
    slow = sorted(found, key=lambda one: -one["seconds"])[:5]
    print("slowest: " + "; ".join(f"{one['group']}: {one['name'][:40]} {one['seconds']:.1f} s" for one in slow))
    table(found)
    print(f"{len(found) - len(failed)} of {len(found)} cases passed in {time.monotonic() - began:.0f} s")
    return 0 if found and not failed else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
