"""Where, how long and by which rules: the last page before a match. Whatever was chosen last is chosen again.

Any device may steer it: up and down from row to row, left and right change, fire begins.
"""

import logging
from functools import lru_cache

import pygame

from pigaming_app.games import GAMES
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import Setup
from pigaming_app.keeping import NotSaved
from pigaming_app.scenes import choice, effects
from pigaming_app.scenes.focus import Focus, Spot
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import PLAYERS
from pigaming_app.scenes.page import blacked, heading
from pigaming_app.scenes.pane import LEFT, RIGHT, Lit, backdrop, span
from pigaming_app.scenes.press import Act, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.seats import EMPTY, Seats
from pigaming_app.scenes.stack import Home, Pop, Push, Turn
from pigaming_app.scenes.views.preview import preview
from pigaming_app.settings import folders
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.world import HEIGHT, WIDTH

IDLE = 60.0  # seconds without a press until the title
DEAF = 0.35  # seconds in which nobody can begin: the press that said "ready" may be hammered
SLIDE = 0.18  # seconds in which another arena comes in
FRAME = pygame.Rect(LEFT, 216, span(0, 8)[1], 660)
PICTURE = FRAME.inflate(-24, -24)
MARGIN = 8  # px round the arena in its picture
ROWS = {
    name: pygame.Rect(span(8, 4)[0], y, span(8, 4)[1], h)
    for name, y, h in (("arena", 216, 140), ("minutes", 372, 140), ("rules", 528, 236), ("go", 780, 96))
}
log = logging.getLogger(__name__)


class SetupPage:
    """The choice of the match that `seats` are going to play."""

    def __init__(self, house: House, game: str, seats: Seats) -> None:
        self.house, self.game, self.seats = house, GAMES[game], seats
        self.arenas = playable(game)
        self.arena = chosen_arena(house, game)
        self.minutes, self.variant = chosen_rules(house, game)
        self.clock, self.slid, self.way = 0.0, SLIDE, 1
        self.prompts = Prompts(
            house, [(Act.FIRE, "setup.hint_go"), (Act.RIGHT, "setup.hint_change"), (Act.BACK, "setup.hint_back")]
        )
        self.focus = Focus([Spot(name, box) for name, box in ROWS.items()], "arena")

    def entered(self) -> None:
        """Shown, or come back to from the results."""
        self.clock = 0.0
        self.house.sounds.music(True)

    def on(self, press: Press) -> Turn:
        """Change, begin, or go back."""
        press = self.prompts.meant(press)
        match press.act:
            case Act.LEFT | Act.RIGHT:
                self._change(self.focus.name, 1 if press.act is Act.RIGHT else -1)
            case Act.FIRE | Act.START:
                return self._go() if self.clock > DEAF else None
            case Act.BACK:
                self.house.sounds.play("back")
                return Pop()
            case Act.CLICK:
                self.focus.on(press)
                return self._click(press)
            case _:
                if self.focus.on(press):
                    self.house.sounds.play("move")
        return None

    def update(self, seconds: float) -> Turn:
        """Let the picture slide in; go back when a seat has lost its device, and leave when nobody is there."""
        self.clock += seconds
        if any(device and not self.house.controls.connected(device) for device in self.seats.devices()):
            return Pop()
        self.slid = min(SLIDE, self.slid + seconds)
        self.focus.update(seconds)
        return Home() if self.house.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the page."""
        words = self.house.words
        screen.blit(backdrop(), (0, 0))
        heading(words("setup.title")).draw(screen)
        choice.lineup(self._signs()).draw(screen, RIGHT, 112)
        blacked(screen, FRAME, *ROWS.values())
        self._picture(screen)
        arena = load_kept(self.game.name, self.arena)
        place = f"{self.arenas.index(self.arena) + 1} / {len(self.arenas)}"
        minutes = tuple(map(str, self.game.minutes))
        variant, line = words(f"setup.{self.variant}"), words(f"setup.{self.variant}_line")
        rows = {
            "arena": choice.row(words("setup.arena"), title(arena, words.language), place),
            "minutes": choice.chips(words("setup.minutes"), minutes, str(self.minutes)),
            "rules": choice.row(words("setup.rules"), variant, line=line),
            "go": choice.begin(words("setup.go")),
        }
        for name, box in ROWS.items():
            rows[name].draw(screen, *box.topleft)
        choice.meant(ROWS[self.focus.name].h).draw(screen, *ROWS[self.focus.name].topleft)
        self.focus.draw(screen)
        self.prompts.draw(screen)

    # ---- inside

    def _go(self) -> Turn:
        from pigaming_app.scenes.match import MatchScene, new_seed

        self._keep()
        self.house.sounds.play("accept")
        setup = Setup(self.game.name, self.arena, self.seats.seats(), float(self.minutes), new_seed(), self.variant)
        return Push(MatchScene(self.house, setup, self.seats.devices()))

    def _keep(self) -> None:
        """Remember the choice for the next time, also after a power cut."""
        settings = self.house.settings
        settings.arena, settings.minutes, settings.variant = self.arena, self.minutes, self.variant
        try:
            settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)

    def _change(self, name: str, by: int) -> None:
        """The next value of a row, or the one before it."""
        before = self.arena, self.minutes, self.variant
        if name == "arena":
            self.arena = self.arenas[(self.arenas.index(self.arena) + by) % len(self.arenas)]
            self.slid, self.way = 0.0, by
        elif name == "minutes":
            i = self.game.minutes.index(self.minutes) + by
            self.minutes = self.game.minutes[max(0, min(len(self.game.minutes) - 1, i))]
        elif name == "rules":
            variants = self.game.variants
            self.variant = variants[(variants.index(self.variant) + by) % len(variants)]
        if (self.arena, self.minutes, self.variant) != before:
            self.house.sounds.play("move")
        settings = self.house.settings
        settings.arena, settings.minutes, settings.variant = self.arena, self.minutes, self.variant

    def _click(self, press: Press) -> Turn:
        """The arrows and chips of a row, the picture (the next arena), the button."""
        name = self.focus.under(press)
        at = press.at or (0.0, 0.0)
        if name == "go":
            return self._go()
        if name == "minutes":
            minutes = choice.chip_at(len(self.game.minutes), at[0] - ROWS[name].left)
            if minutes is not None:
                self._change(name, minutes - self.game.minutes.index(self.minutes))
        elif name:
            self._change(name, 1 if at[0] > ROWS[name].centerx else -1)
        elif FRAME.collidepoint(at):
            self._change("arena", 1)
        return None

    def _signs(self) -> tuple[tuple[int, str], ...]:
        """Who plays: seats and the icons of what drives them."""
        kinds = ((i, place) for i, place in enumerate(self.seats.places) if place.kind != EMPTY)
        signs = {"pad": "pad", "keys": "keys"}
        return tuple((i, signs[place.device.kind] if place.device else "ai") for i, place in kinds)

    def _picture(self, screen: pygame.Surface) -> None:
        """The arena, coming in from the side, and light where the robots of this match begin."""
        choice.frame(*FRAME.size).draw(screen, *FRAME.topleft)
        arena = load_kept(self.game.name, self.arena)
        left = (1.0 - self.slid / SLIDE) ** 2
        dx = round(self.way * 160 * left)
        screen.set_clip(FRAME.inflate(-12, -12))
        picture(self.game.name, self.arena).draw(screen, dx)
        k = min((PICTURE.w - 2 * MARGIN) / WIDTH, (PICTURE.h - 2 * MARGIN) / HEIGHT)
        x0, y0 = PICTURE.centerx - k * WIDTH / 2, PICTURE.centery - k * HEIGHT / 2
        for i, _ in self._signs():
            stage = int((self.clock * 0.7 + 0.25 * i) % 1.0 * 1.5 * effects.WAVE_STEPS)
            if stage < effects.WAVE_STEPS // 2:
                start = arena.starts[i]
                wave = effects.wave(PLAYERS[i], stage)
                screen.blit(
                    wave.image,
                    (round(x0 + dx + k * start.x + wave.dx), round(y0 + k * start.y + wave.dy)),
                    special_flags=pygame.BLEND_RGB_ADD,
                )
        screen.set_clip(None)


@lru_cache(maxsize=16)
def picture(game: str, name: str) -> Lit:
    """A large picture of an arena, where the page shows it."""
    return Lit(preview(load_kept(game, name), *PICTURE.size), PICTURE.topleft)


@lru_cache(maxsize=32)
def load_kept(game: str, name: str) -> Arena:
    """An arena, read once. Raises ArenaError."""
    return load(game, name)


@lru_cache(maxsize=4)
def playable(game: str) -> tuple[str, ...]:
    """The arenas of a game whose files are right; what is wrong with the others goes to the log."""
    names = []
    for name in arenas(game):
        try:
            load_kept(game, name)
            names.append(name)
        except ArenaError as trouble:
            log.warning("%s", trouble)
    return tuple(names)


def title(arena: Arena, language: str) -> str:
    """What an arena is called."""
    return arena.title.get(language, arena.name)


def chosen_arena(house: House, game: str) -> str:
    """The arena that was chosen last, or the first if that has gone."""
    names = playable(game)
    return house.settings.arena if house.settings.arena in names else names[0]


def chosen_rules(house: House, game: str) -> tuple[int, str]:
    """Minutes and variant that were chosen last, or the game's own."""
    rules, settings = GAMES[game], house.settings
    minutes = settings.minutes if settings.minutes in rules.minutes else rules.default_minutes
    return minutes, settings.variant if settings.variant in rules.variants else rules.variants[0]


def summary(house: House, game: str) -> str:
    """Game, minutes and arena in one line."""
    words = house.words
    minutes, _ = chosen_rules(house, game)
    where = title(load_kept(game, chosen_arena(house, game)), words.language)
    return "  ·  ".join((words(f"games.{game}"), words("setup.min", minutes=minutes), where))
