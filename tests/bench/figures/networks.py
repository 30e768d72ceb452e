"""Tables of networks against others."""

from pathlib import Path

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.start import VARIANTS
from pigaming_app.games.registry import games
from tests.bench import network_football, network_races, network_wins
from tests.bench.figures.duels import LEAST

RACER = "assets/brains/race.npz"
EACH = 100  # matches or races of a kind


def wins(share: float) -> list[list[str]]:
    """Fewest wins of the network of PiTanks by rule set and kind of match, of EACH, and the limits that it misses."""
    matches, minutes = (EACH, network_wins.MINUTES) if share == 1.0 else (1, LEAST)
    rivals = network_wins.RIVALS if share == 1.0 else network_wins.RIVALS[:1]
    network, seeds = find_brain("pitanks", "net"), range(10001, 10001 + matches)
    found = [*network_wins.results(network, seeds, rivals, minutes=minutes)]
    kinds = {
        "duels, arenas of the arcade": lambda one: one.arena in arenas("pitanks"),
        f"duels, {' and '.join(Path(one).stem for one in network_wins.UNSEEN)}": lambda one: (
            one.arena in network_wins.UNSEEN
        ),
        "pairs against `hand3`": lambda one: one.kind == "pairs",
        "one against three `hand3`": lambda one: one.kind == "four",
    }
    rules = [*games()["pitanks"].variants]
    rows = [["fewest wins", *(f"`{one}`" for one in rules)]]
    for name, fits in kinds.items():
        rows.append([name, *(str(min(one.won for one in found if one.variant == r and fits(one))) for r in rules)])
    return rows


def races(share: float) -> list[list[str]]:
    """Flying laps of the network of the race and of its rival, and races that it wins of EACH against three of them."""
    whole, brain, tracks = share == 1.0, find_brain("race", RACER), arenas("race")
    count, minutes = (EACH, network_races.MINUTES) if whole else (4, LEAST)
    cast = network_races.cast_of(brain, count)
    rows = [["", *tracks]]
    for name, kind in (("network", brain), ("`hand3`", network_races.RIVAL)):
        laps = (network_races.flying_lap(cast, kind, track, minutes) for track in tracks)
        rows.append([f"mean flying lap, {name}", *(f"{lap:.2f} s" for lap in laps)])
    for rules in VARIANTS:
        won = (network_races.wins(cast, brain, track, rules, count, 20001, minutes)[0] for track in tracks)
        rows.append([f"wins of {EACH}, `{rules}`", *map(str, won)])
    return rows


def football(share: float) -> list[list[str]]:
    """Wins of the network of Robot Football against the levels, of all matches on all pitches, and its mean lead."""
    count, minutes = (60, None) if share == 1.0 else (1, LEAST)
    rows = [["wins, mean lead", *(f"`{one}`" for one in LEVELS)]]
    for title in network_football.SIZES:
        rows.append([title])
    for title, _, pitches in network_football.results("net", "standard", range(30001, 30001 + count), minutes):
        won, lead = sum(one.wins for one in pitches), sum(one.lead for one in pitches) / len(pitches)
        row = next(one for one in rows if one[0] == title)
        row.append(f"{won} of {count * len(pitches)}, {lead:+.1f}".replace("-", "−"))
    return rows
