"""The viewer under strangers, floods, stalls and garbage: what is refused, with which words, and that the node goes on."""

import re
import socket
import time

import numpy
import peer
import pytest
import rclpy
from test_visualization import displacement, grid_mesh, mesh_message, topology_version
from viewer import LATCHED, start  # noqa: F401
from websocket import BINARY, STATE, SURFACE, TEXT, Page, frame, request


@pytest.fixture(scope="module", autouse=True)
def ros():
    peer.isolate()
    rclpy.init(args=[])
    yield
    rclpy.shutdown()


def test_files_are_served_with_headers_that_bind_the_page_to_itself(start):
    session = start()
    status, headers, body = request(session.port)
    assert status == 200 and b"<!doctype html>" in body.lower()
    assert headers["content-type"] == "text/html; charset=utf-8"
    assert f"connect-src 'self' ws://127.0.0.1:{session.port};" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff" and headers["cache-control"] == "no-cache"
    assert request(session.port, headers={"If-None-Match": headers["etag"]})[0] == 304
    for path in ("/viewer.js", "/viewer.css", "/icon.svg", "/LICENCES.txt", "/index.html"):
        assert request(session.port, path)[0] == 200, path
    for path in ("/..%2f..%2fetc/passwd", "/dist/", "/nothing", "//"):
        assert request(session.port, path)[0] == 404, path


def test_a_foreign_origin_and_a_foreign_host_are_forbidden(start):
    session = start()
    port = session.port
    foreign = [
        {"Origin": "http://evil.example"},
        {"Origin": f"http://127.0.0.1:{port + 1}"},
        {"Origin": "null"},
        {"Host": f"evil.example:{port}", "Origin": f"http://evil.example:{port}"},
        {"Host": "127.0.0.1"},
        {"Host": None},
    ]
    for headers in foreign:
        status, _, body = request(port, headers=headers) if headers.get("Host", "") is not None else (403, {}, b"accepted")
        assert status == 403 and b"accepted" in body, (headers, body)
        page = Page(port, headers=headers)
        assert page.status in (400, 403), headers
        page.close()
    assert request(port, headers={"Host": f"localhost:{port}"})[0] == 200
    assert session.page(headers={"Origin": None}).status == 101, "what is no browser has no origin"
    assert session.page(headers={"Host": f"localhost:{port}", "Origin": f"http://localhost:{port}"}).status == 101


def test_a_thousand_connections_are_bounded_told_why_and_do_not_stop_the_node(start):
    session = start()
    page = session.page()
    session.wait_for(lambda: page.said("status"), "a page that was there before")
    connections, told = [], 0
    for _ in range(1000):
        connection = socket.create_connection(("127.0.0.1", session.port), 5.0)
        connections.append(connection)
    end = time.monotonic() + 10.0
    for connection in connections[::-1]:
        connection.settimeout(max(0.01, min(0.05, end - time.monotonic())))
        try:
            answer = connection.recv(4096)
        except (TimeoutError, ConnectionError):
            continue
        told += answer.startswith(b"HTTP/1.1 503") and b"connections at once" in answer
    assert told >= 800, told
    before = len(page.said("status"))
    session.wait_for(lambda: len(page.said("status")) >= before + 4, "the node still speaks to its page")
    assert session.set("viewer.rate", 30.0).successful, "and answers on ROS"
    for connection in connections:
        connection.close()
    session.wait_for(lambda: request(session.port)[0] == 200, "and serves again")


def test_idle_connections_do_not_pile_up(start):
    session = start()
    idle = [socket.create_connection(("127.0.0.1", session.port), 5.0) for _ in range(64)]
    idle[0].sendall(b"GET / HTTP/1.1\r\n")
    started = time.monotonic()
    for connection in idle:
        connection.settimeout(15.0)
        while connection.recv(4096):
            pass
    assert time.monotonic() - started < 14.0
    assert request(session.port)[0] == 200


def test_a_page_too_many_is_told_why(start):
    session = start({"viewer.max_pages": 2})
    pages = [session.page() for _ in range(3)]
    session.wait_for(lambda: pages[2].closed, "the third page is closed")
    assert pages[2].closed[0] == 1013
    assert "viewer.max_pages" in pages[2].last("refused")["reason"] and not pages[2].said("hello")
    pages[0].close()
    session.pages.remove(pages[0])

    def comes_in():
        late = session.page()
        session.wait_for(lambda: late.order, "an answer")
        return late.order[0] == "hello"

    session.wait_for(comes_in, "a place that is free again")


def test_garbage_is_refused_and_too_much_of_it_closes_the_page(start):
    session = start()
    page, other = session.page(), session.page()
    garbage = [b"", b"{", b"[]", b'{"type":"format_disk"}', b'{"type":"ping"}', b"\xf0\x9f\x92\xa9", b"[" * 60_000]
    for payload in garbage:
        page.send_frame(TEXT, payload)
    page.send_frame(BINARY, bytes(range(256)))
    page.send(type="pointer_target", device="", sequence=1, position=[0, 0, 0], grasp=False)
    page.send(type="pointer_target", device="nobody", sequence=1, position=[0, 0, 0], grasp=False)
    page.send(type="pointer_release", device="")
    page.send(type="set_parameter", id=3, name="no.such", value=1)
    page.send(type="ping", t=1.5)
    session.wait_for(lambda: page.last("pong") == {"type": "pong", "t": 1.5}, "a page that said nonsense is still heard")
    session.wait_for(lambda: len(page.said("refused")) == len(garbage) + 4, "one refusal for each")
    assert all("accepted" in refused["reason"] or "pointer_take" in refused["reason"] for refused in page.said("refused"))
    session.wait_for(lambda: page.said("parameter_result"), "an answer about the parameter")
    assert not page.last("parameter_result")["ok"] and "no.such" in page.last("parameter_result")["reason"]

    for _ in range(100):
        page.send_frame(TEXT, b"nonsense")
    session.wait_for(lambda: page.closed, "the end of patience")
    assert page.closed[0] == 1008
    other.send(type="ping", t=2)
    session.wait_for(lambda: other.last("pong"), "the other page does not notice")


def test_an_oversize_message_is_refused_with_the_limit(start):
    session = start()
    page = session.page()
    page.send_frame(TEXT, b'{"type":"ping","t":' + b" " * 70_000 + b"1}")
    session.wait_for(lambda: page.closed, "the end")
    assert page.closed[0] == 1009 and "65536" in page.last("refused")["reason"]
    broken = session.page()
    broken.socket.sendall(b"\xff\xff\xff\xff garbage in place of frames")
    session.wait_for(lambda: broken.closed, "the end of a broken stream")
    assert request(session.port)[0] == 200


def test_a_flood_of_messages_is_limited(start):
    session = start()
    page = session.page()
    page.socket.sendall(b"".join(frame(TEXT, b'{"type":"ping","t":1}') for _ in range(3000)))
    session.wait_for(lambda: page.closed, "the end of a flood")
    assert page.closed[0] == 1008 and "second" in page.said("refused")[0]["reason"]
    assert len(page.said("pong")) == 1000


def test_a_stalled_page_is_dropped_for_alone(start):
    session = start()
    vertices, triangles = grid_mesh(cells=60)
    session.publish("body_mesh", mesh_message(vertices, triangles), LATCHED)
    version = topology_version(vertices, triangles)
    stalled, reading = session.page(receive_bytes=4096), session.page()
    session.pages.remove(stalled)
    numbers = iter(range(1, 1_000_000))

    published = []

    def move():
        z_m = -1e-6 * next(numbers)
        session.publish("surface_displacement", displacement(range(len(vertices)), z_m, version))
        published.append(time.monotonic())

    session.wait_for(lambda: len(reading.shown[SURFACE]) > 10, "surfaces", move)
    before = len(reading.shown[SURFACE])
    published.clear()
    session.spin(8.0, move)
    published_hz, shown_hz = len(published) / 8.0, (len(reading.shown[SURFACE]) - before) / 8.0
    assert shown_hz > 0.8 * min(published_hz, 60), (shown_hz, published_hz)
    times = [when for when, _ in reading.shown[SURFACE][before:]]
    longest_s = max(numpy.diff(times)) - max(numpy.diff(published))
    assert longest_s < 0.3, "the page that reads never waits for the one that does not"
    # It reads again: it is up to date with the next update, knows what it missed, and nobody kept more than a little for it.
    session.pages.append(stalled)
    session.wait_for(lambda: stalled.shown[STATE] and stalled.dropped() > 50, "the count of what was dropped", move)
    assert session.viewer_value("dropped_updates") > 50
    newest = reading.sequences(SURFACE)[-1]
    session.wait_for(lambda: stalled.sequences(SURFACE)[-1] >= newest, "the newest surface", move)
    assert len(stalled.shown[SURFACE]) < 0.7 * len(reading.shown[SURFACE])


def test_a_taken_port_is_an_error_that_names_a_free_one(start, tmp_path):
    session = start()
    second = peer.Program(tmp_path, "visualization", {"viewer.port": session.port}, "second")
    assert second.process.wait(20) != 0
    line = [line for line in second.log().splitlines() if "viewer.port" in line]
    assert len(line) == 1 and f"{session.port} at 127.0.0.1 is taken" in line[0], second.log()
    free = int(re.search(r"(\d+) is free", line[0])[1])
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", free))
    unknown = peer.Program(tmp_path, "visualization", {"viewer.address": "no.such.host.invalid"}, "third")
    assert unknown.process.wait(20) != 0 and "viewer.address" in unknown.log()
    elsewhere = peer.Program(tmp_path, "visualization", {"viewer.address": "192.0.2.1"}, "fifth")
    assert elsewhere.process.wait(20) != 0 and elsewhere.log().count("os error 99") == 1, "the reason is said once"
    without = peer.Program(tmp_path, "visualization", {"viewer.enabled": False, "viewer.port": session.port}, "fourth")
    without.wait_ready()
    assert "viewer:" not in without.log()
    without.kill()


def test_served_at_every_address_it_says_one_that_a_browser_can_open(tmp_path):
    program = peer.Program(tmp_path, "visualization", {"viewer.address": "0.0.0.0", "viewer.port": 0}, "everywhere")
    program.wait_ready()
    try:
        assert "http://0.0.0.0" not in program.log()
        port = int(re.search(r"viewer: http://127\.0\.0\.1:(\d+)/$", program.log(), re.MULTILINE)[1])
        assert request(port)[0] == 200
        told = re.search(r"viewer: from other machines (?:http://([0-9.]+):(\d+)/|at an IP address of this machine)", program.log())
        assert told, program.log()
        if told[1] is not None:
            assert int(told[2]) == port and request(port, headers={"Host": f"{told[1]}:{port}"})[0] == 200
    finally:
        program.kill()
