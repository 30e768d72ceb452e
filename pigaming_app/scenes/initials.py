"""Three letters for the tables of the best: everybody who is in the top eight chooses at once, each on the own device.

After ten seconds the letters are taken as they are; of somebody who has not chosen any, none.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import pygame

from pigaming_app.games.game import Outcome, Row, Setup
from pigaming_app.keeping import NotSaved
from pigaming_app.scenes import initials_page as page
from pigaming_app.scenes.best import Best
from pigaming_app.scenes.feats import Board, boards, told
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import FOCUS, LABEL
from pigaming_app.scenes.page import blacked, calling, heading, pulse
from pigaming_app.scenes.pane import Lit, backdrop
from pigaming_app.scenes.press import Act, Device, Press
from pigaming_app.scenes.spelling import Spelling
from pigaming_app.scenes.stack import Pop, Swap, Turn
from pigaming_app.scores import Score
from pigaming_app.settings import folders

TOP = 8  # places of today's best, and of the best ever, for which letters are asked
SECONDS = 10.0  # for all players together
DEAF = 0.5  # seconds in which presses are ignored
SPANS = {"results.today": 1, "results.ever": None}  # headings, and of how many days

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Claim:
    """What somebody did that belongs into a table: boards (one for each feat) and values.

    `places`: for each feat the places that it has, with the headings of their tables.
    """

    seat: int
    device: Device
    feats: tuple[tuple[Board, int], ...]
    places: tuple[tuple[tuple[str, int], ...], ...]


def claims(house: House, outcome: Outcome, setup: Setup, devices: Sequence[Device | None]) -> list[Claim]:
    """What people did that is among the best, those of this very match included. `devices`: who played each seat."""
    there = {board.feat.name: board for board in boards(setup.game, setup.arena, setup.goal)}
    people = [row for row in outcome.rows if setup.seats[row.seat].brain == "human" and devices[row.seat]]
    out = []
    for row in people:
        feats = [(there[name], value) for name, value in row.feats.items() if value > 0]
        found = [(feat, places(house, setup, *feat, [one for one in people if one is not row])) for feat in feats]
        kept = [(feat, here) for feat, here in found if here]
        device = devices[row.seat]
        if kept and device:
            out.append(Claim(row.seat, device, tuple(feat for feat, _ in kept), tuple(here for _, here in kept)))
    return out


def places(house: House, setup: Setup, board: Board, value: int, others: Sequence[Row]) -> tuple[tuple[str, int], ...]:
    """The places of a value among today's best and the best ever, by heading, as far as they are in the top eight.

    `others`: the rows of the other people in the match; those who were better stand ahead.
    """
    timed = board.feat.timed
    rivals = [row.feats.get(board.feat.name, 0) for row in others]
    ahead = sum(0 < rival < value if timed else rival > value for rival in rivals)
    found = []
    for title, days in SPANS.items():
        place = house.scores.place(setup.game, board.table, value, days, timed=timed)
        if place and place + ahead <= TOP:
            found.append((title, place + ahead))
    return tuple(found)


class Initials:
    """Asks everyone in `claims` at once, and shows the tables."""

    def __init__(self, house: House, setup: Setup, claims: Sequence[Claim]) -> None:
        self.house, self.setup, self.claims = house, setup, sorted(claims, key=lambda claim: claim.seat)
        self.spellings = {claim.device: Spelling() for claim in self.claims}
        self.age = 0.0
        self.ahead = self._ahead()

    def warm(self) -> None:
        """Make one piece of the page, so that it does not come in one long frame."""
        if piece := next(self.ahead, None):
            piece()

    def entered(self) -> None:
        """Nothing to begin."""

    def on(self, press: Press) -> Turn:
        """Each player's presses change the own letters alone."""
        device = self._meant(press)
        if self.age < DEAF or device is None:
            return None
        if sound := self.spellings[device].on(press.act):
            self.house.sounds.play(sound, next(claim.seat for claim in self.claims if claim.device == device))
        return self._end() if all(spelling.done for spelling in self.spellings.values()) else None

    def update(self, seconds: float) -> Turn:
        """Let time run out."""
        self.age += seconds
        for spelling in self.spellings.values():
            spelling.update(seconds)
        return self._end() if self.age >= SECONDS else None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint a panel for every player, and the time that is left."""
        words = self.house.words
        screen.blit(backdrop(), (0, 0))
        heading(words("results.high_score"), color=FOCUS).draw(screen)
        page.clock(screen, max(0.0, SECONDS - self.age), SECONDS)
        corners = page.corners(len(self.claims))
        blacked(screen, *(page.panel_at(x) for x in corners))
        for x, claim in zip(corners, self.claims, strict=True):
            self._panel(screen, x, claim)
        calling(words("results.three"), "", LABEL).draw(screen, 960, page.FOOT_Y)

    # ---- inside

    def _meant(self, press: Press) -> Device | None:
        """Whose letters a press is about; nobody's, if it is of a key that two players on one keyboard share."""
        if not press.among:
            return press.device if press.device in self.spellings else None
        clusters = [device for device in press.among if device in self.spellings]
        return clusters[0] if len(clusters) == 1 else None

    def _panel(self, screen: pygame.Surface, x: int, claim: Claim) -> None:
        words, spelling = self.house.words, self.spellings[claim.device]
        self._frame(claim, spelling.done).draw(screen, x, page.TOP_Y)
        page.letters(screen, x, claim.seat, spelling)
        if spelling.done:
            page.ready(claim.seat, words("results.done")).draw(screen, x, page.TOP_Y)
            return
        if spelling.refused:
            page.refused(words("results.another")).draw(screen, x, page.TOP_Y)
            return
        key = "done" if spelling.slot == 2 else "next_letter"
        label = words.printed(self.house.controls.label(claim.device, Act.FIRE))
        page.asked(label, words(f"results.{key}"), pulse(self.age, 5)).draw(screen, x, page.TOP_Y)

    def _frame(self, claim: Claim, done: bool) -> Lit:
        return page.frame(claim.seat, self.house.words("lobby.seat", player=claim.seat + 1), self._lines(claim), done)

    def _ahead(self) -> Iterator[Callable[[], object]]:
        words = self.house.words
        yield partial(heading, words("results.high_score"), color=FOCUS)
        for done in (False, True):
            for claim in self.claims:
                yield partial(self._frame, claim, done)
        for claim in self.claims:
            yield partial(page.ready, claim.seat, words("results.done"))

    def _lines(self, claim: Claim) -> tuple[tuple[str, str], ...]:
        """What the panel says about a claim: each feat with its value, and the places that it has."""
        words = self.house.words
        lines = []
        for (board, value), found in zip(claim.feats, claim.places, strict=True):
            shown = found if len(claim.feats) == 1 else found[-1:]
            lines.append((words(f"setup.best_{board.feat.name}"), told(value, board.feat)))
            lines += [(words("results.place", board=words(title), place=place), "") for title, place in shown]
        return tuple(lines)

    def _end(self) -> Turn:
        """Enter what was chosen, and show the tables; nothing new in them, nothing to show."""
        fresh = list(self._entered())
        if not fresh:
            return Pop()
        try:
            self.house.scores.save(folders().data)
        except NotSaved as reason:
            _log.warning("%s", reason)
        return Swap(Best(self.house, self.setup.game, self.setup.arena, self.setup.goal, fresh))

    def _entered(self) -> list[Score]:
        scores, game = self.house.scores, self.setup.game
        return [
            scores.add(game, board.table, initials, value, timed=board.feat.timed)
            for claim in self.claims
            if (initials := self.spellings[claim.device].taken)
            for board, value in claim.feats
        ]
