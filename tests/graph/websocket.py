"""A WebSocket client that can also do what no browser does: send garbage, stop reading, lie about where it comes from."""

import base64
import json
import os
import select
import socket
import struct
import time

import numpy

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
MESH, SURFACE, STATE = 1, 2, 3
DEVICE = numpy.dtype(
    [
        ("mode", "u1"),
        ("flags", "u1"),
        ("reserved", "u1", 6),
        ("stamp_s", "<f8"),
        ("probe", "<f4", 3),
        ("quaternion", "<f4", 4),
        ("proxy", "<f4", 3),
        ("normal", "<f4", 3),
        ("force", "<f4", 3),
        ("depth_m", "<f4"),
        ("normal_force_n", "<f4"),
        ("stiffness_n_per_m", "<f4"),
        ("latency_s", "<f4"),
        ("pose_rate_hz", "<f4"),
        ("handle", "<f4", 3),
        ("commanded_force", "<f4", 3),
        ("padding", "<f4"),
    ]
)
assert DEVICE.itemsize == 128


def request(port, path="/", headers=None, timeout_s=5.0):
    """Status, headers and body of one HTTP request. `headers` in place of a browser's."""
    with socket.create_connection(("127.0.0.1", port), timeout_s) as connection:
        lines = {"Host": f"127.0.0.1:{port}", "Connection": "close", **(headers or {})}
        connection.sendall(head(path, lines))
        answer = b""
        while part := connection.recv(65536):
            answer += part
    return parsed(answer)


def head(path, headers):
    lines = [f"GET {path} HTTP/1.1", *(f"{name}: {value}" for name, value in headers.items() if value is not None)]
    return "\r\n".join([*lines, "", ""]).encode()


def parsed(answer):
    text, _, body = answer.partition(b"\r\n\r\n")
    first, *lines = text.decode().split("\r\n")
    headers = {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}
    return int(first.split()[1]), headers, body


def frame(opcode, payload, first=0x80):
    """One frame from a client."""
    length = len(payload)
    if length < 126:
        size = bytes([0x80 | length])
    elif length < 65536:
        size = bytes([0x80 | 126]) + struct.pack(">H", length)
    else:
        size = bytes([0x80 | 127]) + struct.pack(">Q", length)
    # A mask of zeros is a mask.
    return bytes([first | opcode]) + size + bytes(4) + payload


class Page:
    """One page: what it has been told, by type; what it has been shown, by kind, each with its time of arrival."""

    def __init__(self, port, headers=None, receive_bytes=None):
        self.socket = socket.socket()
        if receive_bytes:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
        self.socket.settimeout(5.0)
        self.socket.connect(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            head(
                "/ws",
                {
                    "Host": f"127.0.0.1:{port}",
                    "Origin": f"http://127.0.0.1:{port}",
                    "Connection": "Upgrade",
                    "Upgrade": "websocket",
                    "Sec-WebSocket-Version": "13",
                    "Sec-WebSocket-Key": key,
                    **(headers or {}),
                },
            )
        )
        self.waiting = b""
        while b"\r\n\r\n" not in self.waiting:
            part = self.socket.recv(4096)
            if not part:
                break
            self.waiting += part
        self.status, _, self.waiting = parsed(self.waiting)
        self.texts, self.shown, self.order, self.closed = {}, {MESH: [], SURFACE: [], STATE: []}, [], None
        self.bytes = 0

    def poll(self):
        """Take what has arrived, with the answer to the greeting or since. Never waits."""
        self.take_frames()
        while self.closed is None and select.select([self.socket], [], [], 0)[0]:
            try:
                part = self.socket.recv(1 << 20)
            except ConnectionError:
                part = b""
            if not part:
                self.closed = self.closed or (None, "")
                return
            self.bytes += len(part)
            self.waiting += part
            self.take_frames()

    def take_frames(self):
        while len(self.waiting) >= 2:
            length, at = self.waiting[1] & 0x7F, 2
            if length >= 126:
                size = 2 if length == 126 else 8
                if len(self.waiting) < 2 + size:
                    return
                length, at = int.from_bytes(self.waiting[2 : 2 + size], "big"), 2 + size
            if len(self.waiting) < at + length:
                return
            opcode, payload = self.waiting[0] & 0xF, self.waiting[at : at + length]
            self.waiting = self.waiting[at + length :]
            self.take(opcode, payload)

    def take(self, opcode, payload):
        if opcode == TEXT:
            message = json.loads(payload)
            self.texts.setdefault(message["type"], []).append(message)
            self.order.append(message["type"])
        elif opcode == BINARY:
            self.shown[payload[0]].append((time.monotonic(), payload))
            self.order.append(payload[0])
        elif opcode == PING:
            self.send_frame(PONG, payload)
        elif opcode == CLOSE:
            self.closed = (int.from_bytes(payload[:2], "big"), payload[2:].decode())

    def send(self, **message):
        self.send_frame(TEXT, json.dumps(message).encode())

    def send_frame(self, opcode, payload, first=0x80):
        self.socket.sendall(frame(opcode, payload, first))

    def said(self, kind):
        return self.texts.get(kind, [])

    def last(self, kind):
        return self.texts[kind][-1] if self.said(kind) else None

    def mesh(self):
        """Topology version, vertices, triangles, stiffness factors of the newest mesh."""
        payload = self.shown[MESH][-1][1]
        version, vertices, triangles, has_stiffness = struct.unpack_from("<4I", payload, 8)
        positions = numpy.frombuffer(payload, "<f4", 3 * vertices, 24).reshape(-1, 3)
        corners = numpy.frombuffer(payload, "<u4", 3 * triangles, 24 + 12 * vertices).reshape(-1, 3)
        at = 24 + 12 * (vertices + triangles)
        factors = numpy.frombuffer(payload, "<f4", vertices, at) if has_stiffness else None
        assert len(payload) == at + 4 * vertices * has_stiffness
        return version, positions, corners, factors

    def surface(self, index=-1):
        """Topology version, stamp, vertices and displacements of a surface update."""
        payload = self.shown[SURFACE][index][1]
        version, count, stamp_s = struct.unpack_from("<2Id", payload, 8)
        vertices = numpy.frombuffer(payload, "<u4", count, 24)
        assert len(payload) == 24 + 16 * count
        return version, stamp_s, vertices, numpy.frombuffer(payload, "<f4", 3 * count, 24 + 4 * count).reshape(-1, 3)

    def states(self):
        """The devices of the newest state."""
        payload = self.shown[STATE][-1][1]
        return numpy.frombuffer(payload, DEVICE, struct.unpack_from("<I", payload, 20)[0], 24)

    def dropped(self):
        return struct.unpack_from("<I", self.shown[STATE][-1][1], 16)[0]

    def sequences(self, kind):
        return [struct.unpack_from("<I", payload, 4)[0] for _, payload in self.shown[kind]]

    def close(self):
        self.socket.close()
