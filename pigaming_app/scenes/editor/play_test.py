"""A match on a drawing: one person against AIs, without results; START, a click or the end leads back."""

from functools import partial

from pigaming_app.ai.registry import new_match
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.scenes.play.runner import NOTICE_AT
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.sim.arena import Arena
from pigaming_app.ui.draw import ICE
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import caption

RIVAL = "level2"
NOTICE = 6.0  # s for which the way back is shown
PLACES = [(x, y) for y in (NOTICE_AT[1], 974) for x in (NOTICE_AT[0], 560, 1360)]  # for it, on the canvas, best first
APART = 24  # px between it and a robot, on both sides together


class PlayTest(MatchScene):
    """The match. It is in no table, log or list of replays."""

    def __init__(self, context: Context, game: str, arena: Arena, device: Device) -> None:
        device = context.controls.driver(device)
        make = partial(new_match, arena=arena)
        super().__init__(context, setup_of(game, arena.name), [device], make=make, records=False)
        self.sequel.noted = True
        self.restart_allowed = False
        label = context.words.key_name(context.controls.label(device, Button.START))
        back = caption(f"{label}: {context.words('editor.hint_draw')}", ICE)
        covered = [box.inflate(APART, APART) for box in self.runner.occupied(self.devices)]
        places = [place for place in PLACES if back.box(place).collidelist(covered) < 0]
        self.runner.notice.at = (places or PLACES)[0]
        self.runner.notice.show(back, NOTICE)

    def handle(self, event: InputEvent) -> StackOperation:
        """START, Escape and a click lead back."""
        escapes = event.button is Button.BACK and self.drivers.escapes(event.device)
        if escapes or event.button in (Button.START, Button.CLICK):
            self.context.sounds.play("back")
            return Pop()
        return super().handle(event)

    def update(self, seconds: float) -> StackOperation:
        if self.stop_requested:
            return Pop()
        if self.match.over:
            return Pop() if self.ending.hold(seconds) else None
        return super().update(seconds)


def setup_of(game: str, arena: str) -> Setup:
    """A match by the default rules, with a person on the first seat."""
    rules = games()[game].default
    one, two, three, four = (Seat(RIVAL if i else "human", team) for i, team in enumerate(rules.teams))
    return Setup(
        game, arena, (one, two, three, four), rules.default_minutes, new_seed(), rules.name, rules.default_goal
    )
