"""A class with its phones: at most four of them may act, the others watch, cheer and vote until it is their turn."""

from typing import TYPE_CHECKING, Any

from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.input.phone_messages import Wish, WishKind
from tests.bench.open_day.hands import PhoneHands
from tests.bench.open_day.ledger import Wait
from tests.bench.open_day.plan import PLACES

if TYPE_CHECKING:
    from tests.bench.open_day.stage import Player, Stage

NAMES = ("Ana", "José", "Zoë", "Müller", "Owen", "Inês", "Chloé", "Noé", "shit", "<b>Bo</b>", "x" * 40, "Łukasz")
WISHES = 0.01  # chance of a cheer or a vote of each phone in a frame
MOST = 2  # times the matches that a fair order needs


class SchoolClass:
    """The reactions of a class on the stage. `hall`: everybody, with their phones."""

    def __init__(self, stage: "Stage", hall: list["Player"]) -> None:
        self.stage, self.hall = stage, hall
        self.named: set[int] = set()
        self.waiting: dict[int, tuple[float, int, int]] = {}  # by visitor: since s, matches before it, fair share
        self.begun = 0  # matches
        self._reported: set[int] = set()
        self.match: MatchScene | None = None  # on the stack

    @property
    def finished(self) -> bool:
        """True when everybody has played, or should have."""
        absent = [one for one in self.hall if one.visitor.number not in self.stage.watch.seated]
        if absent and self.stage.matches < MOST * -(-len(self.hall) // PLACES):
            return False
        for number in {player.visitor.number for player in absent} - self._reported:
            self._reported.add(number)
            self.stage.watch.trouble(f"visitor {number} of a class has had no turn")
        return True

    def visitors(self, match: MatchScene) -> list[int]:
        """The numbers of those whose phones drive in a match."""
        seats = {device.number for device in match.devices if device and device.kind == "phone"}
        return [player.visitor.number for player in self.hall if _number(player) in seats]

    def look(self, now: float, top: Any) -> list["Player"]:
        """Let everybody join, cheer and vote. Returns those who may act."""
        self.stage.note_tokens(self.hall)
        match = next((scene for scene in self.stage.app.stack.scenes if isinstance(scene, MatchScene)), None)
        if match is not self.match:
            self.match, playing = match, self.visitors(match) if match else []
            later_round = bool(match and match.rounds and match.rounds.outcomes)
            self.begun += bool(playing) and not later_round
            self._seat(now, playing)
        for player in self.hall:
            self._wish(player)
            number, device = player.visitor.number, player.hands.device
            connected = _number(player) is not None
            if connected and device is None and number not in self.waiting:
                self._queue(now, player)
        return [player for player in self.hall if player.hands.device]

    def _queue(self, now: float, player: "Player") -> None:
        assert isinstance(player.hands, PhoneHands)
        before = player.hands.handset.before
        if before >= 0:
            called = PLACES if self.match is None else 0  # whose turn it is, and who has no match yet
            self.waiting[player.visitor.number] = now, self.begun, (called + before) // PLACES + 1

    def _seat(self, now: float, playing: list[int]) -> None:
        for number in playing:
            if number in self.waiting:
                since, begun, fair = self.waiting.pop(number)
                wait = Wait(number, round(now - since, 1), self.begun - begun, fair)
                self.stage.watch.ledger.note("wait", **vars(wait))

    def _wish(self, player: "Player") -> None:
        assert isinstance(player.hands, PhoneHands)
        rng, handset = self.stage.rng, player.hands.handset
        if _number(player) is None:
            return
        if player.visitor.number not in self.named:
            self.named.add(player.visitor.number)
            handset.wish(Wish(WishKind.NAME, text=rng.choice(NAMES)[:40]))
            handset.wish(Wish(WishKind.COLOUR, rng.randrange(8)))
        elif player.hands.device is None and rng.random() < WISHES:
            handset.wish(Wish(rng.choice((WishKind.CHEER, WishKind.GAME, WishKind.ARENA)), rng.randrange(4)))


def _number(player: "Player") -> int | None:
    assert isinstance(player.hands, PhoneHands)
    return player.hands.number
