# SPDX-License-Identifier: BSD-3-Clause
"""Every proxy of the plugin: it can be made by its name, its Python attributes have the names of its
properties, everything is documented, and each default is the one of the VTK class, getter by getter. What
Core says of an option (default, range, sentence) is what the proxy shows and the VTK class keeps to.

    pvpython test_proxies.py XML_FOLDER DESCRIBE_OPTIONS PLUGIN_SOURCES"""

import contextlib
import glob
import itertools
import json
import os
import sqlite3
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

from paraview import servermanager, simple

import waft  # noqa: F401 (loads the plugin)
from waft import vtkWaftFilters, vtkWaftSources
from waft.scene._kinds import KINDS

XML, DESCRIBE_OPTIONS, PLUGIN = sys.argv[1:4]
sys.path.insert(0, PLUGIN)
import expand_options  # noqa: E402
HELP = os.path.join(os.path.dirname(XML), "paraview_help", "Waft.qch")
LARGE = 1e6  # from here on a panel need not name the end of a range
# What a class does with these by itself, before or beside the run of Core that its options describe.
OF_THE_CLASS_ALONE = {("vtkGridSmokeSource", "CacheLimit"), ("vtkMotionDatabaseSource", "TimeLimit"),
                      ("vtkVortexFitFilter", "SubtractWind"), ("vtkVortexFitFilter", "PriorFreedom"),
                      ("vtkMotionResultsReader", "FileName"), ("vtkMotionAnimationSource", "Edits"),
                      ("vtkLeafShapeSource", "TextureFile"), ("vtkFeatherShapeSource", "TextureFile")}
OF_ANY_STAGE = {"Active"}
NO_CHAIN = {"stages": [], "motion": []}
VALUES = ("IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty", "IdTypeVectorProperty")


def is_of_class(described):
    """Whether a property is one that the class of the proxy has; one without a command is the proxy's own."""
    return described.tag in VALUES and described.get("information_only") != "1" and described.get("command") is not None


def described_proxies():
    """(file, element) of each source, filter and writer that the plugin's XML files describe."""
    found = []
    for path in sorted(glob.glob(os.path.join(XML, "*.xml"))):
        for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
            found += [(os.path.basename(path), element) for element in group
                      if element.tag.endswith("Proxy") and group.get("name") != "representations"
                      and element.get("base_proxyname") is None]
    return found


def of_a_class():
    """Those with a VTK class of their own: all but those that join others, whose properties are theirs."""
    return [(path, element) for path, element in described_proxies() if element.get("class")]


def fresh_object(class_name):
    module = vtkWaftSources if hasattr(vtkWaftSources, class_name) else vtkWaftFilters
    return getattr(module, class_name)()


def as_list(value):
    """A getter's answer as a list: numbers and text side by side, nothing set as empty text."""
    if value is None:
        return [""]
    if isinstance(value, (tuple, list)):
        return list(value)
    return [int(value) if isinstance(value, bool) else value]


def default_of(proxy, name):
    """What a fresh proxy holds for a property, as a list."""
    held = proxy.SMProxy.GetProperty(name)
    return [held.GetElement(i) for i in range(held.GetNumberOfElements())]


def make(name):
    """A proxy by its name, as a script does it; inputs stay open."""
    simple.SetActiveSource(None)
    for group in (servermanager.sources, servermanager.filters, servermanager.writers):
        if hasattr(group, name):
            return getattr(group, name)
    raise AttributeError(f"no proxy {name}")


class ProxyTest(unittest.TestCase):
    def test_there_are_proxies(self):
        self.assertGreater(len(described_proxies()), 0)

    def test_each_is_in_paraview_simple(self):
        for path, element in described_proxies():
            with self.subTest(file=path, proxy=element.get("name")):
                self.assertTrue(callable(getattr(simple, element.get("name"), None)))

    def test_labels_keep_names(self):
        """ParaView makes the Python attribute from the label without its blanks."""
        for path, element in described_proxies():
            with self.subTest(file=path, proxy=element.get("name")):
                proxy = make(element.get("name"))()
                self.assertEqual(proxy.GetXMLName(), element.get("name"))
                attributes = proxy.ListProperties()
                for described in element:
                    if described.tag in VALUES and described.get("information_only") != "1":
                        self.assertIn(described.get("name"), attributes)

    def test_labels_are_words_of_the_menu(self):
        """Short ones, with an icon; scripts have a proxy by its label and by its own name."""
        for path, element in described_proxies():
            with self.subTest(file=path, proxy=element.get("name")):
                label = element.get("label")
                self.assertNotRegex(label, "(Source|Filter)$")
                self.assertTrue(callable(getattr(simple, label.replace(" ", ""), None)))
                menu = element.find("Hints/ShowInMenu")
                if menu is not None:
                    self.assertRegex(menu.get("icon", ""), r"^:/pqWidgets/Icons/\w+\.(svg|png)$")
                    self.assertRegex(menu.get("category"), "^Waft")

    def test_former_names_of_choices_are_for_scripts_alone(self):
        """A panel lists the last domain of a property."""
        animation = simple.WaftAnimation()
        held = animation.SMProxy.GetProperty("Quality")
        listed = held.GetDomain("enum")
        self.assertEqual([listed.GetEntryText(i) for i in range(listed.GetNumberOfEntries())],
                         ["Preview", "Air", "Full", "As in the 2005 paper"])
        for word, number, shown in (("Assimilated", 1, "Air"), ("Paper", 3, "As in the 2005 paper"), ("Full", 2, "Full")):
            animation.Quality = word
            self.assertEqual((held.GetElement(0), animation.Quality), (number, shown))

    def test_everything_is_documented(self):
        for path, element in described_proxies():
            for described in [element] + [p for p in element if p.tag.endswith("Property")]:
                if described.get("is_internal") == "1" or described.get("panel_visibility") == "never":
                    continue
                with self.subTest(file=path, name=described.get("name")):
                    text = described.find("Documentation")
                    self.assertIsNotNone(text, "no Documentation")
                    self.assertTrue((text.text or "").strip(), "empty Documentation")

    @unittest.skipUnless(os.path.exists(HELP), "this build makes no pages of help")
    def test_the_help_button_has_a_page_of_each(self):
        """Where ParaView's window looks for it: NAMESPACE/FOLDER/GROUP.NAME.html."""
        with contextlib.closing(sqlite3.connect(f"file:{HELP}?mode=ro", uri=True)) as pages:
            packed = dict(pages.execute("SELECT Name, Data FROM FileNameTable JOIN FileDataTable ON FileId = Id"))
            (space,), (folder,) = (pages.execute(f"SELECT Name FROM {table}").fetchone() for table in ("NamespaceTable", "FolderTable"))
        self.assertEqual((space, folder), ("Waft.org", "Waft"), "ParaView takes the first part of the one for the other")
        for path, element in described_proxies():
            name = element.get("name")
            with self.subTest(file=path, name=name):
                pages = [page for page in packed if page.endswith(f".{name}.html")]
                self.assertTrue(pages)
                for page in pages:
                    self.assertIsNotNone(servermanager.ProxyManager().GetPrototypeProxy(page.partition(".")[0], name), page)
                texts = [zlib.decompress(packed[page][4:]).decode("utf-8") for page in pages]  # its length is before it
                self.assertIn(element.find("Documentation").text.split()[0], "".join(texts))
                for row in "".join(texts).split("<tr>"):
                    self.assertLessEqual(row.count("is an enumeration"), 1, "the choices of a property once")

    def test_panels_speak_of_properties_that_are_there(self):
        groups = decorators = 0
        for path, element in described_proxies():
            own = {p.get("name"): p for p in element if p.tag.endswith("Property")}
            for group in element.findall("PropertyGroup"):
                groups += 1
                for member in group.findall("Property"):
                    with self.subTest(file=path, group=group.get("label")):
                        self.assertIn(member.get("name"), own)
            grouped = [member.get("name") for group in element.findall("PropertyGroup") for member in group.findall("Property")]
            self.assertEqual(len(grouped), len(set(grouped)), f"{path}: a property in two groups")
            for decorator in element.iter("PropertyWidgetDecorator"):
                decorators += 1
                with self.subTest(file=path, decorator=decorator.get("property")):
                    self.assertIn(decorator.get("property"), own)
                    decides = own[decorator.get("property")]
                    choices = [entry.get("value") for entry in decides.iter("Entry")] or ["0", "1"]
                    choices = ["null"] if decides.tag == "InputProperty" else choices
                    for value in (decorator.get("values") or decorator.get("value")).split():
                        self.assertIn(value, choices)
        self.assertGreater(groups, 15)
        self.assertGreater(decorators, 15)

    def test_panels_have_groups_by_what_people_turn(self):
        """A file comes first, and what is advanced is in a group."""
        for path, proxy in described_proxies():
            groups = [group for group in proxy.iter("PropertyGroup") if group.get("panel_widget") is None]
            names = [group.get("label") for group in groups]
            self.assertEqual(len(names), len(set(names)), path)
            for name in names:
                self.assertIn(name.partition(":")[0], ("Look", "Motion", "Limits", "Advanced"), path)
            grouped = {member.get("name") for group in proxy.iter("PropertyGroup") for member in group.iter("Property")}
            shown = [held for held in proxy if held.tag in VALUES and held.get("panel_visibility") != "never"
                     and held.get("information_only") != "1"]
            files = [held.get("name") for held in shown if held.get("name") == "FileName"]
            if files:
                self.assertEqual(shown[0].get("name"), "FileName", path)
            for held in shown:
                if held.get("panel_visibility") == "advanced":
                    self.assertIn(held.get("name"), grouped, path)
        scene = [held for path, proxy in described_proxies() if path == "WaftAnimation.xml" for held in proxy]
        self.assertEqual([held.findtext("Documentation") for held in scene if held.get("name") == "FileName"], ["Scene file"])

    def test_panels_show_nothing_that_is_told_by_the_tool_bar(self):
        for path, proxy in described_proxies():
            for held in proxy:
                if held.get("name") in ("EditsInUse", "Handles"):
                    self.assertEqual(held.get("panel_visibility"), "never", path)
                if held.get("name") == "Edits":  # scripts have nothing of what is never shown
                    self.assertEqual((held.get("panel_visibility"), held.find("Hints/PropertyWidgetDecorator").get("value")), ("advanced", ""))
                if held.get("name") in ("Complete", "WorkDone", "SecondsLeft", "Message"):  # Python has no attribute of what is never shown
                    self.assertEqual(held.get("panel_visibility"), "advanced", path)
                    decorator = held.find("Hints/PropertyWidgetDecorator")
                    self.assertEqual((decorator.get("property"), decorator.get("values"), decorator.get("inverse")), ("Complete", "0 1", "1"))

    def test_an_optional_input_can_be_taken_away(self):
        some = simple.Sphere()
        seen = 0
        for path, element in described_proxies():
            for described in element.findall("InputProperty"):
                if described.find("Hints/Optional") is None:
                    continue
                name = described.get("name")
                proxy = make(element.get("name"))()
                stage = proxy.GetClientSideObject()
                with self.subTest(proxy=path, input=name):
                    for source, count in ((some, 1), (None, 0), (some, 1)):
                        setattr(proxy, name, source)
                        proxy.UpdateVTKObjects()
                        ports = range(stage.GetNumberOfInputPorts())
                        self.assertEqual(count, sum(stage.GetNumberOfInputConnections(port) for port in ports))
                seen += 1
        self.assertGreater(seen, 10)

    def test_an_input_that_is_not_there_is_told_once_by_its_name(self):
        some = simple.Sphere()
        seen = 0
        for path, element in of_a_class():
            needed = [described.get("name") for described in element.findall("InputProperty") if described.find("Hints/Optional") is None]
            for count in range(len(needed) if element.tag == "SourceProxy" else 0):
                for given in itertools.combinations(needed, count):
                    simple.SetActiveSource(None)
                    proxy = make(element.get("name"))()
                    for name in given:
                        setattr(proxy, name, some)
                    proxy.UpdateVTKObjects()
                    stage = proxy.GetClientSideObject()
                    said = []
                    for speaker in (stage, stage.GetExecutive()):
                        speaker.AddObserver("ErrorEvent", lambda *_: said.append(stage.GetProgressText()))
                    with self.subTest(proxy=path, given=given):
                        for time in (0.0, 0.5, 0.5):
                            stage.UpdateTimeStep(time)
                        lacking = sorted(set(needed) - set(given))
                        self.assertEqual(len(said), 1)
                        self.assertTrue(said[0].endswith(": expected an input, found none"), said[0])
                        self.assertEqual(sorted(said[0].partition(":")[0].replace(" and ", ", ").split(", ")), lacking)
                    seen += 1
        self.assertGreater(seen, 30)

    def test_defaults_are_those_of_the_class(self):
        for path, element in of_a_class():
            proxy = make(element.get("name"))()
            proxy.UpdateVTKObjects()
            used = proxy.GetClientSideObject()
            fresh = fresh_object(element.get("class"))
            for described in element:
                if not is_of_class(described):
                    continue
                with self.subTest(file=path, property=described.get("name")):
                    self.check_property(proxy, described, used, fresh)

    def test_an_option_is_made_from_what_core_says_of_it(self):
        classes = {"vtkA": [{"name": "CoreRadius", "type": "real", "default": 0.25, "offered": [0, 2e9], "text": "How wide."},
                            {"name": "Smooth", "type": "flag", "default": 1.0, "offered": [0, 1], "text": "Whether."},
                            {"name": "Size", "type": "whole", "default": [4.0, 8.0], "offered": [1, 64], "text": "Voxels."}]}
        stated = """<G><P class="vtkA"><Option name="CoreRadius" panel_visibility="advanced"/><Option name="Smooth"><Hints/></Option>
            <Option name="Size"><D name="x"/><XDomain name="own"/><Documentation>Mine.</Documentation></Option></P></G>"""
        made = expand_options.expand(ElementTree.fromstring(stated), classes, NO_CHAIN)[0]
        radius, smooth, size = made
        self.assertEqual((radius.tag, dict(radius.attrib)), ("DoubleVectorProperty", {
            "name": "CoreRadius", "command": "SetCoreRadius", "label": "Core Radius", "number_of_elements": "1", "default_values": "0.25",
            "panel_visibility": "advanced"}))
        self.assertEqual((radius[0].tag, dict(radius[0].attrib), radius[1].text), ("DoubleRangeDomain", {"name": "range", "min": "0"}, "How wide."))
        self.assertEqual([child.tag for child in smooth], ["BooleanDomain", "Documentation", "Hints"])
        self.assertNotIn("label", smooth.attrib)
        self.assertEqual([child.tag for child in size], ["XDomain", "Documentation", "D"])
        self.assertEqual((size.get("default_values"), size.find("Documentation").text), ("4 8", "Mine."))
        with self.assertRaisesRegex(KeyError, "vtkA: Core states no option Other"):
            expand_options.expand(ElementTree.fromstring('<P class="vtkA"><Option name="Other"/></P>'), classes, NO_CHAIN)

    def test_ports_are_made_from_what_core_says_of_them(self):
        chain = {"stages": [{"proxy": "A", "takes": {"Tracks": ["vtkPolyData", True], "Shapes": ["vtkMultiBlockDataSet", False]},
                             "outputs": ["One", "Two"]}], "motion": ["Whole"]}
        stated = """<G><P name="A"><Input name="Shapes">Bodies.</Input><Input name="Tracks" command="SetPaths" port_index=""/><OutputPorts/></P>
            <P name="B"><Input name="Wind" type="vtkImageData" optional="1"/><OutputPorts/></P></G>"""
        stage, other = expand_options.expand(ElementTree.fromstring(stated), {}, chain)
        shapes, tracks, *ports = stage
        self.assertEqual({"name": "Shapes", "command": "SetInputConnection", "clean_command": "RemoveAllShapes", "port_index": "1"},
                         shapes.attrib)
        self.assertEqual(3, len(shapes.findall("DataTypeDomain/DataType")))
        self.assertIsNotNone(shapes.find("Hints/Optional"))
        self.assertEqual("Bodies.", shapes.find("Documentation").text)
        self.assertEqual({"name": "Tracks", "command": "SetPaths"}, tracks.attrib)
        self.assertIsNone(tracks.find("Hints"))
        self.assertEqual([("One", "0"), ("Two", "1")], [(port.get("name"), port.get("index")) for port in ports])
        self.assertEqual(["vtkImageData"], [one.get("value") for one in other[0].findall("DataTypeDomain/DataType")])
        self.assertIsNotNone(other[0].find("Hints/Optional"))
        self.assertEqual("Whole", other[1].get("name"))
        with self.assertRaisesRegex(KeyError, "Air"):
            expand_options.expand(ElementTree.fromstring('<P name="A"><Input name="Air"/></P>'), {}, chain)

    def test_a_panel_hides_what_has_no_effect(self):
        option = {"name": "Drag", "type": "real", "default": 1.0, "offered": [0, 9], "text": "How fast."}
        decorator = '<PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Air" value="null"%s />'
        for joined, ending in ((False, ""), (True, ' inverse="1"')):
            classes = {"vtkA": [{**option, "acts": {"input": "Air", "joined": joined}}]}
            for inside, kept in (("", ""), ("<Hints><Other /></Hints>", "<Other />")):
                made = expand_options.expand(ElementTree.fromstring(
                    f'<P class="vtkA"><Option name="Drag">{inside}</Option></P>'), classes, NO_CHAIN)
                self.assertEqual(f"<Hints>{kept}{decorator % ending}</Hints>",
                                 ElementTree.tostring(made.find("DoubleVectorProperty/Hints"), encoding="unicode"))

    def test_options_are_those_of_core(self):
        classes = json.loads(subprocess.run([DESCRIBE_OPTIONS], check=True, capture_output=True).stdout)
        for path, element in described_proxies():
            shown = {p.get("name"): p for p in element if p.tag in VALUES}
            for field in classes.pop(element.get("class"), []):
                with self.subTest(file=path, property=field["name"]):
                    self.check_option(field, shown[field["name"]], fresh_object(element.get("class")))
        self.assertEqual({}, classes, "options of no proxy")

    def test_every_option_is_said_in_core(self):
        classes = json.loads(subprocess.run([DESCRIBE_OPTIONS], check=True, capture_output=True).stdout)
        for path, element in of_a_class():
            own = element.get("class")
            said = {(own, field["name"]) for field in classes.get(own, [])} | OF_THE_CLASS_ALONE
            for described in element:
                if is_of_class(described) and described.get("name") not in OF_ANY_STAGE:
                    with self.subTest(file=path, property=described.get("name")):
                        self.assertIn((own, described.get("name")), said)

    def test_kinds_of_constraints_are_those_of_python(self):
        source, = (element for _, element in described_proxies() if element.get("name") == "ConstraintSource")
        kind, = (p for p in source if p.get("name") == "Kind")
        entries = {entry.get("text").lower(): int(entry.get("value")) for entry in kind.iter("Entry")}
        self.assertEqual(entries, {name: number for number, name in enumerate(KINDS)})

    def check_option(self, field, described, fresh):
        shown = described.get("default_values", "")
        if described.get("repeat_command") == "1":
            # A list has no setter of its own that could clamp; the class refuses it when it runs.
            self.assertEqual(field["default"], self.list_of(described, fresh))
            self.assertEqual(field["default"], [float(number) for number in shown.split()])
            return
        held = getattr(fresh, "Get" + field["name"])()
        self.assertEqual(field["default"], list(held) if isinstance(held, tuple) else held)
        if "range" not in field:
            return
        defaults = field["default"] if isinstance(field["default"], list) else [field["default"]]
        farthest = float(2**31 - 1) if described.tag == "IntVectorProperty" else sys.float_info.max
        offered, wanted = ([low, min(high, farthest)] for low, high in (field["offered"], field["range"]))
        for sign, end in zip((-1, 1), wanted):
            for reached in self.reach(field["name"], fresh, described, sign * farthest, len(defaults)):
                # What is not clamped at an end is refused when the class runs.
                self.assertTrue(reached == end or abs(reached) >= min(farthest, 1e299),
                                f"the class's setter goes to {reached}, expected {end}")
        domain = next((d for d in described if d.tag.endswith("RangeDomain")), None)
        if domain is not None:
            # A panel has no slider for a range without an end.
            unbounded = [min(offered[0], -LARGE), max(offered[1], LARGE)]
            for end, attribute, without in zip(offered, ("min", "max"), unbounded):
                for number in domain.get(attribute, str(without)).split():
                    self.assertEqual(end, float(number))
        else:
            entries = {entry.get("value") for entry in described.findall("EnumerationDomain/Entry")} or {0, 1}
            self.assertEqual(offered, [0, len(entries) - 1], "a number without a range domain")

    def reach(self, name, fresh, described, value, count):
        """What the class keeps of a number beyond all ranges, one for each that the property has."""
        if described.find("BooleanDomain") is not None:
            value = value > 0
        elif described.tag == "IntVectorProperty":
            value = int(value)
        getattr(fresh, "Set" + name)(*[value] * count)
        held = getattr(fresh, "Get" + name)()
        return [float(number) for number in (held if isinstance(held, tuple) else [held])]

    def list_of(self, described, fresh):
        """What the class holds for a list of tuples, [] when it has no getters for it."""
        counter = "Get" + described.get("set_number_command", "")[3:]
        if not described.get("default_values") or not hasattr(fresh, counter):
            return []
        wanted = []
        for index in range(getattr(fresh, counter)()):
            place = [0.0] * int(described.get("number_of_elements_per_command", "1"))
            getattr(fresh, "Get" + described.get("command")[3:])(index, place)
            wanted += place
        return wanted

    def check_property(self, proxy, described, used, fresh):
        command = described.get("command", "")
        self.assertTrue(command, "no command")
        self.assertTrue(hasattr(fresh, command), f"{fresh.GetClassName()} has no {command}")
        shown = default_of(proxy, described.get("name"))
        if described.get("repeat_command") == "1" or described.get("repeatable") == "1":
            self.assertEqual(shown, self.list_of(described, fresh), "the proxy's list is not the class's")
            return
        self.assertTrue(command.startswith("Set"), f"{command}: expected a setter")
        getter = "Get" + command[3:]
        self.assertTrue(hasattr(fresh, getter), f"{fresh.GetClassName()} has no {getter}")
        wanted = as_list(getattr(fresh, getter)())
        self.assertEqual(shown, wanted, "the proxy's default is not the class's")
        self.assertEqual(as_list(getattr(used, getter)()), wanted,
                         "the proxy's object does not start with the default")


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
