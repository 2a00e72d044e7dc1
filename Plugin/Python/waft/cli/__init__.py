# SPDX-License-Identifier: BSD-3-Clause
"""The command `waft`."""
from waft.cli.command import carry_out, main, parse, parser

__all__ = ["carry_out", "main", "parse", "parser"]
