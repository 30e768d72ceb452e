"""Blocks that follow from the code."""

from math import ceil
from statistics import mean

from pigaming_app import links
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.networks import policy
from pigaming_app.ai.registry import AIS
from pigaming_app.games.arenas import arenas, load, shipped_arenas, widest
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.gym.benchmark.results import by_budget
from pigaming_app.gym.benchmark.tasks import TASKS
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.sim.drivetrain import MM
from pigaming_app.sim.world import HZ, WIDTH
from pigaming_app.ui.i18n import Words
from tests.bench import benchmark_curves
from tests.bench.benchmark_curves import results_of
from tests.bench.figures import ROOT, as_markdown
from tests.bench.makespan_bound import bound

DIAMETERS = 60, 95, 120  # mm: a small robot, a 3pi, boards on the printed chassis


def where_to_get_it() -> str:
    """README's sentence on where the program can be had; nothing while there is no such place."""
    sentences = []
    if links.DOWNLOAD:
        sentences.append(
            f"Or nothing at all: [download]({links.DOWNLOAD}) the program for your system, unpack it and open it "
            "([all systems](docs/bundle.md))."
        )
    if links.CLONE:
        sentences.append(f"    git clone {links.CLONE}")
    return "\n\n".join(sentences)


def bundles() -> str:
    """The sentence of docs/bundle.md on the page of all bundles."""
    if not links.DOWNLOAD:
        return ""
    return f"[All of them]({links.DOWNLOAD}) are on one page, with `SHA256SUMS` to check them by."


def makespan_bound() -> str:
    """Proven bounds of two robots in Robot Factory."""
    floors = arenas("factory")
    bounds = (f"{bound(floor, 2, 4):.1f} s" for floor in floors)
    return as_markdown([["four pallets, two robots", *floors], ["proven bound", *bounds]])


def sizes() -> str:
    """The smallest field of every arena that comes with a game, mm wide, by the diameter of robots."""
    rows = [["arena", "widest robot", *(f"{size} mm" for size in DIAMETERS)]]
    for game in games():
        for name in shipped_arenas(game):
            radius = widest(game, load(game, name).source, SPARE)
            fields = (f"{ceil(WIDTH * size / 2.0 / radius)} mm" for size in DIAMETERS)
            title = Words("en")(f"games.{game}")
            rows.append([f"{title}, *{name}*", f"{2 * radius:.0f} px", *fields])
    return as_markdown(rows)


def games_in_numbers() -> str:
    """The table of docs/thesis.md: a column for each game."""
    known, words = games(), Words("en")
    rules = {
        name: Match(make_setup(name, ["idle"] * 4, None, None, 1, None, None, ["idle"])).state.rules for name in known
    }
    rows = [["", *(words(f"games.{name}") for name in known)]]
    rows.append(["rule sets", *(", ".join(f"`{rule}`" for rule in game.variants) for game in known.values())])
    rows.append(["arenas", *(str(len(arenas(name))) for name in known)])
    rows.append(["speed", *(f"{r.speed:g} px/s ({r.speed * MM / 1000:.2f} m/s)" for r in rules.values())])
    rows.append(["turn rate", *(f"{r.turn_rate:g} rad/s" for r in rules.values())])
    rows.append(["turbo", *(turbo(r) for r in rules.values())])
    rows.append(["levels played by a network", *(levels(name, True) for name in known)])
    rows.append(["levels written by hand", *(levels(name, False) for name in known)])
    rows.append(["other AIs", *(others(name) for name in known)])
    return as_markdown(rows)


def turbo(rules: object) -> str:
    """Factor and meter of the turbo."""
    factor, drain, refill = (getattr(rules, f"turbo_{part}") for part in ("factor", "drain", "refill"))
    return f"×{factor:g} for {1 / drain / HZ:g} s, refills in {1 / refill / HZ:g} s"


def is_network(game: str, brain: str) -> bool:
    """True if a network decides for this AI."""
    return AIS[game].kinds[brain].think.__module__ == policy.__name__


def levels(game: str, by_network: bool) -> str:
    """The levels that are networks, or those that are not."""
    return listed(level for level in LEVELS if is_network(game, level) == by_network)


def others(game: str) -> str:
    """The AIs besides the levels."""
    return listed(name for name in AIS[game].kinds if name not in LEVELS)


def listed(names: object) -> str:
    """Names in code, or a dash."""
    return ", ".join(f"`{name}`" for name in names) or "–"  # type: ignore[attr-defined]


def baselines() -> str:
    """The table of docs/benchmark.md, of the results beside it."""
    order = [*TASKS]
    rows = [["task", "method", "trainings", "score, %", "share of wins by condition, %"]]
    files = map(results_of, (ROOT / "docs/benchmark").glob("*.json"))
    for found in sorted(files, key=lambda one: (order.index(one.task), -mean(run.score for run in one.runs))):
        for score, low, high, count in by_budget(found).values():
            points = {
                name: [run.conditions[name].points for run in found.runs] for name in TASKS[found.task].conditions
            }
            each = ", ".join(f"{name} {mean(row):.0f}" for name, row in points.items())  # of 100 matches
            share = f"{100 * score:.1f} ({100 * low:.0f}–{100 * high:.0f})"
            rows.append([f"`{found.task}`", found.method, str(count), share, each])
    return as_markdown(rows)


def curves() -> str:
    """The table of learning curves in docs/benchmark.md."""
    found = benchmark_curves.curves([*benchmark_curves.filed(), *benchmark_curves.resulted()])
    budgets = sorted({budget for steps in found.values() for budget in steps})
    rows = [["score, %, by millions of decisions", *(f"{budget / 1e6:g}" for budget in budgets)]]
    for method, steps in found.items():
        cells = [steps.get(budget) for budget in budgets]
        shares = [f"{100 * one[0]:.0f} ({100 * one[1]:.0f}–{100 * one[2]:.0f})" if one else "" for one in cells]
        rows.append([benchmark_curves.METHODS[method], *shares])
    return as_markdown(rows)
