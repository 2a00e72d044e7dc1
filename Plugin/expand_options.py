# SPDX-License-Identifier: BSD-3-Clause
"""Makes the server manager's XML of proxies whose options and ports Core states: each <Option name="..."/> becomes the property of that
name, each <Input name="...">sentence</Input> the property of an input, <OutputPorts/> a port each.

    expand_options.py OPTIONS.json CHAIN.json IN.xml OUT.xml

Default, range, type and sentence are what Core says of the option (WaftDescribeOptions); an attribute or a child that stands in the
<Option> comes in place of what would be made, and others are handed on: what a panel is besides (visibility, widget, hints) is stated
by hand. A panel hides an option for as long as an input takes its effect away, and what is advanced and in no group comes in a last
group. The class of the proxy says whose options they are. What an input takes, and whether it is needed, says the chain, or the
<Input> itself of a proxy that is none of its stages (type, optional)."""
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

KINDS = {"flag": "IntVectorProperty", "whole": "IntVectorProperty", "real": "DoubleVectorProperty", "text": "StringVectorProperty"}
LARGE = 1e6  # from here on a panel need not name the end of a range


def number(value):
    """As an attribute has it: 3, 0.1, 1e+09."""
    return f"{value:.17g}" if float(f"{value:g}") != value else f"{value:g}"


def label_of(name):
    return re.sub("(?<=[a-z])(?=[A-Z])", " ", name)


def attributes_of(option):
    name, default = option["name"], option["default"]
    texts = [default] if option["type"] == "text" else map(number, default if isinstance(default, list) else [default])
    made = {"name": name, "command": f"Set{name}", "default_values": " ".join(texts),
            "number_of_elements": str(len(default)) if isinstance(default, list) else "1"}
    return made if label_of(name) == name else {**made, "label": label_of(name)}


def domain_of(option):
    """None of a text, which may be any."""
    if option["type"] == "text":
        return None
    if option["type"] == "flag":
        return ElementTree.Element("BooleanDomain", {"name": "bool"})
    kind = "IntRangeDomain" if option["type"] == "whole" else "DoubleRangeDomain"
    ends = {end: number(value) for end, value in zip(("min", "max"), option["offered"]) if abs(value) < LARGE}
    if isinstance(option["default"], list):
        ends = {end: " ".join(len(option["default"]) * [value]) for end, value in ends.items()}
    return ElementTree.Element(kind, {"name": "range", **ends})


def hide_without_effect(made, acts):
    """Beside what decorates a property by its hints already."""
    hints = made.find("Hints")
    if hints is None:
        hints = ElementTree.SubElement(made, "Hints")
    wanted = {"inverse": "1"} if acts["joined"] else {}
    ElementTree.SubElement(hints, "PropertyWidgetDecorator", {
        "type": "GenericDecorator", "mode": "visibility", "property": acts["input"], "value": "null", **wanted})


def property_of(option, stated):
    """The element of an option; stated: its <Option>."""
    made = ElementTree.Element(KINDS[option["type"]], {**attributes_of(option), **stated.attrib})
    children = list(stated)
    domains = [child for child in children if child.tag.endswith("Domain")]
    if not domains and domain_of(option) is not None and stated.get("repeat_command") is None:
        domains = [domain_of(option)]
    sentence = ElementTree.Element("Documentation")
    sentence.text = option["text"]
    own = stated.find("Documentation")
    rest = [child for child in children if child not in domains and child is not own]
    made.extend([*domains, sentence if own is None else own, *rest])
    if "acts" in option:
        hide_without_effect(made, option["acts"])
    return made


# Of data in blocks the domain asks for the blocks' type, as the stages do (Bridge/Pipeline/StageInputs.h); a list of shapes is blocks
# itself, of either kind.
BLOCKS = ("vtkMultiBlockDataSet", "vtkPartitionedDataSet", "vtkPartitionedDataSetCollection")


def input_of(stated, stage):
    """The element of an input; stated: its <Input>."""
    attributes = dict(stated.attrib)
    name, kind, is_needed = attributes["name"], attributes.pop("type", None), not attributes.pop("optional", None)
    if stage is not None:
        kind, is_needed = stage["takes"][name]
        attributes.setdefault("port_index", str(list(stage["takes"]).index(name)))
    cleans = {} if is_needed else {"clean_command": f"RemoveAll{name}"}
    made = ElementTree.Element("InputProperty", {"command": "SetInputConnection", **cleans,
                                                 **{key: value for key, value in attributes.items() if value}})
    groups = ElementTree.SubElement(made, "ProxyGroupDomain", {"name": "groups"})
    for group in ("sources", "filters"):
        ElementTree.SubElement(groups, "Group", {"name": group})
    types = BLOCKS if kind in BLOCKS else (kind,)
    domain = ElementTree.SubElement(made, "DataTypeDomain", {
        "name": "input_type", **({"composite_data_supported": "1"} if types is BLOCKS else {})})
    for one in types:
        ElementTree.SubElement(domain, "DataType", {"value": one})
    if not is_needed:
        ElementTree.SubElement(ElementTree.SubElement(made, "Hints"), "Optional")
    ElementTree.SubElement(made, "Documentation").text = stated.text
    return made


def ports_of(names):
    return [ElementTree.Element("OutputPort", {"name": name, "index": str(index)}) for index, name in enumerate(names)]


def group_advanced(proxy):
    """What is advanced and in no group of a panel comes in the last one, Advanced, which a proxy may have begun."""
    groups = proxy.findall("PropertyGroup")
    grouped = {member.get("name") for group in groups for member in group.findall("Property")}
    rest = [child.get("name") for child in proxy
            if child.get("panel_visibility") == "advanced" and child.get("information_only") != "1" and child.get("name") not in grouped]
    if not rest:
        return
    last = next((group for group in groups if group.get("label") == "Advanced"), None)
    if last is None:
        last = ElementTree.SubElement(proxy, "PropertyGroup", {"label": "Advanced"})
    for name in rest:
        ElementTree.SubElement(last, "Property", {"name": name})


def name_former(domain):
    """A panel lists what the last domain of a property (by name) has, scripts may say what the first has: there the former names are, too.
    The first has a namespace, which pages of help leave out and ParaView itself does not heed."""
    former = [entry for entry in domain if entry.attrib.pop("former", None)]
    for entry in former:
        domain.remove(entry)
    every = ElementTree.Element(domain.tag, {"name": "all", "xmlns": "former"})
    every.extend([*domain, *former])
    return [every, domain] if former else [domain]


def names_of_before(root):
    """Python makes its names from labels. Where these are others than the proxies' own, these are there, too: by a definition that no
    menu has, in the other group, so that what is made by it is of the same name."""
    other = {"sources": "filters", "filters": "sources"}
    for group in root.findall("ProxyGroup"):
        renamed = [proxy for proxy in group if proxy.get("class") and proxy.get("label", "").replace(" ", "") not in ("", proxy.get("name"))]
        if renamed:
            added = ElementTree.SubElement(root, "ProxyGroup", {"name": other[group.get("name")]})
            for proxy in renamed:
                former = ElementTree.SubElement(added, proxy.tag, {
                    "name": proxy.get("name"), "class": proxy.get("class"), "label": label_of(proxy.get("name")),
                    "base_proxygroup": group.get("name"), "base_proxyname": proxy.get("name")})
                hints = ElementTree.SubElement(former, "Hints")  # which no definition takes over from another
                hints.extend(hint for hint in proxy.find("Hints") if hint.tag != "ShowInMenu")


def expand(root, classes, chain):
    """Replaces all <Option>, <Input> and <OutputPorts> in a tree; raises KeyError where Core has no such option or input."""
    stages = {stage["proxy"]: stage for stage in chain["stages"]}
    for proxy in list(root.iter()):
        stage = stages.get(proxy.get("name"))
        options = {option["name"]: option for option in classes.get(proxy.get("class"), ())}
        for index, child in enumerate(list(proxy)):
            if child.tag == "Option":
                if child.get("name") not in options:
                    raise KeyError(f"{proxy.get('class')}: Core states no option {child.get('name')}")
                proxy[index] = property_of(options[child.get("name")], child)
                proxy[index].tail = child.tail
            elif child.tag == "Input":
                proxy[index] = input_of(child, stage)
                proxy[index].tail = child.tail
        ports = proxy.find("OutputPorts")
        if ports is not None:
            index = list(proxy).index(ports)
            proxy[index:index + 1] = ports_of(stage["outputs"] if stage is not None else chain["motion"])
        for held in proxy.findall("IntVectorProperty"):
            for domain in held.findall("EnumerationDomain"):
                place = list(held).index(domain)
                held[place:place + 1] = name_former(domain)
        if proxy.find("OutputPort") is not None:
            group_advanced(proxy)
    names_of_before(root)
    return root


def main(options, chain, source, target):
    classes, chain = (json.loads(pathlib.Path(path).read_text(encoding="utf-8")) for path in (options, chain))
    tree = ElementTree.parse(source)
    expand(tree.getroot(), classes, chain)
    tree.write(target, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
