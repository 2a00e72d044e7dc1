#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Takes digests of what scenes fly to: SHA-256 of poses.csv and of the decoded arrays of planned.vtp and optimized.vtp, for
previews of all scenes and ten of them in the other qualities, each with an empty store. Two lists made on one machine, before
and after a change that is to keep all motion, are equal.

    digests.py BUILD LIST.json [--quality Q,Q] [SCENE...]      flies what LIST.json lacks, and adds it
    digests.py --compare BEFORE.json AFTER.json                names what differs, or is in one alone; exit 1
"""
import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "Testing/Python"))
from result_files import PolyData  # noqa: E402

QUALITIES = ("preview", "air", "full", "paper")
# Each kind of body, mark, obstacle and wind is in one; none takes more than minutes.
TEN = ("bubbles-two-marks", "bubbles-stairs", "feather-waypoints", "feather-waypoints-b", "feather-maze", "feather-shaft",
       "leaves-in-wind", "scraps-doorway", "examples/feather-hand", "examples/leaves-gate")


def scenes():
    folder = ROOT / "Data/Scenes"
    return sorted(str(path.relative_to(folder))[:-len(".waft.json")] for path in folder.rglob("*.waft.json"))


def digest_of(path):
    if path.suffix == ".csv":
        return hashlib.sha256(path.read_bytes()).hexdigest()
    data = PolyData(path)
    content = {"points": data.points, "lines": data.lines, "point": data.point, "cell": data.cell, "field": data.field}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def fly(waft, scene, quality):
    """{file: digest} of one run; its exit status as "status"."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "out"
        environment = dict(os.environ, WAFT_CACHE=str(pathlib.Path(scratch) / "cache"), WAFT_DEFAULTS="off")
        status = subprocess.run([waft, "synthesize", ROOT / f"Data/Scenes/{scene}.waft.json", "--output", folder,
                                 "--quality", quality, "--quiet"], env=environment, stderr=subprocess.DEVNULL).returncode
        files = [folder / name for name in ("poses.csv", "planned.vtp", "optimized.vtp")]
        return {"status": status, **{path.name: digest_of(path) for path in files if path.exists()}}


def compare(before, after):
    lists = [json.loads(pathlib.Path(path).read_text()) for path in (before, after)]
    wrong = 0
    for key in sorted(set(lists[0]) | set(lists[1])):
        one, other = (part.get(key, {}) for part in lists)
        for name in sorted(set(one) | set(other)):
            if one.get(name) != other.get(name):
                print(f"{key}: {name}: {one.get(name)} before, {other.get(name)} after")
                wrong += 1
    print(f"{len(lists[0])} before, {len(lists[1])} after, {wrong} differ")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--quality", default=",".join(QUALITIES))
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("scenes", nargs="*")
    given = parser.parse_intermixed_args()
    if given.compare:
        return compare(given.first, given.second)
    written = pathlib.Path(given.second)
    digests = json.loads(written.read_text()) if written.exists() else {}
    for quality in given.quality.split(","):
        for scene in given.scenes or (scenes() if quality == "preview" else TEN):
            key = f"{scene} {quality}"
            if key in digests:
                continue
            digests[key] = fly(pathlib.Path(given.first) / "bin/waft", scene, quality)
            print(key, digests[key]["status"], digests[key].get("poses.csv", "-")[:8], flush=True)
            written.write_text(json.dumps(digests, indent=1, sort_keys=True) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
