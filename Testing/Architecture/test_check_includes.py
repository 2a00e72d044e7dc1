#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each rule of check_includes.py rejects a planted violation and accepts the clean file beside it."""
import pathlib
import tempfile
import unittest

import check_includes


class Rules(unittest.TestCase):
    def violations(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return [reason for _, _, reason in check_includes.check(root)]

    def test_clean_tree(self):
        self.assertEqual([], self.violations({
            "Filters/Core/Grid/Solver.cxx": '#include "Base/Types.h"\n#include "Grid/Solver.h"\n#include <vector>\n',
            "Filters/Motion/vtkAFilter.h": "",
            "Filters/Motion/vtkAFilter.cxx": '#include "vtkAFilter.h"\n#include <vtkPolyData.h>\n',
        }))

    def test_core_sees_no_vtk(self):
        found = self.violations({"Filters/Core/Grid/Solver.cxx": "#include <vtkPolyData.h>\n"})
        self.assertEqual(["Core includes VTK: vtkPolyData.h"], found)

    def test_libraries_keep_their_order(self):
        found = self.violations({"Filters/Core/Grid/Solver.h": '#include "Planning/Planner.h"\n'})
        self.assertEqual(["Grid may not include Planning: Planning/Planner.h"], found)

    def test_third_party_stays_with_its_owner(self):
        found = self.violations({"Filters/Core/Planning/Planner.cxx": "#include <CGAL/AABB_tree.h>\n"})
        self.assertEqual(1, len(found))

    def test_wrappers_do_not_include_each_other(self):
        found = self.violations({
            "Sources/vtkASource.h": "",
            "Filters/Motion/vtkBFilter.cxx": '#include "vtkASource.h"\n',
        })
        self.assertEqual(["includes the wrapper vtkASource.h"], found)

    def test_folders_of_bridge_keep_their_order(self):
        files = {"Filters/Bridge/Pipeline/A.h": '#include "Bridge/Data/B.h"\n',
                 "Filters/Bridge/Files/C.h": '#include "Bridge/Data/B.h"\n#include "Base/Types.h"\n',
                 "Filters/Bridge/Data/B.h": ""}
        self.assertEqual([], self.violations(files))
        files["Filters/Bridge/Data/B.h"] = '#include "Bridge/Files/C.h"\n'
        self.assertEqual(["Bridge/Data may not include Bridge/Files: Bridge/Files/C.h"], self.violations(files))
        files["Filters/Bridge/Data/B.h"] = '#include "Bridge/D.h"\n'
        self.assertEqual(1, len(self.violations(files)))
        self.assertEqual(1, len(self.violations({"Filters/Bridge/D.h": "\n"})))

    def test_a_name_belongs_to_one_class(self):
        files = {"Filters/Core/Grid/A.h": "namespace waft\n{\nclass Solver\n{\n};\n}\n",
                 "Filters/Core/Air/Field/B.h": "namespace waft\n{\nclass Solver;\nclass Solvers\n{\n};\n}\n"}
        self.assertEqual([], self.violations(files))
        files["Filters/Core/Air/Field/B.h"] = "namespace waft\n{\nclass Solver : public Base\n{\n};\n}\n"
        self.assertEqual(["Solver is defined in B.h too"], self.violations(files))

    def test_folders_of_a_library_keep_their_order(self):
        files = {"Filters/Core/Spacetime/Energy/A.h": '#include "Spacetime/Model/B.h"\n#include "Base/Types.h"\n',
                 "Filters/Core/Spacetime/Run/C.h": '#include "Spacetime/Energy/A.h"\n#include "Spacetime/Run/D.h"\n',
                 "Filters/Core/Spacetime/Model/B.h": ""}
        self.assertEqual([], self.violations(files))
        files["Filters/Core/Spacetime/Model/B.h"] = '#include "Spacetime/Energy/A.h"\n'
        self.assertEqual(["Spacetime/Model may not include Spacetime/Energy: Spacetime/Energy/A.h"],
                         self.violations(files))
        self.assertEqual(1, len(self.violations({"Filters/Core/Spacetime/E.h": "\n"})))

    def test_unknown_library(self):
        self.assertEqual(1, len(self.violations({"Filters/Core/Misc/A.h": "\n"})))

    def test_python_modules_import_in_no_circle(self):
        files = {"Plugin/Python/waft/a.py": "from waft import b\n",
                 "Plugin/Python/waft/b.py": "def late():\n    from .c import d\n",
                 "Plugin/Python/waft/c.py": "import os\n"}
        self.assertEqual([], self.violations(files))
        files["Plugin/Python/waft/c.py"] = "import waft.a\n"
        self.assertEqual(["imports in a circle: a -> b -> c -> a"], self.violations(files))

    def test_python_modules_of_packages_import_in_no_circle(self):
        files = {"Plugin/Python/waft/a/__init__.py": "from waft.a.main import act\n",
                 "Plugin/Python/waft/a/main.py": "from waft.a import parts\n",
                 "Plugin/Python/waft/a/parts.py": "import os\n"}
        self.assertEqual([], self.violations(files))
        files["Plugin/Python/waft/a/parts.py"] = "from waft.a import act\n"
        self.assertEqual(["imports in a circle: a -> a.main -> a.parts -> a"], self.violations(files))

    def test_files_are_opened_by_their_owners_alone(self):
        clean = ("from waft.reading import read_text\nread_text(path)\nreading.read_bytes(path)\nScene.load(path)\n"
                 "np.load(io.BytesIO(content))\njson.loads(text)\njson.dump(rows, sys.stdout)\n")
        self.assertEqual([], self.violations({"Plugin/Python/waft/a.py": clean, "Plugin/Python/waft/reading.py": "open(path)\n"}))
        for line in ("open(path)", "open(path, 'w')", "io.open(path)", "os.open(path, 0)", "path.read_text()", "Path(path).read_bytes()",
                     "path.write_text(text)", "json.load(stream)", "np.load(path)", "ElementTree.parse(path)", "np.loadtxt(path)",
                     "vtkXMLPolyDataReader()", "Image.open(path)", "shutil.copyfile(a, b)", "os.replace(a, b)", "os.remove(a)",
                     "path.unlink()", "shutil.rmtree(folder)"):
            with self.subTest(line):
                self.assertEqual(1, len(self.violations({"Plugin/Python/waft/a.py": line + "\n"})))

    def test_results_are_read_by_accessors(self):
        files = {"Plugin/Python/waft/results/_folder.py": "from waft.results._arrays import array_of\narray_of(data, 'A', 'place')\n",
                 "Plugin/Python/waft/run.py": "data.GetArray('A')\n"}
        self.assertEqual([], self.violations(files))
        files["Plugin/Python/waft/results/_folder.py"] += "data.GetArray('A')\n"
        self.assertEqual(["reads results by GetArray: expected an accessor of _arrays, _records or _tables"], self.violations(files))


if __name__ == "__main__":
    unittest.main()
