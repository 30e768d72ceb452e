"""Tables of duels and leagues."""

from itertools import pairwise

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.learning.league import duel, league
from pigaming_app.games.arenas import shipped_arenas

AGAINST_HAND2 = ("q1", "hand3", "q2", "hand2", "fsm", "hand1", "classic")
PAIRS = (("hand3", "hand2"), ("hand2", "hand1"), ("hand1", "random"))
RULES = ("pickups", "party")
STEPS = (
    ("PiTanks", "pitanks", "pickups", 1000, 92001),
    ("PiTanks", "pitanks", "party", 1000, 92001),
    ("Robot Factory", "factory", "standard", 600, 93001),
    ("Robot Factory", "factory", "party", 600, 93001),
    ("Robot Race", "race", "standard", 200, 64001),
    ("Robot Race", "race", "party", 200, 64001),
)
LEAST = 0.01  # minutes of a match in a small run


def some(matches: int, share: float) -> tuple[int, float | None]:
    """Matches and minutes of a share of the work: all of it, or two short ones."""
    return (matches, None) if share == 1.0 else (2, LEAST)


def result(left: str, right: str, matches: int, share: float, rules: str, arena: str | None = None) -> str:
    """Wins, ties and losses of `left` in PiTanks."""
    count, minutes = some(matches, share)
    met = duel("pitanks", left, right, count, 1, minutes, arena, rules)
    return f"{met.wins}/{met.ties}/{met.losses}"


def against_hand2(share: float) -> list[list[str]]:
    """Every machine and table of PiTanks against `hand2`."""
    head = ["against `hand2`", *(f"`{rules}`" for rules in RULES)]
    return [head, *([f"`{one}`", *(result(one, "hand2", 200, share, r) for r in RULES)] for one in AGAINST_HAND2)]


def pairs(share: float) -> list[list[str]]:
    """Machines of PiTanks against the next weaker."""
    head = ["", *(f"`{rules}`" for rules in RULES)]
    return [head, *([f"`{a}` – `{b}`", *(result(a, b, 400, share, r) for r in RULES)] for a, b in PAIRS)]


def ties(share: float) -> list[list[str]]:
    """Ties of machines with their likes by arena, and wins of the weakest against `random`, in %."""
    places = shipped_arenas("pitanks")
    rows = [["", *places]]
    for brain in ("hand1", "hand2", "hand3"):
        found = [result(brain, brain, 200, share, "pickups", arena).split("/") for arena in places]
        rows.append([f"`{brain}` – `{brain}`, ties", *(percent(int(one[1]), one) for one in found)])
    found = [result("hand1", "random", 200, share, "pickups", arena).split("/") for arena in places]
    return [*rows, ["`hand1` – `random`, wins", *(percent(int(one[0]), one) for one in found)]]


def percent(count: int, result: list[str]) -> str:
    """A share of a result in %."""
    return f"{100 * count / sum(map(int, result)):.3g}"


def steps(share: float) -> list[list[str]]:
    """Rating steps from level to level, and ties of neighbours."""
    rows = [["", "matches a pair", *(f"{low[-1]} to {up[-1]}" for low, up in pairwise(LEVELS)), "ties"]]
    for title, game, rules, matches, seed in STEPS:
        count, minutes = some(matches, share)
        found = league(game, LEVELS, count, seed, minutes, variant=rules)
        rating = {row.brain: row.rating.rating for row in found.standings}
        climb = [f"{rating[up] - rating[low]:.0f}" for low, up in pairwise(LEVELS)]
        level = [d.ties / d.matches for d in found.duels if int(d.right[-1]) - int(d.left[-1]) == 1]
        ties = ", ".join(f"{100 * one:.0f}" for one in level) + " %" if any(level) else "none"
        rows.append([f"{title}, `{rules}`", f"{matches:,}", *climb, ties])
    return rows


def factory(share: float) -> list[list[str]]:
    """The league of the machines of Robot Factory."""
    count, minutes = some(40, share)
    found = league("factory", ["random", "hand1", "hand2", "hand3"], count, 1, minutes)
    names = ["hand3", "hand2", "hand1", "random"]
    met = {(d.left, d.right): f"{d.wins}/{d.ties}/{d.losses}" for d in found.duels}
    met |= {(d.right, d.left): f"{d.losses}/{d.ties}/{d.wins}" for d in found.duels}
    rating = {row.brain: f"{row.rating.rating:+.0f}".replace("-", "−") for row in found.standings}
    head = ["", "rating", *(f"`{name}`" for name in names)]
    return [head, *([f"`{a}`", rating[a], *(met.get((a, b), "–") for b in names)] for a in names)]


def football(share: float) -> list[list[str]]:
    """Ratings of the levels and the network of Robot Football."""
    count, minutes = some(200, share)
    brains = [*LEVELS, "net"]
    found = league("football", brains, count, 60001, minutes, variant="party")
    rating = {row.brain: f"{row.rating.rating:+.0f}".replace("-", "−") for row in found.standings}
    return [["", *(f"`{one}`" for one in brains)], ["points", *(rating[one] for one in brains)]]
