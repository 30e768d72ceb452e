"""Who sits where before a match: people by their devices, AIs, and teams. No drawing, no sounds: only what is so.

Whoever presses fire gets the next empty seat, and so becomes player 1, 2, 3 or 4. The last AI makes room for a person.
"""

from dataclasses import dataclass, field, replace

from pigaming_app.ai import STRENGTHS
from pigaming_app.games.game import FREE, PAIRS, Seat
from pigaming_app.ui.input.events import Device

EMPTY, HUMAN, AI = "empty", "human", "ai"
PLACES = 4


@dataclass
class SeatState:
    """One seat. `team` is 0 or 1 and counts only while there are teams; `real`: its robot stands on the mat."""

    kind: str = EMPTY
    device: Device | None = None
    ready: bool = False
    strength: str = "normal"
    team: int = 0
    real: bool = False


@dataclass
class Seats:
    """The four seats. `strength` is that of the next AI, one of `rivals`; `sides`: what teams the game knows.

    `mat`: there is a mat on which the robots of seats can stand.
    """

    strength: str = "normal"
    teams: bool = False
    sides: str = FREE
    rivals: tuple[str, ...] = STRENGTHS
    mat: bool = False
    places: list[SeatState] = field(default_factory=lambda: [SeatState(team=i % 2) for i in range(PLACES)])

    def __post_init__(self) -> None:
        self.teams = self.sides == PAIRS or (self.teams and self.sides == FREE)

    # ---- what is so

    def of(self, device: Device) -> int | None:
        """The seat of a device."""
        return next((i for i, place in enumerate(self.places) if place.device == device), None)

    def like(self, kind: str) -> list[int]:
        """The seats of a kind: EMPTY, HUMAN or AI."""
        return [i for i, place in enumerate(self.places) if place.kind == kind]

    @property
    def robots(self) -> int:
        """How many will play."""
        return PLACES - len(self.like(EMPTY))

    @property
    def waiting(self) -> list[int]:
        """People who are not ready yet."""
        return [i for i in self.like(HUMAN) if not self.places[i].ready]

    @property
    def one_team(self) -> bool:
        """There are teams, and all who play are in one of them."""
        return self.teams and len({place.team for place in self.places if place.kind != EMPTY}) < 2

    def seats(self) -> tuple[Seat, Seat, Seat, Seat]:
        """The seats as a setup wants them."""
        one, two, three, four = (
            Seat(self._brain(place), place.team if self.teams else i) for i, place in enumerate(self.places)
        )
        return one, two, three, four

    def devices(self) -> list[Device | None]:
        """Who drives each seat."""
        return [place.device for place in self.places]

    def real(self) -> list[int]:
        """The seats in the match whose robots are real."""
        return [i for i, place in enumerate(self.places) if self.mat and place.real and place.kind != EMPTY]

    # ---- what people do

    def swap(self, seat: int) -> None:
        """A real robot for a simulated one, or the other way round."""
        self.places[seat].real = not self.places[seat].real

    def join(self, device: Device) -> int | None:
        """Give a device the next empty seat, or the last AI's; None: four people sit there already."""
        seat = next(iter(self.like(EMPTY)), None)
        if seat is None:
            seat = next(iter(reversed(self.like(AI))), None)
        if seat is not None:
            self.places[seat] = SeatState(HUMAN, device, team=self._wanted(seat), real=self.places[seat].real)
        return seat

    def seat(self, seat: int, driver: Device | str) -> None:
        """Give an empty seat to a device, or to an AI of that strength, or of the usual one where it is no rival."""
        place = (
            SeatState(HUMAN, driver) if isinstance(driver, Device) else SeatState(AI, strength=self._strength(driver))
        )
        self.places[seat] = replace(place, team=self._wanted(seat), real=self.places[seat].real)

    def leave(self, seat: int) -> None:
        """Empty a seat."""
        self.places[seat] = SeatState(team=self.places[seat].team, real=self.places[seat].real)

    def add(self, seat: int | None = None) -> int | None:
        """Put an AI on a seat, or on the next empty one; answers which, None: all are taken."""
        seat = next(iter(self.like(EMPTY)), None) if seat is None else seat
        if seat is not None:
            real = self.places[seat].real
            self.places[seat] = SeatState(AI, strength=self.strength, team=self._wanted(seat), real=real)
        return seat

    def clear(self) -> None:
        """Send all AIs away."""
        for seat in self.like(AI):
            self.leave(seat)

    def strengthen(self, by: int, seat: int | None = None) -> bool:
        """Make the AI of one seat, or all, the next or last of `rivals`; the next ones will be like it."""
        chosen = self.like(AI) if seat is None else [seat]
        if not chosen:
            return False
        now, count = self.rivals.index(self.places[chosen[0]].strength) + by, len(self.rivals)
        self.strength = self.rivals[now % count if seat is not None else max(0, min(count - 1, now))]
        changed = any(self.places[one].strength != self.strength for one in chosen)
        for one in chosen:
            self.places[one].strength = self.strength
        return changed

    def unready(self) -> None:
        """Nobody is ready any more."""
        for place in self.places:
            place.ready = False

    def fill(self) -> list[int]:
        """Company for one person alone, or for a pair without rivals: an AI, or in games for four all seats; which."""
        lonely = self.robots == 1 or (self.sides == PAIRS and self.robots > 1 and self.one_team)
        if not lonely:
            return []
        first = next(place for place in self.places if place.kind != EMPTY)
        wanted = 1 if self.sides == FREE else len(self.like(EMPTY))
        added = [seat for seat in (self.add() for _ in range(wanted)) if seat is not None]
        if self.sides == FREE:
            self.places[added[0]].team = 1 - first.team
        return added

    def change_team(self, seat: int) -> None:
        """Send a robot to the other team; if that has two already, one of them comes over, an AI if there is one."""
        place = self.places[seat]
        place.team = 1 - place.team
        mates = [one for one in self.places if one is not place and one.kind != EMPTY and one.team == place.team]
        if self.sides == PAIRS and len(mates) > 1:
            sorted(mates, key=lambda one: one.kind == AI)[-1].team = 1 - place.team

    def _wanted(self, seat: int) -> int:
        """The team with fewer robots; the seat's own where they are equal."""
        others = [place.team for i, place in enumerate(self.places) if place.kind != EMPTY and i != seat]
        more = others.count(0) - others.count(1)
        return self.places[seat].team if more == 0 else int(more > 0)

    def _strength(self, wished: str) -> str:
        return wished if wished in self.rivals else self.strength

    def _brain(self, place: SeatState) -> str:
        return {EMPTY: "off", HUMAN: "human"}.get(place.kind, place.strength)
