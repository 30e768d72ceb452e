"""Icon files of the three systems. Those of Windows and macOS are containers of PNG pictures."""

import struct
from functools import cache

ICO = (16, 24, 32, 48, 64, 128, 256)  # px
ICNS = {b"icp4": 16, b"icp5": 32, b"ic07": 128, b"ic08": 256, b"ic09": 512, b"ic10": 1024}  # px by type


@cache
def png(size: int) -> bytes:
    """The icon of `size` x `size` px as a PNG file."""
    from pigaming_app.scenes.title.icon import icon
    from pigaming_app.ui.png import png_of

    return png_of(icon(size))


def ico() -> bytes:
    """The icon of Windows: a header, 16 bytes for each picture, the pictures."""
    directory, pictures = b"", b""
    begin = 6 + 16 * len(ICO)
    for size in ICO:
        picture = png(size)
        edge = size % 256  # 0 means 256
        directory += struct.pack("<BBBBHHII", edge, edge, 0, 0, 1, 32, len(picture), begin + len(pictures))
        pictures += picture
    return struct.pack("<HHH", 0, 1, len(ICO)) + directory + pictures


def icns() -> bytes:
    """The icon of macOS: a header, then each picture with its type and length."""
    pictures = b"".join(kind + struct.pack(">I", 8 + len(png(size))) + png(size) for kind, size in ICNS.items())
    return b"icns" + struct.pack(">I", 8 + len(pictures)) + pictures
