"""Auto in the arcade: what has been learned about each person, the seats of the next match, and what a match tells."""

from collections.abc import Sequence
from dataclasses import replace

from pigaming_app.ai.auto import NAME, Estimate
from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match, victory
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.ui.input.events import Device

Person = tuple[Device, str]  # a device, as long as the same person holds it, and a game


class AutoStrengths:
    """Estimates of the people at the devices, game by game. A new game begins where the last one of the person was."""

    def __init__(self, _context: Context) -> None:
        self.estimates: dict[Person, Estimate] = {}

    def resolved(self, setup: Setup, devices: Sequence[Device | None]) -> Setup:
        """The setup with a strength on the seats that follow people: the mean of those that suit the people."""
        people = [device for device in devices if device]
        suited = [self._estimate(device, setup.game).strength for device in people] or [Estimate().strength]
        brain = AUTO[round(sum(suited) / len(suited))]
        one, two, three, four = (_resolved(seat, brain) for seat in setup.seats)
        return replace(setup, seats=(one, two, three, four))

    def learn(self, match: Match, devices: Sequence[Device | None], without: Sequence[int] = ()) -> None:
        """Learn from a match that is over; nothing about the seats `without`, for which an AI has driven."""
        seats = match.setup.seats
        for seat, device in enumerate(devices):
            if not device or seat in without:
                continue
            efforts = [
                brain.mind.effort.now
                for brain, other in zip(match.brains, seats, strict=True)
                if other.brain in AUTO and other.team != seats[seat].team and isinstance(brain, BrainPlayer)
                if hasattr(brain.mind, "effort")
            ]
            if efforts:
                won = victory(match.game, match.state, seat)
                self._estimate(device, match.setup.game).update(sum(efforts) / len(efforts), won)

    def forget(self, device: Device | None = None) -> None:
        """Somebody else comes to a device, or to all of them."""
        self.estimates = {key: known for key, known in self.estimates.items() if device and key[0] != device}

    def _estimate(self, device: Device, game: str) -> Estimate:
        if (device, game) not in self.estimates:
            known = [estimate.strength for (other, _), estimate in self.estimates.items() if other == device]
            self.estimates[device, game] = Estimate(known[-1]) if known else Estimate()
        return self.estimates[device, game]


def _resolved(seat: Seat, brain: str) -> Seat:
    return replace(seat, brain=brain) if seat.brain == NAME or seat.brain in AUTO else seat
