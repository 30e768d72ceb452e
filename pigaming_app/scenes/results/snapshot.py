"""A match as plain values: drivers, scores, clock; for the second screen and for phones."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from pigaming_app.games.game import PAIRS, Setup
from pigaming_app.games.match import Match, standings
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.results.headline import is_allied, team_name
from pigaming_app.ui.i18n import Words, numeral
from pigaming_app.ui.input.events import Device


@runtime_checkable
class ShownMatch(Protocol):
    """A scene that plays a match."""

    setup: Setup
    match: Match
    devices: list[Device | None]

    @property
    def runner(self) -> Any: ...

    @property
    def preparing(self) -> bool:
        """True until the robots may drive."""


@dataclass(frozen=True)
class Side:
    """A robot, or a team. `name`: of a team, a driver, or an entrant of an event, whose device is `driver`; `signs`:
    icons of the drivers, one for each seat; `score`: as shown; `leads`: alone at the top.
    """

    seats: tuple[int, ...]
    name: str
    driver: str
    signs: tuple[str, ...]
    score: str
    leads: bool


@dataclass(frozen=True)
class MatchSnapshot:
    """A match now. `sides`: best first; `alarm`: time is running out; `state`: "", "waiting", "paused" or "over";
    `round`: where it stands in an event; empty: it is no match of one.
    """

    game: str
    arena: str
    clock: str
    alarm: bool
    state: str
    round: str
    sides: tuple[Side, ...]


ALARM_SECONDS = 10


def match_of(scenes: Sequence[Scene]) -> tuple[ShownMatch | None, bool]:
    """The match on the stack, if any, and whether it is on top."""
    for above, scene in enumerate(reversed(scenes)):
        if isinstance(scene, ShownMatch):
            return scene, above == 0
    return None, False


def snapshot(
    scene: ShownMatch, words: Words, on_top: bool, entrants: Sequence[str] = (), round_name: str = ""
) -> MatchSnapshot:
    """The match of a scene now; `on_top`: no page lies over it. `entrants`: of a match of an event, by seat."""
    match, setup = scene.match, scene.setup
    left = math.ceil(match.seconds_left)
    counts_up = match.game.timed
    seconds = int(match.seconds) if counts_up else left
    state = "over" if match.over else "paused" if not on_top else "waiting" if scene.preparing else ""
    return MatchSnapshot(
        setup.game,
        arena_title(match.arena, words.language),
        f"{seconds // 60}:{seconds % 60:02}",
        not counts_up and left <= ALARM_SECONDS and not match.over,
        state,
        round_name,
        sides(scene, words, entrants),
    )


def sides(scene: ShownMatch, words: Words, entrants: Sequence[str] = ()) -> tuple[Side, ...]:
    """The robots of a match, or its teams, best first; robots of equal rank by seat."""
    match, setup = scene.match, scene.setup
    keys, _winners = standings(match.game, match.state)
    robots = match.state.robots
    groups: dict[int, list[int]] = {}
    for seat in keys:
        groups.setdefault(robots[seat].team, []).append(seat)
    pairs = match.game.variants[setup.variant].team_mode == PAIRS
    teams = is_allied(setup) or pairs or len(groups) < len(keys)
    if not teams:
        groups = {seat: [seat] for seat in keys}
    best = max(keys.values())
    alone = sum(keys[seats[0]] == best for seats in groups.values()) == 1 and len(groups) > 1
    found = []
    for team, seats in sorted(groups.items(), key=lambda group: (-keys[group[1][0]], group[0])):
        total = sum(robots[seat].score for seat in seats)
        drivers = [scene.runner.driver(seat, scene.devices[seat]) for seat in seats]
        name, driver = drivers[0][0], ""
        if teams:
            name = "" if is_allied(setup) else team_name(words, setup, team)
        if named := [entrants[i] for i in seats if i < len(entrants)]:
            name, driver = "  ".join(named), name
        signs = tuple(sign for _, sign in drivers)
        leads = alone and keys[seats[0]] == best
        found.append(Side(tuple(seats), name, driver, signs, score_text(setup, total), leads))
    return tuple(found)


def score_text(setup: Setup, score: int) -> str:
    """A score as shown: laps with their number, else points or pallets."""
    if games()[setup.game].timed and setup.goal:
        return f"{min(score, setup.goal)}/{setup.goal}"
    return numeral(score)
