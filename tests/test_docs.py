"""The pages under docs/ agree with the code: numbers, arena files, links.

Tables whose last column is headed `name` are compared row by row. The name is looked up in the code; the cell holds the
value with its unit, and in brackets the same in other units. Columns headed by names in backticks are variants or AI
levels.
"""

import re
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from itertools import pairwise, product
from math import atan2, degrees
from operator import attrgetter
from pathlib import Path
from typing import Any

import pytest

from pigaming_app.ai.brain import driving
from pigaming_app.ai.factory import steering_help as factory_help
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.pitanks.brains import HANDICAPS
from pigaming_app.ai.pitanks.classic import Parameters
from pigaming_app.ai.ppo import pitanks as fighting
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.qlearning import features as sectors
from pigaming_app.ai.qlearning import table as qlearning
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.race import steering_help
from pigaming_app.ai.registry import AIS, make_brain
from pigaming_app.games import starts
from pigaming_app.games.arenas import parse
from pigaming_app.games.factory import layout as floor
from pigaming_app.games.factory import pedestrians as walker
from pigaming_app.games.factory import rules as factory_rules
from pigaming_app.games.factory import stars, state
from pigaming_app.games.factory.state import FactoryRules as FactoryRules
from pigaming_app.games.match import Match
from pigaming_app.games.pitanks import state as pitanks
from pigaming_app.games.race import circuit, furniture, party, passages, recovery
from pigaming_app.games.race import rules as race_rules
from pigaming_app.games.race import state as race_state
from pigaming_app.games.registry import OURS, games
from pigaming_app.games.setup import make_setup
from pigaming_app.jobs.learning.train.qlearning import RIVAL
from pigaming_app.scenes.results import initials
from pigaming_app.sim import action, angles, arena, contact, drivetrain, world
from pigaming_app.sim import robot as robots
from pigaming_app.sim.record import fields_of
from pigaming_app.sim.things import mud, spec
from pigaming_app.storage.scores import table
from pigaming_app.ui.i18n import LANGUAGES, Words

race = import_module("pigaming_app.games.race.start")  # the package's own name `start` is a function

GAME_OF = {"PiTanks": "pitanks", "Robot Factory": "factory", "Robot Race": "race"}
RULES = {"pitanks": pitanks.PiTanksRules, "factory": FactoryRules, "race": race_state.RaceRules}
CONSTANTS = {  # by section of docs/games.md, the modules in which its constants are looked up
    "Units, arena, robots": (world, robots, drivetrain, action, contact, driving, steering_help),
    "PiTanks": (pitanks, arena),
    "Robot Factory": (state, walker, factory_rules, stars, factory_help),
    "Robot Race": (race, race_rules, race_state, furniture, party, recovery),
    "Things": (mud, passages, race, starts, spec),
    "Results and tables of best scores": (table, initials),
    "Arena files": (world, arena, race, circuit, floor),
}

ROOT = Path(__file__).resolve().parent.parent
GAMES_PAGE, OPPONENTS_PAGE, NETWORKS_PAGE, THESIS_PAGE = (
    ROOT / "docs" / f"{name}.md" for name in ("games", "opponents", "networks", "thesis")
)
PAGES = [ROOT / name for name in ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md")]
PAGES += sorted((ROOT / "docs").rglob("*.md"))
NEVER_NAMED = re.compile(r"\b(DESIGN|HOUSE|LOOK|HARDWARE|OPPONENTS|THESIS)\.md\b|\bshared/")
QUANTITY = re.compile(r"×?(?P<numbers>−?[\d./]+(?:(?:, | to )[\d./]+)*) ?(?P<unit>[^\d(]*)")
WORDS = {"yes": 1, "no": 0}
AS_IN_CODE = {"", "/s", "px", "px/s", "rad", "rad/s", "mm", "min", "ticks", "hits"}  # units that need no conversion


@dataclass(frozen=True)
class Row:
    """One number of a table: its section, column heading, cell text and name in the code."""

    section: str
    first: str  # heading of the first column
    column: str  # variant or strength; empty: the only one
    cell: str
    name: str


def prose(page):
    """The text of a page without code blocks."""
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def rows(text):
    """Every number of the tables that end with a column `name`."""
    section, head = "", None
    for line in text.splitlines():
        if line.startswith("## "):
            section = line[3:]
        if not line.startswith("|"):
            head = None
        elif head is None:
            head = cells(line)
        elif head[-1] == "name" and not set(line) <= set("|- "):
            first, *values, name = cells(line)
            assert len(values) == len(head) - 2, line
            assert first, line
            for column, cell in zip(head[1:-1], values, strict=True):
                yield Row(section, head[0], column.strip("`") if "`" in column else "", cell, name.strip("`"))


def match_of(game, variant=None):
    return Match(make_setup(game, ["idle", "idle"], None, None, 1, variant, None, ["idle"]))


def in_code(row):
    """The value of a row in the code. Raises KeyError for an unknown name."""
    root, _, path = row.name.partition(".")
    if root == "mind":
        return attrgetter(path)(make_brain(GAME_OF[row.first], row.column, 1).mind)
    if root == "Variant":
        game = games()[GAME_OF[row.section]]
        return attrgetter(path)(game.variants[row.column] if row.column else game.default)
    if root in ("Rules", "Game"):
        name = GAME_OF[row.section]
        return attrgetter(path)(match_of(name, row.column or None).state.rules if root == "Rules" else games()[name])
    found = [getattr(module, row.name) for module in CONSTANTS[row.section] if hasattr(module, row.name)]
    if not found:
        raise KeyError(row.name)
    assert len(set(found)) == 1, f"{row.name} means several things in {row.section}"
    return found[0]


def converted(value, unit):
    """A value of the code in a unit of the page; whole numbers shown in s are ticks. Raises KeyError if unknown."""
    ticks = isinstance(value, int)
    units = {
        "cm": lambda: value * drivetrain.MM / 10,
        "cm/s": lambda: value * drivetrain.MM / 10,
        "°": lambda: degrees(value),
        "°/s": lambda: degrees(value),
        "%": lambda: 100 * value,
        "s": lambda: value / world.HZ if ticks else value,
        "s a meter": lambda: 1 / (value * world.HZ),
    }
    return value if unit in AS_IN_CODE else units[unit]()


def quantities(cell):
    """The numbers of a cell, each list with its unit and number of decimals; the first is exact."""
    if cell in WORDS:
        return [((Fraction(WORDS[cell]),), "", 0)]
    found = []
    for match in QUANTITY.finditer(cell):
        texts = re.split(", | to ", match["numbers"].replace("−", "-"))
        numbers = tuple(map(Fraction, texts))
        if " to " in match["numbers"]:
            numbers = tuple(map(Fraction, range(int(numbers[0]), int(numbers[1]) + 1)))
        found.append((numbers, match["unit"].rstrip(" )"), len(texts[0].partition(".")[2])))
    return found


def agrees(cell, value):
    """True if a cell shows a value: the first quantity exactly, those in brackets within rounding."""
    found = quantities(cell)
    assert found, f"no number in {cell!r}"
    for i, (numbers, unit, decimals) in enumerate(found):
        values = value if isinstance(value, tuple) else (value,)
        leeway = 1e-9 if i == 0 else 0.5000001 * 10**-decimals
        wanted = [converted(one, unit) for one in values]
        if len(wanted) != len(numbers) or any(
            abs(shown - one) > leeway for shown, one in zip(map(float, numbers), wanted, strict=True)
        ):
            return False
    return True


ROWS = list(rows(GAMES_PAGE.read_text(encoding="utf-8")))


def test_every_number_on_the_page_is_that_of_the_code():
    assert not [(row, in_code(row)) for row in ROWS if not agrees(row.cell, in_code(row))]


@pytest.mark.parametrize("section", GAME_OF)
def test_every_number_of_the_rules_is_on_the_page(section):
    named = {row.name for row in ROWS if row.section == section}
    assert {f"Rules.{field.name}" for field in fields_of(RULES[GAME_OF[section]])} <= named


def test_every_variant_and_strength_has_its_column():
    columns = {row.column for row in ROWS if row.section == "PiTanks" and row.column}
    assert columns == set(games()["pitanks"].variants)
    for section in GAME_OF:
        columns = {row.column for row in ROWS if row.section == "Opponents" and row.first == section}
        assert columns == {"hand1", "hand2", "hand3"}


@pytest.mark.parametrize(
    ("cell", "value", "same"),
    [
        ("260 px/s (34.3 cm/s)", 260.0, True),
        ("260 px/s (34.4 cm/s)", 260.0, False),
        ("261 px/s", 260.0, False),
        ("0.5 s (25 ticks)", 25, True),
        ("0.5 s (24 ticks)", 25, False),
        ("0.08 s", 0.08, True),
        ("2 s a meter", 0.01, True),
        ("×1/3", 1 / 3, True),
        ("×0.33", 1 / 3, False),
        ("0.21 rad (12 °)", 0.21, True),
        ("2 to 8", (2, 3, 4, 5, 6, 7, 8), True),
        ("2 to 8", (2, 3, 4, 5, 6, 7), False),
        ("1, 2, 3, 5 min", (1, 2, 3, 5), True),
        ("1, 2, 5 min", (1, 2, 3, 5), False),
        ("yes", 0, False),
    ],
)
def test_a_cell_is_compared_in_its_units(cell, value, same):
    assert agrees(cell, value) is same


def quoted():
    """Statements of docs/thesis.md about this program, with the numbers of the code."""
    rules = (("pitanks", "pickups"), ("factory", None), ("race", None))
    tanks, shop, track = (match_of(game, variant).state.rules for game, variant in rules)
    one, two, unknown = RECIPES[1], RECIPES[2], Parameters()
    yield f"{world.RADIUS:g} px | **same**; **open**: the radius"
    yield f"{world.WIDTH:g} × {world.HEIGHT:g} px; nominal mat 2.11 × 1.19 m, so {drivetrain.MM} mm a pixel"
    yield f"{tanks.speed:g} px/s (0.34 m/s) and {tanks.turn_rate} rad/s"
    yield f"×{tanks.turbo_factor}, from a meter of {1 / tanks.turbo_drain / world.HZ:g} s"
    yield f"refills in {1 / tanks.turbo_refill / world.HZ:g} s"
    yield f"first-order lag of {robots.LAG} s"
    yield f"one a bullet, from {arena.HEALTH}"
    yield f"{tanks.bullet_speed:g} px/s, radius {tanks.bullet_radius:g} px, one each {tanks.cooldown / world.HZ:g} s"
    yield f"at most {tanks.bullets_alive} alive"
    yield f"{tanks.protection / world.HZ:g} s of protection, none in `original` and `classic`"
    yield f"after {shop.replace / world.HZ:g} s it is replaced"
    yield f"three workers, {shop.walk:g} px/s, {shop.process / world.HZ:g} s a pallet"
    yield f"{games()['factory'].default.default_goal} a team; 2 to {games()['factory'].default.goals[-1]} by choice"
    yield f"nobody collects for {shop.collect / world.HZ:g} s"
    yield f"{games()['race'].default.default_goal}; 1 to {games()['race'].default.goals[-1]} by choice"
    yield f"{track.speed:g} px/s, that is ×{track.speed / tanks.speed:g}"
    yield f"×{Fraction(track.mud).limit_denominator(9)} | **open**: ×2/3 or ×1/3"
    yield f"{track.patience / world.HZ:g} s after the first has finished"
    yield f"fires from {unknown.engage:g} px; decides every {unknown.period} ticks; aims to {unknown.tolerance:g} rad"
    yield f"{unknown.beside:g} px behind the wall; there within {unknown.arrived:g} px"
    yield f"| {sectors.STATES:,} | **same**"
    yield f"| {qlearning.PAIRS:,} | **same**"
    yield f"every {one.period} ticks; a turn of {degrees(one.period / world.HZ * tanks.turn_rate):.0f}° at most"
    yield f"| γ = {one.gamma:g} |"
    yield f"the same, in a line over {one.ceiling:,} experiences"
    yield f"no longer learns; temperature 1/{1 / one.cold:g}"
    yield f"of the closest wall: +10 | +{one.hit:g} |"
    yield f"looking at the opponent: −1 | −{-one.miss:g}; looking is sector 0"
    yield f"−1, once | −{-one.behind:g};"
    yield f"at every step | −{-two.behind:g};"
    yield f"{('no', 'one', 'two', 'three', 'four', 'five')[len(games())]} games on one engine"
    yield f"AIs of {('no', 'one', 'two', 'three', 'four', 'five')[len(LEVELS)]} levels in every game"
    yield f"staying still: −10 | −{-two.still:g};"


def test_the_page_on_the_thesis_says_of_this_program_what_is_so():
    page = THESIS_PAGE.read_text(encoding="utf-8")
    assert [text for text in quoted() if text not in page] == []


def tables(page):
    """Tables of a page: its heading, and rows of cells without units and quotation marks."""
    for block in re.findall(r"(?:^\|.*\n)+", page.read_text(encoding="utf-8"), flags=re.MULTILINE):
        head, _, *body = map(cells, block.splitlines())
        yield head, [[cell.replace("`", "") for cell in row] for row in body]


def test_the_page_on_networks_lists_the_inputs_of_every_game():
    listed = []
    for head, body in tables(NETWORKS_PAGE):
        if head[:2] == ["group", "inputs"]:
            names = [(name.split(", "), re.findall(r"\d+", count)) for name, count, _ in body]
            listed.append(
                [one for many, counts in names for one in zip(many, map(int, counts * len(many)), strict=False)]
            )
    assert listed == [[*ENCODINGS[game].groups] for game in ("pitanks", "race", "factory")]


def test_models_on_the_page_have_the_shapes_of_the_games():
    page = NETWORKS_PAGE.read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?torch\.onnx\.export.*?)^```$", page, re.M | re.S)
    layers = [tuple(map(int, pair)) for pair in re.findall(r"Linear\((\d+), (\d+)\)", block)]
    encoding = ENCODINGS["pitanks"]
    assert (layers[0][0], layers[-1][1]) == (encoding.size, encoding.outputs)
    assert all(before[1] == after[0] for before, after in pairwise(layers))
    assert re.findall(r"zeros\((\d+), (\d+)\)", block) == [("1", str(encoding.size))]
    drive, turn, fire, turbo = (count for _, count in ENCODINGS["race"].heads)
    shapes = {game: f"(1, {one.size}) and (1, {one.outputs})" for game, one in ENCODINGS.items()}
    assert f"Race has {shapes['race']}, in heads of {drive}, {turn}, {fire} and {turbo}; Robot Factory" in page
    assert f"Robot Factory {shapes['factory']}." in page
    heads = ", ".join(f"(1, {count})" for _, count in encoding.heads)
    assert f"| input | one, float32, (1, {encoding.size}):" in page
    assert f"one output (1, {encoding.outputs}), or four outputs {heads} in this order" in page


def test_the_page_on_networks_has_the_hyper_parameters():
    wanted = ["name", "PiTanks", "Robot Race", "Robot Factory"]
    (body,) = [body for head, body in tables(NETWORKS_PAGE) if head[:4] == wanted]
    for place, game in enumerate(("pitanks", "race", "factory"), start=1):
        for row in body:
            shown = row[1] if row[place] == "the same" else row[place]
            for name, number in zip(re.split(", | to ", row[0]), re.split(", | to ", shown), strict=True):
                assert float(number) == getattr(TASKS[game].hyper, name), row


def test_the_page_on_environments_lists_the_rewards():
    pytest.importorskip("gymnasium")
    tallies = import_module("pigaming_app.gym.rewards").TALLIES
    (body,) = [body for head, body in tables(ROOT / "docs" / "gym.md") if head[:2] == ["game", "tallies"]]
    for game, names, weights in body:
        wanted = tallies[GAME_OF[game]]
        assert tuple(re.sub(r" \(.*?\)", "", names).split(", ")) == wanted.names
        assert dict(weight.replace("−", "-").rsplit(" ", 1) for weight in weights.split(", ")) == {
            name: f"{weight:g}" for name, weight in wanted.weights.items()
        }


def rewards():
    """Statements of docs/networks.md about the rewards of `train ppo`, with the numbers of the task files."""
    fights, races = TASKS["pitanks"], TASKS["race"]
    reward: Any = fights.reward
    habits: Any = fights.habits
    yield f"| a hit taken | −{reward.first_care:g}, falling to −{reward.care:g} by half"
    yield f"| a win, a tie, a defeat | +{reward.win:g}, −{-reward.tie:g}, −{-reward.defeat:g} |"
    yield f"| a decision without an opponent in the line of fire | −{reward.bored:g} |"
    yield f"| a shot without an opponent in the line of fire | −{reward.blind:g} |"
    yield f"| a decision within {reward.close:g} px of an opponent | −{reward.crowd:g} |"
    yield f"| a shot | −{reward.shot:g} |"
    yield f"| a shot, in {habits.thrifty:.0%} of the matches | up to −{habits.most_thrift:g} more,".replace("%", " %")
    yield f"| the change of a potential, × {reward.first_shaping:g} falling to × {reward.shaping:g} |"
    yield f"else −{fighting.FAR / 2:g} for each 1600 px"
    late = f"In {habits.late:.0%} of the matches without the exploiter it sees others up to {habits.latest:g} s late"
    yield late.replace("%", " %")
    reward = races.reward
    yield f"| progress | +1 for each {reward.stride:g} px |"
    yield f"| +{reward.lead:g} for each {reward.stride:g} px it grows |"
    yield f"| +{reward.place:g} for each place up to the last, +{reward.win:g} for a win |"
    yield f"Steps of more than {reward.longest:g} px a decision"
    shares = [line_up.share for line_up in fights.line_ups]
    made = [name for name in fights.arenas if name.startswith("surprise-")]
    yield f"(`{made[0]}` to `{made[-1]}`), so that it learns no arena by heart. Of {sum(shares)} matches: | matches |"
    for places in ((0, 1, 2, 6, 7, 4), (3, 5, 8), (9, 10), (11, 13, 12), (14, 15, 16)):  # rows of the page
        yield f"| {', '.join(str(shares[place]) for place in places)} |"
    yield f"alone (4 of {sum(line_up.share for line_up in races.line_ups)})"


def test_the_page_on_networks_has_the_rewards():
    page = " ".join(NETWORKS_PAGE.read_text(encoding="utf-8").split())
    assert [text for text in rewards() if text not in page] == []


def test_the_page_on_opponents_has_the_handicaps_of_pitanks():
    levels = [body for head, body in tables(OPPONENTS_PAGE) if head[1:] == [f"`level{n}`" for n in range(1, 6)]]
    (body,) = [body for body in levels if body[0][0] == "share of full speed"]
    for row, name in zip(body, ("speed", "thrift", "reluctance", "delay", "error", "turns"), strict=True):
        shown = [0.0 if cell == "–" else float(cell.split()[0]) for cell in row[1:]]
        assert shown == [handicap.get(name, 0.0) for handicap in HANDICAPS], row


@pytest.mark.parametrize("seed", range(4))
def test_classic_loses_to_an_opponent_that_stands_still_and_fires(seed):
    class Camper:
        def think(self, state, seat):
            own, other = state.robots[seat], state.robots[1 - seat]
            turn = angles.turn_to(atan2(other.y - own.y, other.x - own.x) - own.heading)
            action.set_action(state.actions[seat], 0.0, 4.0 * turn, 1, 0)

    match = match_of("pitanks", "classic")
    match.sit(seed % 2, Camper())
    match.sit(1 - seed % 2, make_brain("pitanks", "classic", seed))
    while not match.over:
        match.tick()
    assert match.outcome().winners == (seed % 2,)


@pytest.mark.parametrize(("charge", "boosts"), [(0.0999, 0), (0.1001, 1)])
@pytest.mark.parametrize("game", games())
def test_turbo_starts_from_a_tenth_of_the_meter(game, charge, boosts):
    class Pressing:
        def think(self, state, seat):
            action.set_action(state.actions[seat], 1.0, 0.0, 0, 1)

    match = match_of(game)
    match.sit(0, Pressing())
    match.state.robots[0].turbo = charge
    match.tick()
    assert match.state.robots[0].boosting == boosts


@pytest.mark.parametrize("game", OURS)
def test_the_example_of_an_arena_can_be_played(game):
    page = GAMES_PAGE.read_text(encoding="utf-8")
    (source,) = re.findall(rf"^```toml\n(# assets/arenas/{game}/.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
    setup = make_setup(game, ["idle", "idle"], "example", None, 1, None, None, ["idle"])
    match = Match(setup, arena=parse(game, source, "example.toml"))
    match.tick()
    assert match.state.tick == 1


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_to_files_and_headings_that_exist(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, heading = target.partition("#")
        there = (page.parent / path).resolve() if path else page
        assert there.exists(), f"{page.name}: {target}"
        assert there.is_relative_to(ROOT), f"{page.name}: {target}"
        if heading:
            assert heading in anchors(there), f"{page.name}: {target}"


def anchors(page):
    """The anchors that GitHub gives the headings of a page."""
    titles = re.findall(r"^#+ (.+)$", prose(page), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_names_only_what_the_repository_has(page):
    assert not NEVER_NAMED.search(page.read_text(encoding="utf-8"))


@pytest.mark.parametrize(("brain", "page"), [*product(("classic", "fsm"), (OPPONENTS_PAGE, THESIS_PAGE))])
def test_an_old_machine_has_one_name_on_screens_and_pages(brain, page):
    for language in LANGUAGES:
        words = Words(language)
        assert words(f"lobby.{brain}") == words(f"match.{brain}")
    name = Words("en")(f"lobby.{brain}")
    assert name.lower() in page.read_text(encoding="utf-8").lower()
    assert brain in AIS["pitanks"].rivals
    assert Words("en")("lobby.classic").lower() == RIVAL
