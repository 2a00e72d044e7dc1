# SPDX-License-Identifier: BSD-3-Clause
"""Kinds of constraints, as the array `Kind` of Constraints numbers them."""
KINDS = ("position", "velocity", "acceleration", "orientation", "rest")
POSITION, VELOCITY, ACCELERATION, ORIENTATION, REST = range(len(KINDS))
POSITIONAL = (POSITION, REST)  # those that ask for a position
