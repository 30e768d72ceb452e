"""The match of an event that is being played, as plain values for its live file."""

from collections.abc import Sequence

from pigaming_app.events.changes.live import LiveMatch
from pigaming_app.scenes.events.next_page import EventMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.results.snapshot import match_of, snapshot
from pigaming_app.ui.i18n import Words


def live_match(words: Words, scenes: Sequence[Scene], running: RunningEvent, match: object, beat: int) -> LiveMatch:
    """Scores and clock as the screen shows them; `match`: what follows the match on the stack, if one is played."""
    shown, on_top = match_of(scenes)
    if not isinstance(match, EventMatch) or shown is None:
        return LiveMatch(running.arcade, beat=beat)
    now = snapshot(shown, words, on_top)
    names = match.fixture.entrants
    scores = {names[seat]: side.score for side in now.sides for seat in side.seats if seat < len(names)}
    return LiveMatch(running.arcade, match.fixture.number, scores, now.clock, beat)
