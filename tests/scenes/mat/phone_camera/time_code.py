"""A camera whose pictures show when they were drawn: in place of the phone's, by a script for the page."""

from typing import Any

PX, BITS = 24, 24  # of the code: blocks in the first row, milliseconds as a binary number


def film_of(picture: str = "") -> str:
    """The script. `picture`: a data URL of what stands behind the code."""
    return f"""
navigator.mediaDevices.getUserMedia = async () => {{
    const canvas = document.createElement("canvas"), ink = canvas.getContext("2d", {{ alpha: false }});
    const behind = new Image();
    behind.src = "{picture}";
    [canvas.width, canvas.height] = [1280, 720];
    let count = 0;
    setInterval(() => {{
        count += 1;
        if (behind.naturalWidth) ink.drawImage(behind, count % 5, count % 3);
        const ms = Math.round(performance.timeOrigin + performance.now()) % {1 << BITS};
        for (let bit = 0; bit < {BITS}; bit++) {{
            ink.fillStyle = ms >> bit & 1 ? "#fff" : "#000";
            ink.fillRect({PX} * bit, 0, {PX}, {PX});
        }}
    }}, 16);
    return canvas.captureStream(30);
}};
"""


def drawn_at(image: Any, near: float) -> float:
    """When a picture was drawn, s since the epoch: the time next to `near` that its code fits."""
    row = image[PX // 2, PX // 2 : PX * BITS : PX]
    code, turn = sum(int(value > 127) << bit for bit, value in enumerate(row)), 1 << BITS
    return near - ((round(1000.0 * near) - code + turn // 2) % turn - turn // 2) / 1000.0
