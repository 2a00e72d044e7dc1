# SPDX-License-Identifier: BSD-3-Clause
import sys

from waft.cli import main
from waft.watching import note_stops

note_stops()
sys.exit(main())
