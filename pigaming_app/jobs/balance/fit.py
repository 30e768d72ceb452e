"""The traits of people from replays: of each seat, and the means of each device and age band."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pigaming_app.ai.people.fit.calibration import FittedTrait
from pigaming_app.ai.people.fit.people import FittedPerson, GroupMean, NotFitted, fitted, mean_of, play_of
from pigaming_app.ai.people.fit.wishes import Watched
from pigaming_app.ai.people.matches import is_person
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.scenes.files import load_replay

UNITS = {
    "reaction": "s", "decisions": "a second", "timing": "s", "aim": "rad", "prediction": "", "lapses": "a minute",
    "lapse": "s", "stick": "rad", "tactics": "",
}  # fmt: skip
NOT_ENOUGH = "not enough play"


@dataclass
class SeatedPerson:
    """A person in some replays. `device` and `age`: as they said, or empty; `fault`: why nothing was found."""

    files: list[str]
    game: str
    seat: int
    device: str = ""
    age: str = ""
    driving: str | None = None
    plays: list[Watched] = field(default_factory=list)
    fitted: FittedPerson | None = None
    fault: str = ""


def run(files: Sequence[str], together: bool, as_json: bool) -> int:
    """Fit and print; 1 if nothing was found. `together`: the same seat is the same person in all files."""
    if not files:
        raise Refusal("people fit needs the files of replays")
    players = [player for name in files for player in players_of(Path(name))]
    if together:
        players = merged(players)
    for player in players:
        fit(player)
    groups = groups_of(players)
    if as_json:
        print(
            json.dumps({"people": [*map(plain, players)], "groups": [plain_group(*group) for group in groups.items()]})
        )
    else:
        print("\n".join([*lines(players), *group_lines(groups)]))
    return int(not any(player.fitted for player in players))


def players_of(path: Path) -> list[SeatedPerson]:
    """The people of a file with what they did. Raises Refusal."""
    with refused(ReplayError):
        replay = load_replay(path)
    game, people = replay.setup.game, seats_of(replay)
    if not people:
        raise Refusal(f"{path.name}: no people on its seats")
    players = [SeatedPerson([path.name], game, seat, *about) for seat, about in people.items()]
    for player in players:
        try:
            player.plays.append(play_of(replay, player.seat))
        except NotFitted as fault:
            player.fault = str(fault)
    return players


def seats_of(replay: Replay) -> dict[int, tuple[Any, ...]]:
    """Device, age band and driving style of each seat of a person, as far as they said them."""
    if told := getattr(replay, "participants", ()):
        return {one.seat: (one.device, one.age, one.driving) for one in told}
    game, seats = replay.setup.game, enumerate(replay.setup.seats)
    return {i: () for i, seat in seats if seat.brain == "human" or is_person(game, seat.brain)}


def merged(players: Sequence[SeatedPerson]) -> list[SeatedPerson]:
    """The players with the plays of all files, by game and seat."""
    found: dict[tuple[str, int], SeatedPerson] = {}
    for player in players:
        one = found.setdefault((player.game, player.seat), player)
        if one is not player:
            one.files += player.files
            one.plays += player.plays
    return [*found.values()]


def fit(player: SeatedPerson) -> None:
    """Find the traits of a player, or the reason why not."""
    if not player.plays:
        return
    try:
        player.fitted = fitted(player.game, player.plays, player.driving)
    except NotFitted as fault:
        player.fault = str(fault)


def groups_of(players: Sequence[SeatedPerson]) -> dict[tuple[str, str, str], GroupMean]:
    """Means by game, device and age band of those who said them."""
    groups: dict[tuple[str, str, str], list[FittedPerson]] = {}
    for player in players:
        if player.fitted and player.device:
            groups.setdefault((player.game, player.device, player.age), []).append(player.fitted)
    return {name: mean_of(people) for name, people in sorted(groups.items())}


# --------------------------------------------------------------------------------------------------------------- output


def lines(players: Sequence[SeatedPerson]) -> Iterator[str]:
    """A paragraph for each person."""
    for player in players:
        files = player.files[0] if len(player.files) == 1 else f"{len(player.files)} files"
        yield f"{files}, seat {player.seat + 1}" + "".join(f", {word}" for word in (player.device, player.age) if word)
        if player.fitted is None:
            yield f"  {player.fault}"
            continue
        yield f"  {player.fitted.minutes:.1f} minutes of {player.game}, nearest to {player.fitted.nearest}"
        yield from trait_lines(player.fitted.estimates())


def group_lines(groups: Mapping[tuple[str, str, str], GroupMean]) -> Iterator[str]:
    """A paragraph for each device and age band."""
    for names, mean in groups.items():
        yield f"{', '.join(names)}: mean of {mean.people}, {mean.minutes:.1f} minutes"
        yield from trait_lines(mean.traits)


def trait_lines(traits: Mapping[str, FittedTrait | None]) -> Iterator[str]:
    """A line for each trait with its interval."""
    for name, found in traits.items():
        told = f"{found.value:.3g} {UNITS[name]:9} [{found.low:.3g}, {found.high:.3g}]" if found else NOT_ENOUGH
        yield f"  {name:11}{told}"


def plain(player: SeatedPerson) -> dict[str, Any]:
    """A person for JSON."""
    known = {
        "files": player.files,
        "game": player.game,
        "seat": player.seat + 1,
        "device": player.device,
        "age": player.age,
    }
    if player.fitted is None:
        return known | {"fault": player.fault}
    found = player.fitted
    more = {"driving": found.driving, "minutes": found.minutes, "nearest": found.nearest}
    return known | more | {"traits": plain_traits(found.estimates())}


def plain_group(names: tuple[str, str, str], mean: GroupMean) -> dict[str, Any]:
    """A group for JSON."""
    known = dict(zip(("game", "device", "age"), names, strict=True))
    return known | {"people": mean.people, "minutes": mean.minutes, "traits": plain_traits(mean.traits)}


def plain_traits(traits: Mapping[str, FittedTrait | None]) -> dict[str, dict[str, float] | None]:
    """Traits for JSON; null: not enough play."""
    return {name: found._asdict() if found else None for name, found in traits.items()}
