# SPDX-License-Identifier: BSD-3-Clause
"""The curves of the add-on for Blender, in what stands for actions of its versions: from 4.4 on an action has slots, each with a bag of
curves, and from 5.0 on none of its own.

    test_slots.py CURVES.py                                     the add-on's curves.py
"""
import copy
import importlib.util
import sys
import types
import unittest
import unittest.mock

import numpy as np

CURVES = sys.argv.pop(1)
PREFIXES = {"OBJECT": "OB", "MESH": "ME", "UNSPECIFIED": "XX"}
PLACES = {"location": np.arange(12.0).reshape(4, 3)}


def curves_in(version):
    """The module as a version of Blender loads it."""
    spec = importlib.util.spec_from_file_location("curves", CURVES)
    module = importlib.util.module_from_spec(spec)
    with unittest.mock.patch.dict(sys.modules, bpy=types.SimpleNamespace(app=types.SimpleNamespace(version=version))):
        spec.loader.exec_module(module)
    return module


class Keys(list):
    def add(self, count):
        self.extend(types.SimpleNamespace(co=[0.0, 0.0], interpolation=0) for _ in range(count))

    def foreach_set(self, name, values):
        for key, value in zip(self, np.reshape(values, (len(self), -1)).tolist()):
            setattr(key, name, value)


class Curves(list):
    """Curves of a bag, or of an action before 4.4."""

    def new(self, data_path, *, index=0):
        if any((curve.data_path, curve.array_index) == (data_path, index) for curve in self):
            raise RuntimeError(f"{data_path}[{index}] is there already")
        self.append(types.SimpleNamespace(data_path=data_path, array_index=index, keyframe_points=Keys(), update=lambda: None))
        return self[-1]


class Slot:
    def __init__(self, id_type, name):
        self.target_id_type = id_type
        self.name_display = name

    @property
    def identifier(self):
        return PREFIXES[self.target_id_type] + self.name_display


class Slots(list):
    def new(self, id_type, name):
        taken = [slot.identifier for slot in self]
        while PREFIXES[id_type] + name in taken:
            name += ".001"
        self.append(Slot(id_type, name))
        return self[-1]


class Strip:
    def __init__(self):
        self.channelbags = []

    def channelbag(self, slot, *, ensure=False):
        for bag in self.channelbags:
            if bag.slot is slot:
                return bag
        if ensure:
            self.channelbags.append(types.SimpleNamespace(slot=slot, fcurves=Curves()))
            return self.channelbags[-1]
        return None


class Strips(list):
    def new(self, *, type):
        assert type == "KEYFRAME"
        self.append(Strip())
        return self[-1]


class Layers(list):
    def new(self, name):
        self.append(types.SimpleNamespace(name=name, strips=Strips()))
        return self[-1]


class Action:
    """An action of Blender 5. slots: (type, name) of each, with the data paths that it has curves of."""

    def __init__(self, slots=()):
        self.slots, self.layers = Slots(), Layers()
        for (id_type, name), paths in dict(slots).items():
            slot = self.slots.new(id_type, name)
            strip = self.layers[0].strips[0] if self.layers else self.layers.new("Layer").strips.new(type="KEYFRAME")
            for path in paths:
                strip.channelbag(slot, ensure=True).fcurves.new(path)

    @property
    def fcurves(self):
        raise AttributeError("'Action' object has no attribute 'fcurves'")

    def copy(self):
        return copy.deepcopy(self)

    def paths(self):
        """{identifier of a slot: data paths of its curves}"""
        bags = [bag for layer in self.layers for strip in layer.strips for bag in strip.channelbags]
        return {bag.slot.identifier: [curve.data_path for curve in bag.fcurves] for bag in bags}


class AnimData:
    """The animation data of an object; a strip of the NLA likewise."""

    def __init__(self, action=None, slot=None):
        self.drivers, self.nla_tracks, self.use_nla, self.mute = [], [], True, False
        self.action = action
        self.action_slot = slot

    @property
    def action(self):
        return self._action

    @action.setter
    def action(self, action):
        self._action = action
        self._slot = action.slots[0] if action is not None and len(action.slots) else None  # Blender takes some slot by itself

    @property
    def action_slot(self):
        return self._slot

    @action_slot.setter
    def action_slot(self, slot):
        if slot is not None:
            assert any(one is slot for one in self._action.slots), "a slot of another action"
            assert slot.target_id_type in ("OBJECT", "UNSPECIFIED"), "a slot for other data"
            slot.target_id_type = "OBJECT"
        self._slot = slot


class EarlierAction:
    """An action of Blender 4.3, whose slots have another interface and are not in use."""

    def __init__(self):
        self.fcurves = Curves()

    @property
    def slots(self):
        raise AssertionError("slots of Blender 4.3 are not those of 4.4")

    layers = slots


def thing(name, action=None, slot=None):
    return types.SimpleNamespace(name=name, animation_data=AnimData(action, slot))


def paths(curves):
    return [curve.data_path for curve in curves]


class SlotsOfActions(unittest.TestCase):
    def setUp(self):
        self.curves = curves_in((5, 0, 0))

    def fly(self, leaf):
        """The action of a take of an object, shown, as takes.py makes it."""
        own, slot = leaf.animation_data.action, self.curves.slot_of(leaf)
        action = own.copy() if own else Action()
        self.curves.play(leaf, action, self.curves.replace_curves(action, leaf, PLACES, 1, slot))
        return action

    def test_objects_that_share_an_action(self):
        shared = Action({("OBJECT", "One"): ["location", "color"], ("OBJECT", "Other"): ["scale"], ("MESH", "One"): ["auto"]})
        one, other = thing("One", shared, shared.slots[0]), thing("Other", shared, shared.slots[1])
        self.assertEqual(["location", "color"], paths(self.curves.curves_of(one)))
        self.assertEqual(["scale"], paths(self.curves.curves_of(other)))
        for curve, frames in zip((*self.curves.curves_of(one), *self.curves.curves_of(other)), ((3, 7), (5,), (9,))):
            curve.keyframe_points.add(len(frames))
            curve.keyframe_points.foreach_set("co", [value for frame in frames for value in (frame, 0.0)])
        both = ("location", "scale")
        self.assertEqual(([3, 7], [9]), (self.curves.key_frames(one, both), self.curves.key_frames(other, both)))
        before = shared.paths()
        for leaf, kept in ((one, ["color"]), (other, ["scale"])):
            slot = self.curves.slot_of(leaf)
            self.assertEqual(f"OB{leaf.name}", slot)
            take = self.fly(leaf)
            self.assertEqual(kept + ["location"] * 3, paths(self.curves.curves_of(leaf)))
            self.assertEqual([1, 2, 3, 4], self.curves.key_frames(leaf, ("location",)))
            self.assertEqual({**before, slot: kept + ["location"] * 3}, take.paths())
            self.curves.play(leaf, shared, slot)
        self.assertEqual(before, shared.paths())
        self.assertEqual((shared.slots[0], shared.slots[1]), (one.animation_data.action_slot, other.animation_data.action_slot))

    def test_an_action_without_a_slot(self):
        """It does not animate its object, nor do its slots in a take, and comes back so, although one of them would suit."""
        own = Action({("OBJECT", "Leaf"): ["delta_location"]})
        leaf = thing("Leaf", own)
        slot = self.curves.slot_of(leaf)
        self.assertEqual([], self.curves.curves_of(leaf))
        self.assertFalse(self.curves.has_motion(leaf))
        take = self.fly(leaf)
        self.assertEqual(["location"] * 3, paths(self.curves.curves_of(leaf)))
        self.assertEqual({"OBLeaf": ["delta_location"], "OBLeaf.001": ["location"] * 3}, take.paths())
        self.curves.play(leaf, own, slot)
        self.assertEqual((own, None), (leaf.animation_data.action, leaf.animation_data.action_slot))

    def test_reading_makes_nothing(self):
        action = Action()
        leaf = thing("Leaf", action, action.slots.new("OBJECT", "Leaf"))
        self.assertEqual(([], "OBLeaf"), (self.curves.curves_of(leaf), self.curves.slot_of(leaf)))
        self.assertEqual([], action.layers)
        for nothing in (thing("Leaf"), types.SimpleNamespace(animation_data=None)):
            self.assertEqual(([], ""), (self.curves.curves_of(nothing), self.curves.slot_of(nothing)))
        self.assertFalse(self.curves.has_motion(None))

    def test_keys_go_into_the_slot_of_the_object(self):
        for slots, own, wanted in (((), "", "OBLeaf"), ([("MESH", "Leaf")], "", "OBLeaf"),
                                   ([("OBJECT", "Old name"), ("OBJECT", "Leaf")], "OBOld name", "OBOld name"),
                                   ([("OBJECT", "Renamed"), ("MESH", "Leaf")], "OBLeaf", "OBRenamed")):
            action = Action(dict.fromkeys(slots, ()))
            leaf = thing("Leaf")
            for _ in range(2):  # once more, in their place
                slot = self.curves.replace_curves(action, leaf, PLACES, 1, own)
                self.curves.play(leaf, action, slot)
                self.assertEqual((wanted, wanted), (slot, leaf.animation_data.action_slot.identifier))
                self.assertEqual({wanted: ["location"] * 3}, action.paths())
                own = slot
        self.curves.play(leaf, None)
        self.assertIsNone(leaf.animation_data.action)

    def test_files_of_before_slots(self):
        """Their actions get one slot, whose name depends on the language, and no object has kept its identifier."""
        for id_type in ("OBJECT", "UNSPECIFIED"):
            own = Action({(id_type, "Früherer Slot"): ["color"]})
            leaf = thing("Leaf")
            self.curves.play(leaf, own, "")
            self.assertEqual(["color"], paths(self.curves.curves_of(leaf)))
            own = Action({(id_type, "Früherer Slot"): ["color"]})
            slot = self.curves.replace_curves(own, leaf, PLACES, 1, "")
            self.curves.play(leaf, own, slot)
            self.assertEqual(["color"] + ["location"] * 3, paths(self.curves.curves_of(leaf)))
            self.assertEqual(slot, leaf.animation_data.action_slot.identifier)

    def test_strips_count_by_their_slots(self):
        shared = Action({("OBJECT", "One"): ["location"], ("OBJECT", "Other"): ["delta_location"]})
        leaf = thing("One")
        strips = [AnimData(shared, shared.slots[0]), AnimData(shared), AnimData()]
        leaf.animation_data.nla_tracks = [types.SimpleNamespace(mute=False, strips=strips)]
        self.assertEqual({"location"}, self.curves.nla_paths(leaf))


class EarlierActions(unittest.TestCase):
    def test_actions_without_slots(self):
        for version in ((3, 4, 1), (4, 3, 2)):
            curves = curves_in(version)
            action = EarlierAction()
            action.fcurves.new("color")
            leaf = types.SimpleNamespace(name="Leaf", animation_data=types.SimpleNamespace(action=None))
            self.assertEqual(([], ""), (curves.curves_of(leaf), curves.slot_of(leaf)))
            self.assertEqual("", curves.replace_curves(action, leaf, PLACES, 1))
            curves.play(leaf, action)
            self.assertEqual(["color"] + ["location"] * 3, paths(curves.curves_of(leaf)))
            self.assertEqual(("", [1, 2, 3, 4]), (curves.slot_of(leaf), curves.key_frames(leaf, ("location",))))


if __name__ == "__main__":
    unittest.main(verbosity=2)
