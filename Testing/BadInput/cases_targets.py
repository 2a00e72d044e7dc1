# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and fonts that are damaged, too large or none."""
import re
import struct
import zlib

import good_files as good
from case import LEAF, scene_case

TWO = LEAF | {"objects": [{"shape": "leaf", "positions": [[0.0, 0.0, 2.0], [0.5, 0.0, 2.0]]}]}
PLACE = {"origin": [0.0, 0.0, 1.7], "u": [1.0, 0.0, 0.0], "v": [0.0, 0.0, 1.0], "width": 0.8}


def _targets(**what):
    return TWO | {"constraints": [{"kind": "keyframe", "frame": 30, "radius": 0.5, "targets": what | PLACE}]}


def damaged_pngs():
    whole = good.png()
    compressed = zlib.compress(b"\x00" * (8 * (12 * 4 + 1)))
    at_checksum = whole.index(b"IDAT") + 4 + struct.unpack(">I", whole[whole.index(b"IDAT") - 4:whole.index(b"IDAT")])[0]
    yield "signature alone", whole[:8]
    yield "cut in the header", whole[:20]
    yield "cut behind the header", whole[:33]
    yield "cut in the data", whole[:whole.index(b"IDAT") + 10]
    yield "cut before its end", whole[:-12]
    yield "wrong checksum of the data", whole[:at_checksum] + b"\x00\x01\x02\x03" + whole[at_checksum + 4:]
    yield "wrong checksum of the header", whole[:29] + b"\x00\x01\x02\x03" + whole[33:]
    yield "no pixels", good.png(claimed=(0, 0))
    yield "2^31-1 squared", good.png(claimed=(2 ** 31 - 1, 2 ** 31 - 1))
    yield "2^32-1 wide", good.png(claimed=(2 ** 32 - 1, 1))
    yield "20000 x 20000 with nothing behind", good.png(claimed=(20000, 20000))
    yield "6000 x 6000 of 8 bytes", good.png(claimed=(6000, 6000), depth=16)
    yield "too little data", good.png(scanlines=b"\x00" * 20)
    yield "damaged compression", good.png(data=b"\x00" * 8 + compressed[8:])
    yield "no compression at all", good.png(data=b"pixels")
    yield "no data", good.png(data=b"")
    yield "depth 3", good.png(depth=3)
    yield "colour type 5", good.png(colours=5)
    yield "palette missing", good.png(colours=3)
    yield "palette of one", good.png(colours=3, before=good.chunk(b"PLTE", b"\x00\x00"))
    yield "header of 12 bytes", good.png(header=bytes(12))
    yield "unknown critical chunk", good.png(before=good.chunk(b"ABCD", b"1234"))
    yield "a chunk of 2^31 bytes", whole[:33] + struct.pack(">I", 2 ** 31) + b"tEXt" + whole[33:]
    yield "an unknown filter", good.png(scanlines=b"\x09" * (8 * (12 * 4 + 1)))


def damaged_others():
    for suffix, content in ((".jpg", good.jpg()), (".tif", good.tif()), (".bmp", good.bmp())):
        yield f"junk{suffix}", b"this is no picture"
        yield f"empty{suffix}", b""
        yield f"cut at 3 bytes{suffix}", content[:3]
        yield f"cut at 30 bytes{suffix}", content[:30]
        yield f"cut in half{suffix}", content[:len(content) // 2]
        yield f"zeros behind the signature{suffix}", content[:4] + bytes(len(content))
    start = re.search(rb"\xff[\xc0\xc2]\x00\x11\x08", good.jpg()).end()  # of height and width
    yield "65535 squared.jpg", good.jpg()[:start] + b"\xff\xff\xff\xff" + good.jpg()[start + 4:]
    yield "inks.jpg", good.jpg()[:start + 4] + b"\x04" + good.jpg()[start + 5:]
    yield "no pixels.jpg", good.jpg()[:start] + bytes(4) + good.jpg()[start + 4:]
    yield "2^31-1 squared.bmp", good.bmp(claimed=(2 ** 31 - 1, 2 ** 31 - 1))
    yield "20000 squared.bmp", good.bmp(claimed=(20000, 20000))
    yield "no pixels.bmp", good.bmp(claimed=(0, 0))
    yield "a width below 0.bmp", good.bmp(claimed=(-12, 8))
    yield "7 bits.bmp", good.bmp(bits=7)
    yield "data beyond its end.bmp", good.bmp(offset=10 ** 9)
    yield "directory beyond its end.tif", good.tif()[:4] + struct.pack("<I", 10 ** 9) + good.tif()[8:]


# Letters that a font lacks, and those that would stand wrongly.
TEXTS = (
    ("serif", "\u010cAJ", "'\u010c' (U+010C)"),
    ("mono", "50 \u20ac", "(U+20AC)"),
    ("sans", "A\u2192B", "(U+2192)"),
    ("sans", "\u041c\u0418\u0420", "(U+041C)", "(U+0418)", "(U+0420)"),
    ("sans", "LOVE\U0001f342YOU", "(U+1F342)"),
    ("sans", "\u05e9\u05dc\u05d5\u05dd", "(U+05E9)", "from right to left"),
    ("sans", "\u0645\u0631\u062d\u0628\u0627", "(U+0645)", "from right to left"),
    ("sans", "\u0928\u092e\u0938\u094d\u0924\u0947", "(U+0928)", "join"),
    ("sans", "x\u030c", "(U+030C)"),
    ("sans", "a\u202eb", "U+202E"),
    ("sans", "a\tb", "U+0009"),
)


def _other_formats():
    yield "scan.mhd", b"ObjectType = Image\nNDims = 2\nDimSize = 4 4\nElementType = MET_UCHAR\nElementDataFile = /etc/passwd\n"
    yield "huge.mhd", b"ObjectType = Image\nNDims = 2\nDimSize = 40000 40000\nElementType = MET_UCHAR\nElementDataFile = scan.raw\n"
    yield "picture.pnm", b"P6\n99999999 99999999\n255\n"
    yield "picture.pgm", b"P5\n4 4\n255\n" + bytes(16)
    yield "picture.hdr", b"#?RADIANCE\n\n-Y 4 +X 4\n" + bytes(64)
    yield "picture.gif", b"GIF89a" + bytes(20)
    yield "picture.dcm", bytes(128) + b"DICM" + bytes(64)
    yield "picture", good.png()
    yield "picture.txt", good.png()
    yield "picture.jpg", good.png()
    yield "picture.bmp", good.jpg()


def cases():
    group = "targets"
    pointer = "/constraints/0/targets"
    for name, content in damaged_pngs():
        yield scene_case(group, f"image: {name}", _targets(image="p.png"), pointer, files={"p.png": content})
        yield scene_case(group, f"photograph: {name}", LEAF | {"shapes": {"leaf": {"mesh": "p.png"}}}, "/shapes/leaf",
                         files={"p.png": content})
    for name, content in damaged_others():
        file = "p." + name.rpartition(".")[2]
        yield scene_case(group, f"image: {name}", _targets(image=file), pointer, files={file: content})
    for file, content in _other_formats():
        yield scene_case(group, f"image of another kind: {file}", _targets(image=file), pointer, files={file: content})
    yield scene_case(group, "image that is not there", _targets(image="none.png"), pointer)
    yield scene_case(group, "image that is a folder", _targets(image="p.png"), pointer, files={"p.png/x": b""})
    yield scene_case(group, "image of one colour", _targets(image="p.png"), pointer,
                     files={"p.png": good.png(scanlines=(b"\x00" + b"\x10\x10\x10\xff" * 12) * 8)})
    yield scene_case(group, "image of nothing", _targets(image="p.png"), pointer,
                     files={"p.png": good.png(scanlines=(b"\x00" + bytes(4) * 12) * 8)})
    for name, colour in (("two numbers", [1, 0]), ("a text", "red"), ("above 1", [2, 0, 0]), ("null", None)):
        yield scene_case(group, f"class colour: {name}", _targets(image="p.png", classes={"red": colour}),
                         pointer, files={"p.png": good.png()})
    for name, text in (("blanks", "   "), ("nothing", ""), ("a million letters", "m" * 1000000), ("two lines", "a\nb")):
        status = (0, 2, 3) if name == "two lines" else (2,)
        yield scene_case(group, f"text of {name}", _targets(text=text), *([pointer] if status == (2,) else []), status=status)
    for font, text, *letters in TEXTS:
        yield scene_case(group, f"text {ascii(text)} in {font}", _targets(text=text, font=font), pointer, *letters)
    for name, text in (("marks", "E\u0301U\u0308N\u0303"), ("joiners", "a\u200db"), ("blanks", "a\u00a0b")):
        yield scene_case(group, f"text with {name}", _targets(text=text), status=(0, 3))
    for name, content in (("junk", b"no font at all"), ("empty", b""), ("zeros", bytes(1000)), ("a picture", good.png())):
        yield scene_case(group, f"font: {name}", _targets(text="I", font="f.ttf"), pointer, files={"f.ttf": content})
    yield scene_case(group, "font that is not there", _targets(text="I", font="none.ttf"), pointer)
    yield scene_case(group, "font by an unknown name", _targets(text="I", font="comic"), pointer)
    yield scene_case(group, "image of 8000 x 8000 in 8 kB", _targets(image="p.png"), status=(0, 2, 3), files={
        "p.png": good.png(claimed=(8000, 8000), depth=1, colours=0, scanlines=bytes(8000 * 1001))})
    yield scene_case(group, "image that is right", _targets(image="p.png"), files={"p.png": good.png()}, status=(0, 3))
    for suffix, make in ((".jpg", good.jpg), (".tif", good.tif), (".bmp", good.bmp)):
        yield scene_case(group, f"image that is right, {suffix}", _targets(image=f"p{suffix}"), files={f"p{suffix}": make},
                         status=(0, 3))
    yield scene_case(group, "texture that is torn", LEAF | {"shapes": {"leaf": {"builtin": "leaf", "texture": "p.png"}}},
                     "warning", "p.png", files={"p.png": b"torn"}, status=(0, 2))
