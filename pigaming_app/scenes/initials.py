"""Three letters for the table of best scores, chosen with a stick and one button: up and down change, FIRE goes on."""

import logging
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.games.game import Outcome, Setup
from pigaming_app.keeping import NotSaved
from pigaming_app.scenes.best import ROWS, Best
from pigaming_app.scenes.feats import Board, boards, contest, counts, told
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import (
    BODY,
    FOCUS,
    HERO,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    STEEL,
    THIN,
    TITLE,
    badge,
    brackets,
    cut,
    icon,
    text_width,
)
from pigaming_app.scenes.pane import LEFT, RIGHT, Lit, Pane, backdrop, fitted, word
from pigaming_app.scenes.press import Act, Device, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.stack import Pop, Swap, Turn
from pigaming_app.scores import LETTERS, Score
from pigaming_app.settings import folders

DEAF = 0.8  # seconds in which presses are ignored
PATIENCE = 25.0  # seconds without a press until the letters are taken as they are
WARNED = 10.0  # seconds before that
ROLL = 0.09  # seconds in which a letter rolls into its place
SLOT_W, SLOT_H, SLOT_GAP, MIDDLE = 216, 268, 48, 520

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Claim:
    """What somebody did that belongs into a table: boards (one for each feat) and values."""

    seat: int
    device: Device
    feats: tuple[tuple[Board, int], ...]


def claims(house: House, outcome: Outcome, setup: Setup, devices: Sequence[Device | None]) -> list[Claim]:
    """What people did, above zero, in a match that counts, that is among the rows shown."""
    out = []
    for row in outcome.rows:
        device = devices[row.seat]
        if setup.seats[row.seat].brain == "human" and device and counts(setup, row.seat):
            there = {board.table.feat: board for board in boards(contest(setup, row.seat))}
            feats = [(there[name], value) for name, value in row.feats.items() if value > 0]
            kept = tuple((board, value) for board, value in feats if places(house, board, value))
            if kept:
                out.append(Claim(row.seat, device, kept))
    return out


def places(house: House, claimed: Board, value: int) -> list[tuple[Board, int]]:
    """The places of a value in the boards of its table in which it is shown."""
    found = [
        (board, house.scores.place(board.table, value, board.days))
        for board in boards(claimed.table)
        if board.table == claimed.table
    ]
    return [(board, place) for board, place in found if place and place <= ROWS]


class Initials:
    """Asks everyone in `claims`, one after the other, and shows the tables."""

    def __init__(self, house: House, setup: Setup, claims: Sequence[Claim]) -> None:
        self.house, self.setup, self.claims = house, setup, list(claims)
        self.fresh: list[Score] = []
        self.prompts = Prompts(house, [(Act.FIRE, "results.next_letter"), (Act.BACK, "results.last_letter"),
                                       (Act.START, "results.done")])  # fmt: skip
        self._begin()

    def _begin(self) -> None:
        self.claim = self.claims.pop(0)
        self.letters, self.slot = [0, 0, 0], 0
        self.age = self.idle = 0.0
        self.rolled, self.rolling, self.touched = 0, 0.0, False
        self.lit: list[Lit] = []

    def entered(self) -> None:
        """Nothing to begin."""

    def on(self, press: Press) -> Turn:
        """Only the one who is asked chooses; START, by anyone, takes the letters as they are."""
        press = self.prompts.meant(press)
        theirs = press.device == self.claim.device or not self.house.controls.connected(self.claim.device)
        if self.age < DEAF or not (theirs or press.device.kind == "mouse" or press.act is Act.START):
            return None
        self.idle, self.touched = 0.0, True
        match press.act:
            case Act.UP | Act.DOWN:
                self._turn(-1 if press.act is Act.UP else 1)
            case Act.LEFT | Act.BACK:
                self._move(max(0, self.slot - 1))
            case Act.RIGHT:
                self._move(min(2, self.slot + 1))
            case Act.FIRE if self.slot < 2:
                self._move(self.slot + 1)
            case Act.FIRE | Act.START:
                return self._enter()
            case _:
                pass
        return None

    def update(self, seconds: float) -> Turn:
        """Let the letters roll; take them as they are when nobody chooses any more, none when nobody ever did."""
        self.age += seconds
        self.idle += seconds
        self.rolling += seconds
        if self.idle <= PATIENCE:
            return None
        return self._enter() if self.touched else self._next()

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the question and the letters."""
        if not self.lit:
            self.lit = [self._heading(), self._slots()]
        screen.blit(backdrop(), (0, 0))
        for lit in self.lit:
            lit.draw(screen)
        color = PLAYERS[self.claim.seat]
        for i, letter in enumerate(self.letters):
            here = i == self.slot
            dy = self.rolled * 60 * max(0.0, 1 - self.rolling / ROLL) if here else 0.0
            word(LETTERS[letter], HERO, FOCUS if here else color).draw(screen, middle(i), MIDDLE + dy)
        focus(middle(self.slot)).draw(screen)
        left = PATIENCE - self.idle
        if left < WARNED:
            half = 300 * left / WARNED
            pygame.draw.line(screen, FOCUS, (960 - half, 928), (960 + half, 928), 4)
        self.prompts.draw(screen)

    def _turn(self, by: int) -> None:
        self.letters[self.slot] = (self.letters[self.slot] + by) % len(LETTERS)
        self.rolled, self.rolling = by, 0.0
        self.house.sounds.play("move")

    def _move(self, slot: int) -> None:
        self.house.sounds.play("accept" if slot > self.slot else "back")
        self.rolled = 0
        self.slot = slot

    def _enter(self) -> Turn:
        initials = "".join(LETTERS[letter] for letter in self.letters)
        for board, value in self.claim.feats:
            row = self.house.scores.add(board.table, initials, value)
            self.fresh.append(row)
        self.house.sounds.play("ready", self.claim.seat)
        return self._next()

    def _next(self) -> Turn:
        """Ask the next one, or show the tables; nothing new in them, nothing to show."""
        if self.claims:
            self._begin()
            return None
        if not self.fresh:
            return Pop()
        try:
            self.house.scores.save(folders().data)
        except NotSaved as reason:
            _log.warning("%s", reason)
        return Swap(Best(self.house, contest(self.setup, self.claim.seat), self.fresh))

    def _heading(self) -> Lit:
        """Who is asked, for what."""
        words, seat = self.house.words, self.claim.seat
        pane = Pane(LEFT, 54, RIGHT - LEFT, 260)
        badge(pane.hot, seat, LEFT + 52, 110, 50)
        text = words("results.high_score")
        size = fitted(text, TITLE, RIGHT - LEFT - 330 - 300 * (len(self.claim.feats) - 1))
        pane.page.text(text, size, LEFT + 132, 112, PLAYERS[seat])
        told_all = "   ".join(words.decimal(told(value, board.table)) for board, value in self.claim.feats)
        pane.page.text(told_all, TITLE, RIGHT, 112, ICE, "hero", "r")
        pane.hot.line([(LEFT, 176), (RIGHT, 176)], STEEL, THIN).line(
            [(LEFT, 176), (LEFT + 218, 176)], PLAYERS[seat], LINE
        )
        pane.page.text(words("results.three"), LABEL, 960, 256, ICE, "head", "c")
        return pane.done()

    def _slots(self) -> Lit:
        """Three boxes, and the places that the score has."""
        pane = Pane(middle(0) - 400, MIDDLE - 160, 2 * 400 + 2 * (SLOT_W + SLOT_GAP), 440)
        for i in range(3):
            pane.hot.line(cut(middle(i) - SLOT_W / 2, MIDDLE - SLOT_H / 2, SLOT_W, SLOT_H, 20), STEEL, THIN, True)
        words = self.house.words
        found = [one for board, value in self.claim.feats for one in places(self.house, board, value)]
        text = "   ·   ".join(
            words("results.place", board=words(board.heading, goal=self.setup.goal), place=place)
            for board, place in found
        )
        x = 960 - text_width(text, BODY, "body") / 2
        icon(pane.hot, "crown", x - 52, MIDDLE + 262, 24, FOCUS, THIN)
        pane.page.body(text, x, MIDDLE + 264, MIST)
        return pane.done()


def middle(slot: int) -> float:
    """Where a letter stands, x in px."""
    return 960 + (slot - 1) * (SLOT_W + SLOT_GAP)


_FOCUS: list[Lit] = []


def focus(x: float) -> Lit:
    """The corners round the letter that is chosen, and what changes it, its middle at x."""
    if not _FOCUS:
        pane = Pane(-SLOT_W / 2 - 20, MIDDLE - 230, SLOT_W + 40, 460)
        brackets(pane.hot, -SLOT_W / 2, MIDDLE - SLOT_H / 2, SLOT_W, SLOT_H, FOCUS, 40, 20)
        for side, name in ((-1, "up"), (1, "down")):
            icon(pane.hot, name, 0, MIDDLE + side * 178, 32, FOCUS, LINE)
        _FOCUS.append(pane.done())
    lit = _FOCUS[0]
    return Lit(lit.image, (round(lit.at[0] + x), lit.at[1]))
