# SPDX-License-Identifier: BSD-3-Clause
"""Folders of results: put there whole or not at all, read, kept, cleaned, handed on."""
from waft.results.place import Busy, Entry, ResultPlace, check_folder, manifest_in, manifest_of, manifest_rows

__all__ = ["Busy", "Entry", "ResultPlace", "check_folder", "manifest_in", "manifest_of", "manifest_rows"]
