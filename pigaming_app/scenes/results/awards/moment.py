"""The awards after a match that has no page of results, such as one of an event; then another scene."""

import pygame

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, StackOperation, Swap
from pigaming_app.scenes.results.awards.ceremony import Ceremony
from pigaming_app.scenes.results.winner import PREWARM_MS, AfterMatch
from pigaming_app.ui.input.events import Button, InputEvent

LENGTH = 8.0  # s


class AwardsMoment:
    """The ceremony before the scene `then`; any player may skip it once it is complete."""

    def __init__(self, context: Context, page: Ceremony, then: AfterMatch) -> None:
        self.context, self.page, self.then = context, page, then
        self.age = 0.0
        self.sounds = page.sounds()
        self.access = Access(context, lambda: page.ended.devices)
        self.prompts = context.prompts([(Button.FIRE, "results.on")], device=lambda: self.access.hint_device)

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.page.prewarm(milliseconds)

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE, START, BACK or a click skips it."""
        admitted = self.access.admit(self.prompts.as_button(event))
        skips = admitted and admitted.button in (Button.FIRE, Button.START, Button.BACK, Button.CLICK)
        return Swap(self.then) if skips and self.age >= self.page.ready_at else None

    def update(self, seconds: float) -> StackOperation:
        """Reveal the awards; then the next scene, as soon as it is rendered."""
        self.age += seconds
        while self.sounds and self.sounds[0][0] <= self.age:
            _, name, player = self.sounds.pop(0)
            self.context.sounds.play(name, player)
        ready = self.then.prewarm(PREWARM_MS)
        return Swap(self.then) if ready and self.age >= LENGTH else None

    def draw(self, screen: pygame.Surface) -> None:
        self.page.draw(screen, self.age)
        if self.age >= self.page.ready_at:
            self.prompts.draw(screen)
