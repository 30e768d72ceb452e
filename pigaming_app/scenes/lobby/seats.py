"""Seat assignment before a match: people with their devices, AIs, teams. Model only: no drawing, no sound.

FIRE takes the next empty seat, which determines the player number. The last AI makes room for a person.
"""

from dataclasses import dataclass, field, replace

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.games.game import ALLIES, FREE, PAIRS, Seat
from pigaming_app.ui.input.events import Device

EMPTY, HUMAN, AI = "empty", "human", "ai"
REAL, TEAM, DRIVE, RIVALS = "real", "team", "drive", "rivals"  # rows of a person's card, top to bottom
PLACES = 4


@dataclass
class SeatState:
    """One seat. `team`: 0 or 1, used only with teams; `real`: its robot stands on the mat; `filled`: an AI that nobody
    asked for; `row`: the row that its player has selected, empty: none yet.
    """

    kind: str = EMPTY
    device: Device | None = None
    ready: bool = False
    strength: str = "level3"
    team: int = 0
    real: bool = False
    filled: bool = False
    row: str = ""


@dataclass
class LobbySeats:
    """The four seats. `strength`: of the next AI, one of `rivals`; `sides`: team mode of the game.

    `mat`: a mat for real robots is available.
    """

    strength: str = "level3"
    teams: bool = False
    team_mode: str = FREE
    rivals: tuple[str, ...] = LEVELS
    mat: bool = False
    places: list[SeatState] = field(default_factory=lambda: [SeatState(team=i % 2) for i in range(PLACES)])

    def __post_init__(self) -> None:
        self._apply_mode()

    # ---- queries

    def seat_of(self, device: Device) -> int | None:
        """The seat of a device, if any."""
        return next((i for i, place in enumerate(self.places) if place.device == device), None)

    def of_kind(self, kind: str) -> list[int]:
        """Seats of a kind: EMPTY, HUMAN or AI."""
        return [i for i, place in enumerate(self.places) if place.kind == kind]

    @property
    def robots(self) -> int:
        """Number of occupied seats."""
        return PLACES - len(self.of_kind(EMPTY))

    @property
    def full(self) -> bool:
        """True if four people are seated."""
        return len(self.of_kind(HUMAN)) == PLACES

    @property
    def waiting(self) -> list[int]:
        """Seats of people who are not ready."""
        return [i for i in self.of_kind(HUMAN) if not self.places[i].ready]

    @property
    def one_team(self) -> bool:
        """True if teams are on and all occupied seats are in the same team."""
        return self.teams and len({place.team for place in self.places if place.kind != EMPTY}) < 2

    def seats(self) -> tuple[Seat, Seat, Seat, Seat]:
        """The seats in the form a `Setup` needs."""
        one, two, three, four = (Seat(self._brain(place), self._team(i)) for i, place in enumerate(self.places))
        return one, two, three, four

    def devices(self) -> list[Device | None]:
        """Device of each seat."""
        return [place.device for place in self.places]

    def real(self) -> list[int]:
        """Occupied seats with real robots."""
        return [i for i, place in enumerate(self.places) if self.mat and place.real and place.kind != EMPTY]

    def rows(self, seat: int) -> list[str]:
        """The rows that the person on a seat can change, top to bottom. The last one is the strength of all AIs."""
        there = {REAL: self.mat, TEAM: self.teams, DRIVE: self.places[seat].device, RIVALS: self.of_kind(AI)}
        return [row for row, available in there.items() if available]

    def row(self, seat: int) -> str:
        """The selected row of a person: initially the team, else the driving style."""
        rows, chosen = self.rows(seat), self.places[seat].row
        return chosen if chosen in rows else TEAM if TEAM in rows else DRIVE

    # ---- changes

    def step_row(self, seat: int, delta: int) -> bool:
        """Select the next row up or down, if there is one. True if changed."""
        rows = self.rows(seat)
        now = rows.index(self.row(seat))
        self.places[seat].row = rows[max(0, min(len(rows) - 1, now + delta))]
        return rows.index(self.row(seat)) != now

    def swap(self, seat: int) -> None:
        """Toggle between the real and the simulated robot of a seat."""
        self.places[seat].real = not self.places[seat].real

    def join(self, device: Device) -> int | None:
        """Seat a device on the next empty seat, else on the last AI's. Returns the seat, None if four people are
        seated. AIs that nobody asked for leave.
        """
        self._remove_filled()
        seat = next(iter(self.of_kind(EMPTY)), None)
        if seat is None:
            seat = next(iter(reversed(self.of_kind(AI))), None)
        if seat is not None:
            self.places[seat] = SeatState(HUMAN, device, team=self._smaller_team(seat), real=self.places[seat].real)
        return seat

    def seat(self, seat: int, driver: Device | str) -> None:
        """Seat a device, or an AI of that strength (the default strength if it is not in `rivals`)."""
        place = (
            SeatState(HUMAN, driver) if isinstance(driver, Device) else SeatState(AI, strength=self._strength(driver))
        )
        self.places[seat] = replace(place, team=self._smaller_team(seat), real=self.places[seat].real)

    def leave(self, seat: int) -> None:
        """Empty a seat; with the last person, the AIs that nobody asked for leave too."""
        self.places[seat] = SeatState(team=self.places[seat].team, real=self.places[seat].real)
        if not self.of_kind(HUMAN):
            self._remove_filled()

    def add_ai(self, seat: int | None = None) -> int | None:
        """Add an AI on a seat, or on the next empty one. Returns the seat, None if all are taken."""
        seat = next(iter(self.of_kind(EMPTY)), None) if seat is None else seat
        if seat is not None:
            real = self.places[seat].real
            self.places[seat] = SeatState(AI, strength=self.strength, team=self._smaller_team(seat), real=real)
        return seat

    def remove_ais(self) -> int | None:
        """Remove all AIs. A single person keeps one opponent, whose seat is returned."""
        for seat in self.of_kind(AI):
            self.leave(seat)
        return self.add_ai() if self.robots == 1 else None

    def offer(self, rivals: tuple[str, ...]) -> None:
        """Offer these AIs from now on; what a seat has stays."""
        kept = (place.strength for place in self.places if place.strength in self.rivals)
        self.rivals = tuple(dict.fromkeys((*rivals, *kept, self.strength)))

    def change_strength(self, delta: int, seat: int | None = None) -> bool:
        """Step the strength of one seat's AI, or of all, through `rivals`; it becomes the default. True if changed."""
        chosen = self.of_kind(AI) if seat is None else [seat]
        if not chosen:
            return False
        now, count = self.rivals.index(self.places[chosen[0]].strength) + delta, len(self.rivals)
        self.strength = self.rivals[now % count if seat is not None else max(0, min(count - 1, now))]
        changed = any(self.places[i].strength != self.strength for i in chosen)
        for i in chosen:
            self.places[i].strength = self.strength
        return changed

    def reset_ready(self) -> None:
        """Reset everyone's readiness."""
        for place in self.places:
            place.ready = False

    def add_opponents(self) -> list[int]:
        """Fill all seats for a single person, or for a pair without opponents. Returns the seats."""
        alone = self.robots == 1 or (self.team_mode == PAIRS and self.robots > 1 and self.one_team)
        added = [self.add_ai(seat) for seat in self.of_kind(EMPTY)] if alone else []
        seats = [seat for seat in added if seat is not None]
        for seat in seats:
            self.places[seat].filled = True
        return seats

    def change_team(self, seat: int) -> None:
        """Move a robot to the other team; if that is full, one of its robots changes sides, preferably an AI."""
        place = self.places[seat]
        place.team = 1 - place.team
        mates = [mate for mate in self.places if mate is not place and mate.kind != EMPTY and mate.team == place.team]
        if self.team_mode == PAIRS and len(mates) > 1:
            sorted(mates, key=lambda mate: mate.kind == AI)[-1].team = 1 - place.team

    def _remove_filled(self) -> None:
        for seat, place in enumerate(self.places):
            if place.filled:
                self.places[seat] = SeatState(team=place.team, real=place.real)

    def change_mode(self, team_mode: str) -> None:
        """Adapt to another team mode: pairs of allies become two sides, and whoever would be alone gets opponents."""
        if team_mode == self.team_mode:
            return
        self.team_mode = team_mode
        self._apply_mode()
        taken = [place for place in self.places if place.kind != EMPTY]
        if self.team_mode == PAIRS and sum(place.team for place in taken) not in (1, 2):
            for i, place in enumerate(taken):
                place.team = i % 2
        if self.team_mode != ALLIES:
            self.add_opponents()

    def _apply_mode(self) -> None:
        self.teams = self.team_mode == PAIRS or (self.teams and self.team_mode == FREE)

    def _smaller_team(self, seat: int) -> int:
        """The team with fewer robots; the seat's current one if equal."""
        others = [place.team for i, place in enumerate(self.places) if place.kind != EMPTY and i != seat]
        more = others.count(0) - others.count(1)
        return self.places[seat].team if more == 0 else int(more > 0)

    def _team(self, seat: int) -> int:
        """The team in which a seat plays."""
        if self.team_mode == ALLIES:
            return 0
        return self.places[seat].team if self.teams else seat

    def _strength(self, strength: str) -> str:
        return strength if strength in self.rivals else self.strength

    def _brain(self, place: SeatState) -> str:
        return {EMPTY: "off", HUMAN: "human"}.get(place.kind, place.strength)
