"""Tables of fairness: matches of four equal AIs, and of two."""

from collections.abc import Mapping
from typing import Any

from pigaming_app.games.arenas import arenas
from tests.bench.fairness import MEASURES, cell
from tests.bench.figures.duels import LEAST
from tests.bench.trial import Trial

Table = Mapping[str, Mapping[str, Any]]
PITANKS = ("ties", "most hits wins", "overtime", "standing still, median", "camping", "hits a match")
FOOTBALL = (
    *("ties", "wins of the left", "wins of the right", "points, a match", "goals, a match", "decided in overtime"),
    *("won without more goals", "own goals, of all", "assists, of all goals", "passes, a match", "ball at rest"),
)
FACTORY = ("seconds, mean", "ties", "standing still, median", "stolen, a match")
LEVELS = ("level1", "level3", "level5")  # of four


def measured(game: str, variant: str, brain: str, matches: int, share: float) -> Mapping[str, Table]:
    """Measures of the matches of four of these AIs: all, or a short one on each arena."""
    whole = share == 1.0
    trial = Trial(game, variant, matches if whole else len(arenas(game)), 1, [brain] * 4, None if whole else LEAST)
    return MEASURES[game](trial)


def pitanks(share: float) -> list[list[str]]:
    """Four and two `level3` by two rule sets, over all arenas."""
    columns = {
        f"{number}, `{rules}`": found[kind]["all"]
        for rules in ("party", "pickups")
        for found in [measured("pitanks", rules, "level3", 400, share)]
        for number, kind in (("four", "four robots"), ("two", "duels"))
    }
    rows = [[name, *(cell(name, found[name]) for found in columns.values())] for name in PITANKS]
    return [["", *columns], *rows, ["wins by seat", *(by_number(found, "seat") for found in columns.values())]]


def factory(share: float) -> list[list[str]]:
    """Teams of equal levels by two rule sets."""
    floors = arenas("factory")
    rows = [["", *FACTORY, f"wins of Ice: {', '.join(floors)}"]]
    for rules in ("standard", "party"):
        for brain in LEVELS:
            found = measured("factory", rules, brain, 900, share)["equal teams"]
            wins = listed(found[floor]["wins of Ice"] for floor in floors)
            rows.append([f"`{rules}`, `{brain}`", *(cell(name, found["all"][name]) for name in FACTORY), wins])
    return rows


def race(share: float) -> list[list[str]]:
    """Wins by seat and line, and changes of the lead, of equal levels on every track."""
    tracks = arenas("race")
    even = measured("race", "standard", "level3", 1600, share)["drivers"]
    rows = [["", *tracks]]
    for kind in ("seat", "line"):
        rows.append([f"`standard`, `level3`: wins by {kind}", *(by_number(even[one], kind) for one in tracks)])
    for brain in LEVELS:
        found = measured("race", "party", brain, 400, share)["drivers"]
        changes = (f"{found[one]['lead changes a race']:.1f}" for one in tracks)
        rows.append([f"`party`, `{brain}`: changes of the lead", *changes])
    return rows


def football(share: float) -> list[list[str]]:
    """Two and one `level5` a team by two rule sets, over all pitches."""
    columns = {
        f"`{rules}`, {kind}": found[kind]["all"]
        for rules in ("party", "standard")
        for found in [measured("football", rules, "level5", 960, share)]
        for kind in ("two against two", "one against one")
    }
    return [["", *columns], *([name, *(cell(name, found[name]) for found in columns.values())] for name in FOOTBALL)]


def by_number(found: Mapping[str, float], kind: str) -> str:
    """Shares of wins of seat, or line, 1, 2, ..."""
    return listed(value for name, value in found.items() if name.startswith(f"wins of {kind} "))


def listed(shares: Any) -> str:
    """Shares in whole %."""
    return ", ".join(f"{100 * one:.0f}" for one in shares) + " %"
