"""Tables of networks against others."""

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.start import VARIANTS
from tests.bench import network_football, network_races, network_wins
from tests.bench.figures.duels import LEAST

GUNNER, RACER = "assets/brains/pitanks.npz", "assets/brains/race.npz"
EACH = 100  # matches or races of a kind


def wins(share: float) -> list[list[str]]:
    """Fewest wins of the network of the PiTanks levels, of EACH, by rule set and kind of match."""
    matches, minutes = (EACH, network_wins.MINUTES) if share == 1.0 else (1, LEAST)
    rivals = network_wins.RIVALS if share == 1.0 else network_wins.RIVALS[:1]
    network, seeds = find_brain("pitanks", GUNNER), range(10001, 10001 + matches)
    fewest: dict[str, dict[str, int]] = {}
    for one in network_wins.results(network, seeds, rivals, minutes=minutes):
        row = fewest.setdefault(kind_of(one), {})
        row[one.variant] = min(one.won, row.get(one.variant, matches))
    rules = network_wins.VARIANTS
    rows = [[name, *(str(row[one]) for one in rules)] for name, row in fewest.items()]
    return [["fewest wins", *(f"`{one}`" for one in rules)], *rows]


def kind_of(one: network_wins.Result) -> str:
    """The row of a result."""
    if one.kind != "duel":
        return f"{network_wins.WORDS[one.kind]} `{one.rival}`"
    return "duels, arenas never seen in training" if one.arena in network_wins.UNSEEN else "duels, arenas of the arcade"


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
    for title, level, pitches in network_football.results("net", "standard", range(30001, 30001 + count), minutes):
        won, lead = sum(one.wins for one in pitches), sum(one.lead for one in pitches) / len(pitches)
        if level == LEVELS[0]:
            rows.append([title])
        rows[-1].append(f"{won} of {count * len(pitches)}, {lead:+.1f}".replace("-", "−"))
    return rows
