"""What follows a match: its note in the day log, its results, the same match again, the next round."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import Any, Protocol

from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.features.replays import replay_of
from pigaming_app.scenes.flow.auto import AutoStrengths
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.play.drivers import Drivers, new_seed
from pigaming_app.scenes.play.pause import Robots
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.results.awards.ceremony import Ceremony
from pigaming_app.scenes.results.awards.feats import Feats
from pigaming_app.scenes.results.awards.moment import AwardsMoment
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.scenes.results.scene import Results, SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.storage.day_log import PlayedMatch, now
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Device


class PlayedScene(Protocol):
    """The scene of a match."""

    context: Context
    setup: Setup
    speed: float
    game_choice: SceneFactory | None
    rounds: Rounds | None
    match: Match
    runner: MatchRunner
    drivers: Drivers
    records: bool

    @property
    def robots(self) -> Robots: ...

    @property
    def after(self) -> Callable[[Any], AfterMatch] | None: ...

    def again(self, setup: Setup, devices: Sequence[Device | None], rounds: Rounds | None) -> Scene:
        """The same match with another setup."""


class Sequel:
    """What follows the match of a scene.

    `records`: its results may be records, as those of a match that is played in real time in an arena without things.
    `stood_in`: seats of people of an event for whom an AI has driven from the start, set by `after`.
    """

    def __init__(self, scene: PlayedScene) -> None:
        self.scene, self.match, self.drivers, self.rounds = scene, scene.match, scene.drivers, scene.rounds
        self.records = scene.records and scene.speed == 1.0
        self.stood_in: Sequence[int] = ()
        self.began, self.noted = now(), False
        if self.drivers.people and scene.records:
            scene.runner.view.enable_persistence(folders().data)

    @property
    def without_records(self) -> Collection[int]:
        """Seats whose results are no records: an AI has helped, the match was not played in real time, or things stood
        in the arena.
        """
        records = self.records and not self.match.state.shifts
        return self.drivers.assisted if records else range(len(self.drivers.devices))

    def begin(self) -> None:
        """The match goes on: until its first tick it has not begun."""
        if self.match.state.tick == 0:
            self.began = now()

    def note(self) -> None:
        """Note the match in the day log, once: when it is over or left. Of several rounds, the last one is noted."""
        match, rounds, kind = self.match, self.rounds, self.scene.robots.kind
        if self.noted or match.state.tick == 0 or (match.over and rounds and not rounds.done):
            return
        self.noted = True
        if match.over:
            auto = self.scene.context.shared(AutoStrengths)
            auto.learn(match, self.drivers.devices, [*self.drivers.assisted])
        seconds = sum(outcome.seconds for outcome in rounds.outcomes) if rounds else 0.0
        if not (rounds and match.over):
            seconds += match.seconds
        seats = sum(robot.present for robot in match.state.robots)
        people = len(self.drivers.people)
        self.scene.context.day_log.add(
            PlayedMatch(self.began, match.setup.game, round(seconds, 2), people, seats - people, kind, match.over)
        )
        self.scene.robots.note()

    def rematch(self, context: Context, setup: Setup, devices: Sequence[Device | None]) -> Scene:
        """The same match with another seed, from the first round."""
        rounds = Rounds(self.rounds.best_of) if self.rounds else None
        return self._again(setup, devices, rounds)

    def next_round(self) -> Scene:
        """The next round, with the same seats."""
        devices = self.drivers.devices
        return self._again(self.match.setup, devices, self.rounds)

    def _again(self, setup: Setup, devices: Sequence[Device | None], rounds: Rounds | None) -> Scene:
        again = self.scene.context.shared(AutoStrengths).resolved(with_people(setup, devices), devices)
        return self.scene.again(again, devices, rounds)

    def scenes(self) -> tuple[EndedMatch, AfterMatch]:
        """The match, or the rounds played, and the scene that follows: the results, or the awards of people and what
        `after` makes.
        """
        if self.scene.after is None:
            results = self._results()
            return results.ended, results
        following = self.scene.after(self.scene)
        devices, outcome = tuple(self.drivers.devices), self.match.outcome()
        ended = EndedMatch(self.match.setup, outcome, devices, self.scene.runner.names, self.stood_in)
        if not (self.match.over and ended.humans):
            return ended, following
        page = Ceremony(self.scene.context, ended, True, self.feats)
        return ended, AwardsMoment(self.scene.context, page, following)

    @property
    def feats(self) -> dict[int, Feats]:
        """What each robot did."""
        return {seat: self.scene.runner.feats.feats(seat) for seat in range(len(self.drivers.devices))}

    def _results(self) -> Results:
        rounds = self.rounds if self.rounds and self.rounds.outcomes else None
        return Results(
            self.scene.context,
            rounds.outcome() if rounds else self.match.outcome(),
            self.match.setup,
            self.drivers.devices,
            self.rematch,
            rounds.done if rounds else self.match.over,
            () if rounds else self.without_records,
            self.scene.game_choice,
            replay_of(self.match),
            rounds,
            self.feats,
            self.scene.runner.names,
        )


def with_people(setup: Setup, devices: Sequence[Device | None]) -> Setup:
    """The same match with another seed; seats with a device become human."""
    drivers = [*devices, None, None, None, None]
    one, two, three, four = (replace(seat, brain="human") if drivers[i] else seat for i, seat in enumerate(setup.seats))
    return replace(setup, seats=(one, two, three, four), seed=new_seed())
