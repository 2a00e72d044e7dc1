# SPDX-License-Identifier: BSD-3-Clause
"""The add-on for Blender as a zip file that Blender installs: `waft blender-addon`."""
import zipfile

from waft.failures import InputError, WaftError
from waft.files import check_target, whole_file
from waft.loading import addon_folder
from waft.reading import read_bytes

_DATE = (1980, 1, 1, 0, 0, 0)  # of each file, so that the same add-on is the same file


def write_addon(path):
    """Writes the add-on as FILE.zip. Raises InputError where there is a file, or no such folder; WaftError without the add-on."""
    check_target(path)
    if not path.endswith(".zip"):
        raise InputError(f"{path}: expected a name that ends with .zip")
    folder = addon_folder()
    if folder is None:
        raise WaftError("the add-on for Blender is not among the files of this Waft")
    with whole_file(path) as part, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
        for source in sorted(folder.glob("*.py")):
            archive.writestr(zipfile.ZipInfo(f"{folder.name}/{source.name}", _DATE), read_bytes(source), zipfile.ZIP_DEFLATED)
