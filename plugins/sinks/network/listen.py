#!/usr/bin/env python3
"""Prints what a network sink sends, one packet a line as JSON.

A client to try a sink with, and an example of one: nothing but Python's standard library, the wire
format of protocol buffers read by hand. A field that is not in the tables below is printed under its
number, with a question mark before it.
"""

import argparse
import json
import socket
import struct
import sys

# Of every message: field number -> (name, type). The type is a name of SCALARS or another message;
# in brackets where the field may occur several times.
VECTOR2 = {1: ("x", "float"), 2: ("y", "float")}
VECTOR3 = {**VECTOR2, 3: ("z", "float")}

SSL_BALL = {
    1: ("confidence", "float"),
    2: ("area", "uint"),
    3: ("x", "float"),
    4: ("y", "float"),
    5: ("z", "float"),
    6: ("pixel_x", "float"),
    7: ("pixel_y", "float"),
}
SSL_ROBOT = {
    1: ("confidence", "float"),
    2: ("robot_id", "uint"),
    3: ("x", "float"),
    4: ("y", "float"),
    5: ("orientation", "float"),
    6: ("pixel_x", "float"),
    7: ("pixel_y", "float"),
    8: ("height", "float"),
}
SSL_DETECTION = {
    1: ("frame_number", "uint"),
    2: ("t_capture", "double"),
    3: ("t_sent", "double"),
    4: ("camera_id", "uint"),
    5: ("balls", [SSL_BALL]),
    6: ("robots_yellow", [SSL_ROBOT]),
    7: ("robots_blue", [SSL_ROBOT]),
}
SSL_LINE = {
    1: ("name", "string"),
    2: ("p1", VECTOR2),
    3: ("p2", VECTOR2),
    4: ("thickness", "float"),
    5: ("type", "uint"),
}
SSL_ARC = {
    1: ("name", "string"),
    2: ("center", VECTOR2),
    3: ("radius", "float"),
    4: ("a1", "float"),
    5: ("a2", "float"),
    6: ("thickness", "float"),
    7: ("type", "uint"),
}
SSL_FIELD = {
    1: ("field_length", "int"),
    2: ("field_width", "int"),
    3: ("goal_width", "int"),
    4: ("goal_depth", "int"),
    5: ("boundary_width", "int"),
    6: ("field_lines", [SSL_LINE]),
    7: ("field_arcs", [SSL_ARC]),
    8: ("penalty_area_depth", "int"),
    9: ("penalty_area_width", "int"),
    10: ("center_circle_radius", "int"),
    11: ("line_thickness", "int"),
}
SSL_WRAPPER = {1: ("detection", SSL_DETECTION), 2: ("geometry", {1: ("field", SSL_FIELD)})}

TRACKED_BALL = {1: ("pos", VECTOR3), 2: ("vel", VECTOR3), 3: ("visibility", "float")}
TRACKED_ROBOT = {
    1: ("robot_id", {1: ("id", "uint"), 2: ("team_color", "uint")}),
    2: ("pos", VECTOR2),
    3: ("orientation", "float"),
    4: ("vel", VECTOR2),
    5: ("vel_angular", "float"),
    6: ("visibility", "float"),
}
TRACKED_FRAME = {
    1: ("frame_number", "uint"),
    2: ("timestamp", "double"),
    3: ("balls", [TRACKED_BALL]),
    4: ("robots", [TRACKED_ROBOT]),
    6: ("capabilities", ["uint"]),
}
TRACKER_WRAPPER = {
    1: ("uuid", "string"),
    2: ("source_name", "string"),
    3: ("tracked_frame", TRACKED_FRAME),
}

FIRA_BALL = {
    1: ("x", "double"),
    2: ("y", "double"),
    3: ("z", "double"),
    4: ("vx", "double"),
    5: ("vy", "double"),
    6: ("vz", "double"),
}
FIRA_ROBOT = {
    1: ("robot_id", "uint"),
    2: ("x", "double"),
    3: ("y", "double"),
    4: ("orientation", "double"),
    5: ("vx", "double"),
    6: ("vy", "double"),
    7: ("vorientation", "double"),
}
FIRA_FRAME = {
    1: ("ball", FIRA_BALL),
    2: ("robots_yellow", [FIRA_ROBOT]),
    3: ("robots_blue", [FIRA_ROBOT]),
}
FIRA_FIELD = {
    1: ("width", "double"),
    2: ("length", "double"),
    3: ("goal_width", "double"),
    4: ("goal_depth", "double"),
    5: ("center_radius", "double"),
    6: ("penalty_width", "double"),
    7: ("penalty_depth", "double"),
}
FIRA_ENVIRONMENT = {1: ("step", "uint"), 2: ("frame", FIRA_FRAME), 3: ("field", FIRA_FIELD)}

# Of every sink: the message a packet is, and where it goes unless the pipeline says otherwise.
SINKS = {
    "ssl_vision": (SSL_WRAPPER, "224.5.23.2", 10015),
    "ssl_tracked": (TRACKER_WRAPPER, "224.5.23.2", 10010),
    "fira": (FIRA_ENVIRONMENT, "224.0.0.1", 10002),
}

VARINT, FIXED64, LENGTH_DELIMITED, FIXED32 = 0, 1, 2, 5

SCALARS = {
    "uint": (VARINT, lambda value: value),
    "int": (VARINT, lambda value: value - (1 << 64) if value >> 63 else value),
    "float": (FIXED32, lambda value: struct.unpack("<f", value)[0]),
    "double": (FIXED64, lambda value: struct.unpack("<d", value)[0]),
    "string": (LENGTH_DELIMITED, lambda value: value.decode("utf-8")),
}


def read_varint(data, at):
    """The number at a place, and the place behind it."""
    number = 0
    for shift in range(0, 70, 7):
        if at >= len(data):
            raise ValueError("the packet ends within a number")
        number |= (data[at] & 0x7F) << shift
        at += 1
        if not data[at - 1] & 0x80:
            return number & (1 << 64) - 1, at
    raise ValueError("a number is longer than 10 bytes")


def read_fields(data):
    """Every (field number, wire type, value) in order; a value is a number or bytes."""
    at = 0
    while at < len(data):
        key, at = read_varint(data, at)
        wire_type = key & 7
        if wire_type == VARINT:
            value, at = read_varint(data, at)
        elif wire_type in (FIXED64, FIXED32, LENGTH_DELIMITED):
            size = {FIXED64: 8, FIXED32: 4}.get(wire_type)
            if size is None:
                size, at = read_varint(data, at)
            if at + size > len(data):
                raise ValueError("the packet ends within a field")
            value = data[at : at + size]
            at += size
        else:
            raise ValueError(f"found wire type {wire_type}, expected 0, 1, 2 or 5")
        yield key >> 3, wire_type, value


def parse(data, message):
    """The fields of a message as a dictionary; those that are not there are left out."""
    result = {}
    for number, wire_type, value in read_fields(data):
        name, kind = message.get(number, (f"?{number}", None))
        repeated = isinstance(kind, list)
        if repeated:
            kind = kind[0]
        if isinstance(kind, dict):
            expected, convert = LENGTH_DELIMITED, lambda inner, of=kind: parse(inner, of)
        elif kind is None:
            expected, convert = wire_type, str
        else:
            expected, convert = SCALARS[kind]
        if wire_type != expected:
            raise ValueError(f"{name} has wire type {wire_type}, expected {expected}")
        if repeated:
            result.setdefault(name, []).append(convert(value))
        else:
            result[name] = convert(value)
    return result


def listen(address, port, interface):
    """A socket that hears what is sent to an address, which may be a multicast group."""
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.bind((address, port))
    if 224 <= int(address.split(".")[0]) <= 239:
        membership = socket.inet_aton(address) + socket.inet_aton(interface)
        listener.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
    return listener


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sink", choices=SINKS)
    parser.add_argument("--address", help="multicast group, or own address of this machine")
    parser.add_argument("--port", type=int, help="0: one that is free")
    parser.add_argument("--interface", default="0.0.0.0", help="own address to join the group with")
    parser.add_argument("--count", type=int, default=0, help="packets to read; 0: until Ctrl-C")
    parser.add_argument("--timeout", type=float, help="seconds to wait for a packet, then fail")
    options = parser.parse_args()

    message, address, port = SINKS[options.sink]
    if options.address is not None:
        address = options.address
    if options.port is not None:
        port = options.port
    listener = listen(address, port, options.interface)
    listener.settimeout(options.timeout)
    print("listening at {}:{}".format(*listener.getsockname()), file=sys.stderr, flush=True)
    count = 0
    while options.count == 0 or count < options.count:
        try:
            packet = listener.recv(65536)
        except socket.timeout:
            sys.exit(f"no packet came within {options.timeout} s")
        count += 1
        try:
            print(json.dumps(parse(packet, message)), flush=True)
        except ValueError as error:
            print(f"a packet of {len(packet)} bytes cannot be read: {error}", file=sys.stderr)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
