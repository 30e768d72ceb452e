"""Without a screen and without a sound card."""

from tests.ui.fixtures import _home, _no_threads_stay, controls

__all__ = ["_home", "_no_threads_stay", "controls"]
