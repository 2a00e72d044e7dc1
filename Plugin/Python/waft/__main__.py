# SPDX-License-Identifier: BSD-3-Clause
import sys

from waft.cli import main

sys.exit(main())
