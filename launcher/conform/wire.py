"""Messages as docs/protocol.md, section 2, describes them: a JSON header and one raw frame per array."""
from __future__ import annotations

import json
import math
from dataclasses import dataclass, field

import numpy

PROTOCOL = 2
TYPES = ("f8", "i8", "i4", "u1")
ENVELOPE = {"protocol": int, "run": str, "kind": str, "part": int, "parts": int, "arrays": list}
WORDS = {int: "integer", str: "string", list: "list"}


class Breach(Exception):
    """What a participant did wrong so that the conversation cannot go on. `section` of docs/protocol.md."""

    def __init__(self, section: str, sentence: str) -> None:
        super().__init__(sentence)
        self.section, self.sentence = section, sentence


@dataclass
class Findings:
    """What was found wrong, each thing once: (section of docs/protocol.md, sentence)."""

    list: list[tuple[str, str]] = field(default_factory=list)
    known: set[str] = field(default_factory=set)

    def add(self, section: str, topic: str, sentence: str) -> None:
        """Only the first finding of a topic is kept: the windows after it would repeat it."""
        if topic not in self.known:
            self.known.add(topic)
            self.list.append((section, sentence))

    def take(self, breach: Breach) -> None:
        self.add(breach.section, breach.sentence, breach.sentence)


@dataclass
class Message:
    header: dict
    arrays: dict[str, numpy.ndarray]

    @property
    def kind(self) -> str:
        return self.header["kind"]

    def array(self, section: str, name: str, kind: str, shape: tuple[int | None, ...]) -> numpy.ndarray:
        """An array that must be there with this type and shape (None: any extent). Raises Breach."""
        if name not in self.arrays:
            raise Breach(section, f"'{self.kind}' lacks the array '{name}'")
        found = self.arrays[name]
        if found.dtype.str[1:] != kind:
            raise Breach(section, f"'{self.kind}': array '{name}' is of type {found.dtype.str[1:]}, it must be {kind}")
        fits = len(found.shape) == len(shape) and all(w in (None, f) for f, w in zip(found.shape, shape))
        if not fits:
            wanted = "".join(f"[{'n' if extent is None else extent}]" for extent in shape)
            raise Breach(section, f"'{self.kind}': array '{name}' has the shape {brackets(found.shape)}, "
                                  f"it must be {wanted}")
        return found

    def field(self, section: str, name: str, kind: type, meaning: str) -> object:
        """A field of the header that must be there. Numbers may be written as integers. Raises Breach."""
        value = self.header.get(name)
        good = isinstance(value, (int, float)) if kind is float else isinstance(value, kind)
        if not good or (isinstance(value, bool) and kind is not bool):
            raise Breach(section, f"'{self.kind}': the field '{name}' must be {meaning}, "
                                  + (f"not {json.dumps(value)}" if name in self.header else "it is missing"))
        return value


def brackets(shape: tuple[int, ...]) -> str:
    return "".join(f"[{extent}]" for extent in shape) or "[]"


def encode(kind: str, run: str, fields: dict, arrays: dict[str, numpy.ndarray],
           protocol: int = PROTOCOL) -> list[bytes]:
    descriptors = [{"name": name, "type": array.dtype.str[1:], "shape": list(array.shape)}
                   for name, array in arrays.items()]
    header = {"protocol": protocol, "run": run, "kind": kind, "part": 1, "parts": 1, **fields, "arrays": descriptors}
    return [json.dumps(header).encode(), *(numpy.ascontiguousarray(array).tobytes() for array in arrays.values())]


def decode(frames: list[bytes], run: str) -> Message:
    """A message whose envelope and frames agree with section 2. Raises Breach."""
    header = parse_header(frames[0])
    kind = header["kind"]
    if header["protocol"] != PROTOCOL:
        raise Breach("2", f"'{kind}': the header says protocol {header['protocol']}, this is protocol {PROTOCOL}")
    if header["run"] != run:
        raise Breach("2", f"'{kind}': the header says run '{header['run']}', the command line '{run}'")
    if (header["part"], header["parts"]) != (1, 1):
        raise Breach("2", f"'{kind}': the header says part {header['part']} of {header['parts']}, it must be 1 of 1")
    if len(frames) - 1 != len(header["arrays"]):
        raise Breach("2", f"'{kind}': the header announces {len(header['arrays'])} arrays, "
                          f"{len(frames) - 1} frames came with it")
    arrays: dict[str, numpy.ndarray] = {}
    for descriptor, frame in zip(header["arrays"], frames[1:]):
        name, array = decode_array(kind, descriptor, frame)
        if name in arrays:
            raise Breach("2", f"'{kind}': two arrays have the name '{name}'")
        arrays[name] = array
    return Message(header, arrays)


def parse_header(frame: bytes) -> dict:
    if not frame:
        raise Breach("2", "a message begins with an empty frame; its first frame must be the header")
    try:
        header = json.loads(frame.decode("utf-8"), parse_constant=no_number)
    except ValueError as error:
        raise Breach("2", f"the first frame of a message is not JSON in UTF-8: {error}") from None
    if not isinstance(header, dict):
        raise Breach("2", "the first frame of a message is not a JSON object")
    name = f"'{header.get('kind')}'"
    for key, kind in ENVELOPE.items():
        if not isinstance(header.get(key), kind) or isinstance(header.get(key), bool):
            raise Breach("2", f"{name}: the header lacks the field '{key}' of type {WORDS[kind]}")
    return header


def no_number(word: str) -> float:
    raise ValueError(f"{word} is no number of JSON")


def decode_array(kind: str, descriptor: object, frame: bytes) -> tuple[str, numpy.ndarray]:
    described = isinstance(descriptor, dict) and isinstance(descriptor.get("name"), str)
    shape = descriptor.get("shape") if described else None
    natural = isinstance(shape, list) and all(type(extent) is int and extent >= 0 for extent in shape)
    if not described or not natural:
        raise Breach("2", f"'{kind}': an array is described as {json.dumps(descriptor)}, "
                          "it must have 'name', 'type' and 'shape', a list of extents")
    name, word = descriptor["name"], descriptor.get("type")
    if word not in TYPES:
        raise Breach("2", f"'{kind}': array '{name}' is of type {json.dumps(word)}, the types are {', '.join(TYPES)}")
    needed = math.prod(shape) * int(word[1])
    if needed != len(frame):
        raise Breach("2", f"'{kind}': array '{name}' came with {len(frame)} bytes, "
                          f"its type {word} and shape {brackets(tuple(shape))} need {needed}")
    return name, numpy.frombuffer(frame, "<" + word).reshape(shape)
