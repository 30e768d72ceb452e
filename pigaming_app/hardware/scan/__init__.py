"""Real things on the mat as walls: structured light through the calibrated projector, or marker blocks alone.

Start reading at `procedure` (the scan), `blocks` (camera only), `watch` (things moved during a match), `things` (the
value that games get).
"""
