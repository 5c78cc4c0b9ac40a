"""The visualization node with its pages, between a peer that speaks as device, model and driver do."""

import re
import time

import peer
import pytest
from geometry_msgs.msg import TransformStamped
from test_visualization import TRIANGLES, VERTICES, Session, mesh_message
from tf2_msgs.msg import TFMessage
from websocket import Page

LATCHED = peer.latched(10)


class Viewed(Session):
    """The node, the peers around it, and its pages."""

    def __init__(self, folder, namespace, values):
        self.pages = []
        super().__init__(folder, namespace, {"viewer.port": 0, **values})
        self.port = int(re.search(r"viewer: http://127\.0\.0\.1:(\d+)/", self.program.log())[1])

    def page(self, **options):
        page = Page(self.port, **options)
        assert page.status == 101
        self.pages.append(page)
        return page

    def wait_for(self, condition, what, meanwhile=lambda: None):
        def polled():
            meanwhile()
            for page in self.pages:
                page.poll()

        super().wait_for(condition, what, polled)

    def spin(self, seconds, meanwhile=lambda: None):
        end = time.monotonic() + seconds
        self.wait_for(lambda: time.monotonic() >= end, "the end of a pause", meanwhile)

    def viewer_value(self, key):
        """A number from diagnostics made after this call."""
        return float(self.new_status(f"/{self.namespace}/visualization: viewer")[2][key])

    def close(self):
        for page in self.pages:
            page.close()
        super().close()


@pytest.fixture
def start(tmp_path, request):
    sessions = []

    def started(values=None):
        namespace = f"{request.node.name[-40:]}_{len(sessions)}"
        sessions.append(Viewed(tmp_path / str(len(sessions)), namespace, values or {}))
        return sessions[-1]

    yield started
    for session in sessions:
        session.close()


def plate(session):
    """The plate of the neighbours' tests as the body."""
    session.publish("body_mesh", mesh_message(VERTICES, TRIANGLES), LATCHED)


def body_is_scene(session):
    """A device whose base stands in the scene, under the name that the messages have."""
    transform = TransformStamped(child_frame_id="device_base")
    transform.header.frame_id = f"{session.namespace}/scene"
    transform.transform.rotation.w = 1.0
    session.publish("/tf_static", TFMessage(transforms=[transform]), peer.latched(100))
