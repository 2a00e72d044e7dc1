# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: written, begun, checked."""
from waft.scene.builder import Motion, Path, Quaternion, Scene, Vector

__all__ = ["Motion", "Path", "Quaternion", "Scene", "Vector"]
