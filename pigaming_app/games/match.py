"""The tick of any game on any plant: sense, think, judge, drive.

The plant supplies the poses; the brain on each seat sets its action; the game applies its rules and requests speeds;
the plant drives. A game never moves a robot, and a seat's brain can be replaced between any two ticks.
"""

from collections.abc import Callable
from typing import Any, Protocol

from pigaming_app.games.arenas import load
from pigaming_app.games.game import Game, Outcome, Row, Setup
from pigaming_app.games.registry import games
from pigaming_app.games.simple import MatchState, team_points
from pigaming_app.sim.action import set_action
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.world import DT, ROBOTS, Action


class Brain(Protocol):
    """The player on a seat, human or AI."""

    def think(self, state: MatchState, seat: int) -> None:
        """Set `state.actions[seat]` for this tick."""


class IdlePlayer:
    """A player that never moves; also the player of an empty seat."""

    def think(self, state: MatchState, seat: int) -> None:
        set_action(state.actions[seat], 0.0, 0.0, 0, 0)


class Match:
    """A match of any game. Every seat has an `IdlePlayer` until `sit` replaces it."""

    def __init__(
        self, setup: Setup, plant: Plant | Callable[[Any], Plant] = SimPlant, arena: Arena | None = None
    ) -> None:
        """`plant`: a plant, or its factory, called with the match's state. Raises ArenaError."""
        self.setup = setup
        self.game = games()[setup.game]
        self.arena = arena or load(setup.game, setup.arena)
        self.state: Any = self.game.state()
        self.game.start(self.state, self.arena, setup)
        self.plant = plant(self.state) if callable(plant) else plant
        self.plant.place([(robot.x, robot.y, robot.heading) for robot in self.state.robots])
        self.brains: list[Brain] = [IdlePlayer() for _ in range(ROBOTS)]
        self.log = ActionLog()
        self.series: list[list[tuple[float, int]]] = [[(0.0, 0)] for _ in range(ROBOTS)]

    def sit(self, seat: int, brain: Brain) -> None:
        """Replace the brain of a seat, from the next tick on."""
        self.brains[seat] = brain

    @property
    def over(self) -> bool:
        return bool(self.state.over)

    @property
    def seconds(self) -> float:
        """Match time so far."""
        return self.state.tick * DT  # type: ignore[no-any-return]

    @property
    def overtime(self) -> bool:
        """True while the match goes on after its regular time."""
        return not self.over and self.state.tick >= self.state.rules.ticks

    @property
    def seconds_left(self) -> float:
        """Of the regular time; from its end on, of the overtime, if there is one."""
        began = self.overtime or self.state.tick > self.state.rules.ticks
        most = self.game.variants[self.setup.variant].overtime if began else 0.0
        return max(0.0, self.setup.minutes * 60 + most - self.seconds)

    def tick(self) -> None:
        """Advance by DT (1/50 s)."""
        state = self.state
        for robot, sighting in zip(state.robots, self.plant.sense(), strict=True):
            robot.x, robot.y, robot.heading = sighting.x, sighting.y, sighting.heading
        for seat in range(ROBOTS):
            self.brains[seat].think(state, seat)
        self.log.append(state.actions)
        self.game.judge(state)
        if self.setup.sudden_death and _is_decided(self.game, state):
            state.over = 1
        self.plant.drive([(robot.requested_linear, robot.requested_angular) for robot in state.robots], DT)
        for robot, line in zip(state.robots, self.series, strict=True):
            if robot.score != line[-1][1]:
                line.append((state.tick * DT, robot.score))

    def outcome(self) -> Outcome:
        """The standings: final if the match is over, else as of now."""
        state, game = self.state, self.game
        keys, winners = standings(game, state)
        seats = list(keys)
        order = sorted(seats, key=lambda i: (-keys[i], state.robots[i].team, -state.robots[i].score))
        ranks = [keys[i] for i in order]
        rows = tuple(
            Row(
                seat=i,
                team=state.robots[i].team,
                place=1 + ranks.index(keys[i]),
                score=state.robots[i].score,
                stats=game.stats(state, i),
                records=game.records(state, i),
                times=game.times(state, i),
            )
            for i in order
        )
        return Outcome(rows, winners, tuple(tuple(line) for line in self.series), state.tick * DT)


def standings(game: Game, state: MatchState) -> tuple[dict[int, float], tuple[int, ...]]:
    """Ranking key of each robot that plays, by seat, and all seats of the winning team; none: a tie.

    A team without opponents wins if its ranking key is above 0.
    """
    teams = {i: state.robots[i].team for i in range(ROBOTS) if state.robots[i].present}
    keys = {i: game.ranking_key(state, i) for i in teams}
    best = max(keys.values())
    leaders = tuple(i for i in keys if keys[i] == best)
    alone = len(set(teams.values())) == 1
    return keys, leaders if len({teams[i] for i in leaders}) == 1 and (best > 0.0 or not alone) else ()


def victory(game: Game, end: Any, seat: int) -> float:
    """The share of a seat's team in the victory: 1, of n level teams at the top 1/n, else 0."""
    keys, winners = standings(game, end)
    if winners:
        return float(seat in winners)
    best = {end.robots[i].team for i, key in keys.items() if key == max(keys.values())}
    return 1.0 / len(best) if end.robots[seat].team in best and len(best) > 1 else 0.0


def _is_decided(game: Game, state: MatchState) -> bool:
    """True once a sudden death has a winner: one team alone has the most points, or somebody has the first time."""
    seats = [i for i in range(ROBOTS) if state.robots[i].present]
    if game.timed:
        return any(game.times(state, seat) for seat in seats)
    points = {state.robots[seat].team: team_points(state, seat) for seat in seats}
    return [*points.values()].count(max(points.values())) == 1


class ActionLog:
    """The actions of every seat on every tick, three bytes per seat: two of the stick, in 64ths; buttons and aim."""

    def __init__(self) -> None:
        self.ticks = bytearray()

    def append(self, actions: list[Action]) -> None:
        """Append one tick."""
        for action in actions:
            self.ticks += bytes(
                (
                    int(action.linear * 64.0) + 64,
                    int(action.angular * 64.0) + 64,
                    action.fire + 2 * action.turbo + 4 * action.aim,
                )
            )
