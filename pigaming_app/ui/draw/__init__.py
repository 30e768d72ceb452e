"""The drawing kit: colours and type, glow canvases, icons and small shared parts.

Scenes import a few names from here rather than from theme, glow, icons and parts; scenes that need many import the
kit: `from pigaming_app.ui import draw as kit`.
"""

from pigaming_app.ui.draw.glow import *  # noqa: F403
from pigaming_app.ui.draw.icons import *  # noqa: F403
from pigaming_app.ui.draw.parts import *  # noqa: F403
from pigaming_app.ui.draw.theme import *  # noqa: F403
