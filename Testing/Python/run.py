# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts of tests one after the other, each in a fork of one process that has ParaView and Waft loaded, whose start takes longer
than most of them.

    pvpython run.py SCRIPT [ARGUMENT...] [-- SCRIPT [ARGUMENT...]]...       pvbatch on a display, for those that draw
"""
import importlib
import itertools
import os
import pathlib
import sys
import unittest

import warm


def passes(script, arguments):
    """In a fork: whether all tests of the script pass. It has none of what others made, and leaves nothing to them."""
    sys.argv = [script, *arguments]
    tests = unittest.defaultTestLoader.loadTestsFromModule(importlib.import_module(pathlib.Path(script).stem))
    return tests.countTestCases() > 0 and unittest.TextTestRunner().run(tests).wasSuccessful()


def main(words):
    warm.load()
    failed = []
    for is_end, group in itertools.groupby(words, lambda word: word == "--"):
        if is_end:
            continue
        script, *arguments = group
        print(f"{script}:", file=sys.stderr, flush=True)
        child = os.fork()
        if child == 0:
            status = 1
            try:
                status = int(not passes(script, arguments))
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(status)  # views of many kinds end in any order, and pvbatch keeps its own status
        if os.waitpid(child, 0)[1] != 0:
            failed.append(script)
    print("failed:", ", ".join(failed) or "none", file=sys.stderr)
    sys.stderr.flush()
    os._exit(bool(failed))


main(sys.argv[1:])
