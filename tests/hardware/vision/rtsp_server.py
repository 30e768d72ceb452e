"""A camera with RTSP: GStreamer's server, by Debian's Python. Each picture has the time at which it was made as blocks.

Arguments: port, 0 for a free one, which it prints; h264 or jpeg; name and password. It ends with its standard input.
"""

import sys
import threading
import time
from typing import Any

import gi

gi.require_version("Gst", "1.0")
gi.require_version("GstRtspServer", "1.0")
from gi.repository import GLib, Gst, GstRtspServer  # noqa: E402

WIDTH, HEIGHT, BITS = 640, 360, 16
CODECS = {
    "h264": "x264enc tune=zerolatency speed-preset=ultrafast key-int-max=15 ! rtph264pay",
    "jpeg": "jpegenc ! rtpjpegpay",
}


def picture(milliseconds: int) -> bytes:
    """Grey levels by row; the time, modulo 2 ** BITS, as black and white blocks."""
    block = WIDTH // BITS
    row = b"".join(bytes([255 * (milliseconds >> bit & 1)]) * block for bit in range(BITS))
    return row * HEIGHT


def feed(source: Any) -> None:
    """Push a picture every 1/30 s until the stream refuses them."""
    while source.emit("push-buffer", Gst.Buffer.new_wrapped(picture(round(1000 * time.monotonic())))) == 0:
        time.sleep(1 / 30)


def configure(_: Any, media: Any) -> None:
    source = media.get_element().get_by_name("source")
    threading.Thread(target=feed, args=(source,), daemon=True).start()


def main(port: str, codec: str, name: str, password: str) -> None:
    Gst.init(None)
    server, factory = GstRtspServer.RTSPServer(), GstRtspServer.RTSPMediaFactory()
    server.set_address("127.0.0.1")
    server.set_service(port)
    caps = f"video/x-raw,format=GRAY8,width={WIDTH},height={HEIGHT},framerate=30/1"
    source = (
        f"appsrc name=source is-live=true do-timestamp=true format=time max-buffers=1 leaky-type=downstream caps={caps}"
    )
    raw, kind = "video/x-raw,format=I420", 96 if codec == "h264" else 26
    factory.set_launch(f"( {source} ! videoconvert ! {raw} ! {CODECS[codec]} name=pay0 pt={kind} )")
    factory.set_shared(True)
    factory.connect("media-configure", configure)
    token = GstRtspServer.RTSPToken()
    token.set_string("media.factory.role", "viewer")
    auth = GstRtspServer.RTSPAuth()
    auth.add_basic(GstRtspServer.RTSPAuth.make_basic(name, password), token)
    server.set_auth(auth)
    permissions = GstRtspServer.RTSPPermissions()
    permissions.add_permission_for_role("viewer", "media.factory.access", True)
    permissions.add_permission_for_role("viewer", "media.factory.construct", True)
    factory.set_permissions(permissions)
    server.get_mount_points().add_factory("/live", factory)
    server.attach(None)
    loop = GLib.MainLoop()
    threading.Thread(target=lambda: (sys.stdin.read(), loop.quit()), daemon=True).start()
    print(server.get_bound_port(), flush=True)
    loop.run()


main(*sys.argv[1:])
