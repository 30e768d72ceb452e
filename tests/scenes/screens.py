"""Every menu screen with the longest values it can show, ready to be drawn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pygame
import pytest

from pigaming_app.ai.bots import brains
from pigaming_app.ai.game_ai import ONE_BUTTON, POINT
from pigaming_app.ai.registry import AIS
from pigaming_app.events.journal import Paused, Summoned
from pigaming_app.events.ladder import Climb, table_of, worth
from pigaming_app.events.league_files import Ratings, Strength
from pigaming_app.events.spec import Entrant, Format
from pigaming_app.games.arenas import arenas, load, shipped_arenas
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.registry import games
from pigaming_app.games.replay import Replay
from pigaming_app.hardware.scan.things import ThingKind
from pigaming_app.scenes.bots.page import BotsPage
from pigaming_app.scenes.controls.controls_test import ControlsTest
from pigaming_app.scenes.controls.remap_page import RemapPage
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.checker import CheckResult
from pigaming_app.scenes.editor.gallery.drawing_page import DrawingPage
from pigaming_app.scenes.editor.gallery.page import Gallery
from pigaming_app.scenes.editor.model.problems import Problem
from pigaming_app.scenes.editor.naming import ArenaNamePage as ArenaName
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.events.arrange_page import ArrangePage
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.desk.host import desk_host
from pigaming_app.scenes.events.manage.corrections import Correction, ResultsList
from pigaming_app.scenes.events.manage.desk_page import DeskPage
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.setup.arenas_page import ArenasPage
from pigaming_app.scenes.events.setup.draft import BY_TURNS, Draft
from pigaming_app.scenes.events.setup.entrants_page import EntrantsPage
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.kiosk.day_report import figures as day_figures
from pigaming_app.scenes.kiosk.operator.figures_page import FiguresPage
from pigaming_app.scenes.kiosk.operator.page import OperatorPage
from pigaming_app.scenes.kiosk.operator.trash_page import TrashPage
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.lab.network.fetch_page import FetchPage
from pigaming_app.scenes.lab.pages.line_page import LinePage
from pigaming_app.scenes.ladder.choice import LadderChoice
from pigaming_app.scenes.ladder.climber import Climber
from pigaming_app.scenes.ladder.climbers import Climbers
from pigaming_app.scenes.ladder.rungs import LadderPage
from pigaming_app.scenes.ladder.strengths import Strengths
from pigaming_app.scenes.ladder.summit import Summit
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby, game_choice
from pigaming_app.scenes.lobby.seats import LobbySeats
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.mat.robots.set_up_page import BoardWork, SetUpPage
from pigaming_app.scenes.options import games_page
from pigaming_app.scenes.options.games_page import NewGame
from pigaming_app.scenes.options.page import SECTIONS, OptionsPage
from pigaming_app.scenes.pages.pin_page import DigitsPage, NewPinPage, PinPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.scenes.pages.wifi import wifi_typing
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import PATIENCE, JoinByPhone
from pigaming_app.scenes.phones.list_page import PhoneList
from pigaming_app.scenes.phones.settings_page import PhonesPage
from pigaming_app.scenes.play.device_table import DeviceTable
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect, StillThere
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.playtest.consent import ConsentPage
from pigaming_app.scenes.playtest.page import PlayTestPage
from pigaming_app.scenes.replays.page import ReplaysPage
from pigaming_app.scenes.results.awards.ceremony import Ceremony
from pigaming_app.scenes.results.awards.moment import AwardsMoment
from pigaming_app.scenes.results.high_scores import HighScores, high_score_tables
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.day_log import Battery, PlayedMatch, ProgramEvent, Record
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.pin import LONGEST
from pigaming_app.storage.plugins.found import Plugin, found
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.scores import ScoreTable
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.phone_messages import Wish, WishKind
from pigaming_app.ui.input.phones.guest import Stage
from pigaming_app.ui.input.phones.names import MAX_NAME
from pigaming_app.ui.input.phones.roster import MAX_CONNECTED
from pigaming_app.ui.web.network import NetworkInterface, ServerUnavailable
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.events import drawn
from tests.scenes.mat.calibration import drawn as calibration_drawn
from tests.scenes.mat.phone_camera import drawn as phone_drawn
from tests.scenes.mat.robots import drawn as robots_drawn

FACTS: dict[str, dict[str, float]] = {
    "pitanks": {"hits": 199, "taken": 299, "aim": 1.0},
    "factory": {"delivered": 9, "steps": 18, "bumps": 112, "stolen": 99, "stars": 3},
    "race": {"laps": 9, "best": 75.12, "total": 599.99},
    "football": {"goals": 19, "assists": 19, "own_goals": 19, "shots": 99},
}
RADIO_REFUSALS = ("mute", "refused", "unsaved")
TEAMS = (0, 1, 0, 1)
ALONE = (0, 1, 2, 3)


@dataclass(frozen=True)
class Ending:
    """The end of a match: drivers, teams, points, winners."""

    game: str
    brains: str
    teams: tuple[int, ...]
    scores: Sequence[int]
    winners: tuple[int, ...]
    variant: str = ""  # empty: the game's last

    def results(self, arcade: Arcade, finished: bool = True) -> Results:
        variants = games()[self.game].variants
        variant = self.variant or list(variants)[-1]
        goal, arena = max(variants[variant].goals, default=0), max(arenas(self.game), key=len)
        setup = setup_of(self.game, self.brains, arena, 5.0, 1, variant, goal, self.teams)
        devices = [KEYS[i] if seat.brain == "human" else None for i, seat in enumerate(setup.seats)]
        recording = Replay(setup, "", b"", "", "")  # so that it can be saved
        ended = self.outcome()
        scene = Results(
            arcade.context, ended, setup, devices, MatchScene, finished, game_choice=game_choice, recording=recording
        )
        scene.age = 9.0
        return scene

    def numbers(self, arcade: Arcade) -> Results:
        """The second view."""
        scene = self.results(arcade)
        scene.page = scene.numbers
        return scene

    def outcome(self) -> Outcome:
        sums = {team: sum(s for s, t in zip(self.scores, self.teams, strict=True) if t == team) for team in self.teams}
        order = sorted(range(4), key=lambda seat: (-sums[self.teams[seat]], self.teams[seat], -self.scores[seat]))
        rows = []
        for seat in order:
            place = 1 + sum(sums[self.teams[other]] > sums[self.teams[seat]] for other in order)
            facts = FACTS[self.game]
            rows.append(Row(seat, self.teams[seat], place, self.scores[seat], facts, {}, (75.12, 80.0)))
        series = tuple(((0.0, 0), (20.0, score)) for score in self.scores)
        return Outcome(tuple(rows), self.winners, series, 300.0)


def event_awards(arcade: Arcade) -> Scene:
    """The awards after a match of entrants with long names."""
    results = ENDINGS["in teams"].results(arcade)
    ended = replace(results.ended, names=("W" * 12, "Wolfgang-Maria", "Ångström", "MMMMMMMMM"))
    scene = AwardsMoment(arcade.context, Ceremony(arcade.context, ended, True, {}), results)
    scene.age = 7.0
    return scene


ENDINGS = {
    "alone": Ending("pitanks", "human human level5 human", ALONE, (-100, -33, 999, 5), (2,)),
    "in teams": Ending("pitanks", "human human q2 human", TEAMS, (-100, -133, 999, -105), (0, 2)),
    "tie": Ending("pitanks", "human human human human", ALONE, (-10, -10, -10, -10), ()),
    "factory": Ending("factory", "human human level5 level3", TEAMS, (2, 8, 1, 1), (1, 3), "standard"),
    "factory party": Ending("factory", "human human level5 level3", TEAMS, (22, 18, 11, 21), (1, 3), "party"),
    "factory together": Ending("factory", "human human level5 level3", (0, 0, 0, 0), (2, 8, 1, 1), (0, 1, 2, 3)),
    "race": Ending("race", "human level1 level3 level5", ALONE, (9, 9, 9, 5), (0,)),
}


def sheet_written(arcade: Arcade) -> Scene:
    page = RobotsMenu(arcade.context)
    page.focus.move_to("sheet")
    path = "/home/a.rather.long.name/.local/share/pigaming/of-the-school/markers.pdf"
    page.show_message(arcade.context.words("robots.written", path=path))
    return page


def lobby(arcade: Arcade, game: str, people: int, ais: int) -> Scene:
    scene = Lobby(arcade.context, game)
    for device in KEYS[:people]:
        scene.handle(InputEvent(Button.FIRE, device))
    for _ in range(ais):
        scene.handle(InputEvent(Button.Y, KEYS[0]))
    return scene


def one_button(arcade: Arcade) -> Scene:
    for device in KEYS[:3]:
        arcade.context.driving.chosen[device] = ONE_BUTTON
    return lobby(arcade, "pitanks", 3, 1)


def seats(game: str) -> LobbySeats:
    found = LobbySeats(team_mode=games()[game].default.team_mode, rivals=AIS[game].rivals)
    for device in KEYS[:2]:
        found.join(device)
    found.add_ai()
    found.add_ai()
    return found


def match(arcade: Arcade) -> MatchScene:
    return MatchScene(arcade.context, setup("human human human human", 2.0), [*KEYS[:3], Device("pad", 77)])


def best(arcade: Arcade, game: str) -> Scene:
    rules = games()[game]
    conditions = ScoreTable(
        game, max(arenas(game), key=len), "", False, list(rules.variants)[-1], max(rules.default.goals or (5,)), 4
    )
    for board in high_score_tables(conditions):
        for score in (999, 599_990, -100):
            arcade.context.scores.add(board.table, "WWW", score)
    scene = HighScores(arcade.context, conditions)
    scene.age = 9.0
    return scene


def options(arcade: Arcade, section: str = "") -> Scene:
    return OptionsPage(arcade.context, section=section)


def how_to_play(arcade: Arcade, game: str) -> Scene:
    return HowTo(arcade.context, game)


def choice(arcade: Arcade, game: str) -> Scene:
    return MatchSetupPage(arcade.context, game, seats(game))


def climbers(arcade: Arcade) -> Climbers:
    for level in range(1, 6):
        for lost in (0, 999):
            arcade.context.scores.add(table_of("all"), "WWW", worth(Climb("all", beaten=level, lost=lost)))
    scene = Climbers(arcade.context, "all")
    scene.turned = 9.0
    return scene


def ladder(arcade: Arcade, said: str, **state: Any) -> Scene:
    climb = Climb("all", **state)
    return LadderPage(arcade.context, Climber(climb, 1, KEYS[0]), said)


def easier(arcade: Arcade) -> LadderPage:
    scene = LadderPage(arcade.context, Climber(Climb("all", rung=5, clear=2, beaten=4, lost=999), 1, KEYS[0]), "again")
    scene.focus.move_to("easier")
    return scene


def summit(arcade: Arcade) -> Summit:
    scene = Summit(arcade.context, Climber(Climb("all", rung=6, beaten=5, lost=999), 1, KEYS[0]))
    scene.age = 9.0
    return scene


def strengths(arcade: Arcade) -> Strengths:
    scene = Strengths(arcade.context, "pitanks")
    rows = [
        (brain, 900.0 - 160.0 * i)
        for i, brain in enumerate(dict.fromkeys((*AIS["pitanks"].rivals, "classic", "random", "hand1")))
    ]
    rated = tuple(Strength(brain, rating, (rating - 90.0, rating + 90.0)) for brain, rating in rows)
    scene.ratings, scene.age = Ratings("pitanks", "original", 100_000, rated), 9.0
    return scene


def event_setup(arcade: Arcade, form: Format, row: str) -> Scene:
    draft = Draft()
    draft.choose("format", form)
    scene = SetupPage(arcade.context, draft, lambda draft: "")
    scene.focus.move_to(row)
    return scene


def event_arenas(arcade: Arcade) -> Scene:
    scene = ArenasPage(arcade.context, Draft(game=BY_TURNS))
    for name in ("race hairpin", "race kidney", "pitanks islands"):
        scene.draft.toggle_arena(*scene.cells[name])
    return scene


def entrants(arcade: Arcade, count: int, classes: bool = False) -> Scene:
    found = [Entrant(name, "level3" * (i % 3 == 1), "D" * (i % 2)) for i, name in enumerate(drawn.names(count))]
    draft = Draft(Format.GRAND_PRIX, entrants=[*found[1:], Entrant("WWWWWWWWWWWW")])
    draft.classes = {one.name: "5a" for one in found} if classes else {}
    return EntrantsPage(arcade.context, draft, lambda draft: "")


def event(form: Format, count: int, seats: int, matches: int, brains: str = "", wide: bool = False) -> RunningEvent:
    return drawn.running(drawn.played(drawn.an_event(form, count, seats, brains, wide=wide), matches))


def next_match(arcade: Arcade, count: int, seats: int, brains: str = "", said: str = "", wide: bool = False) -> Scene:
    run = event(Format.SWISS, count, seats, 1, brains, wide)
    return NextMatch(arcade.context, run, said and arcade.context.words(said))


def sudden_death(arcade: Arcade) -> Scene:
    event = drawn.tied(drawn.an_event(Format.KNOCKOUT, 4, wide=True))
    return NextMatch(arcade.context, drawn.running(event), arcade.context.words("events.tied"))


def arranged(arcade: Arcade, form: Format, count: int, called: int | None = None, wide: bool = False) -> Scene:
    scene = ArrangePage(arcade.context, event(form, count, 2, 9, wide=wide))
    scene.called = [scene.rows[called].entrant] if called is not None else []
    return scene


def event_table(
    arcade: Arcade, form: Format, count: int, page: int = 0, seats: int = 2, wide: bool = False, matches: int = 0
) -> Scene:
    scene = TablePage(arcade.context, event(form, count, seats, matches or count, wide=wide))
    scene.page, scene.turned = page, 9.0
    return scene


def event_podium(arcade: Arcade, wide: bool = False) -> Scene:
    scene = EventPodiumPage(arcade.context, event(Format.ROUND_ROBIN, 4, 2, 99, wide=wide))
    scene.age = 9.0
    return scene


def correction(arcade: Arcade, reason: str = "", wide: bool = False) -> Scene:
    run = event(Format.KNOCKOUT, 16, 4, 3, wide=wide)
    scene = Correction(arcade.context, run, run.event.fixtures[0])
    if reason:
        scene._write(reason)
    return scene


def correction_of_a_try(arcade: Arcade) -> Scene:
    run = event(Format.HIGH_SCORE, 3, 4, 3)
    return Correction(arcade.context, run, run.event.fixtures[0])


def event_managed(arcade: Arcade, row: str, form: Format = Format.SWISS) -> Scene:
    run = event(form, 12, 4, 1)
    scene = EventPage(arcade.context, run.path, run, None)
    scene.focus.move_to(row)
    return scene


def event_desk(arcade: Arcade, url: str = "", trouble: str = "") -> Scene:
    host = arcade.context.shared(desk_host)
    server: Any = SimpleNamespace(url=url)
    host.server = server if url else None
    host.trouble = (trouble, {})
    return DeskPage(arcade.context)


def event_waiting(arcade: Arcade) -> Scene:
    run = event(Format.SWISS, 3, 2, 0)
    run.event = run.event.after(Summoned(run.event.open[0].number, "left"))
    run.arcade = "right"
    return NextMatch(arcade.context, run)


def event_break(arcade: Arcade) -> Scene:
    run = event(Format.SWISS, 8, 4, 0)
    run.event = run.event.after(Paused("W" * 200))
    return NextMatch(arcade.context, run)


def events(arcade: Arcade) -> Scene:
    for i, form in enumerate(Format):
        drawn.running(drawn.played(drawn.an_event(form, 12, 4, title=30 * "W"), 3 * i), f"event-{i}")
    scene = EventsPage(arcade.context)
    scene.on_enter()
    return scene


def deleted(arcade: Arcade) -> TrashPage:
    """The widest things that can be deleted, on two pages."""
    names = ("events/WWWWWWWWWWWWWWWWWWWWWWWW.json", "arenas/race/WWWWWWWWWWWWWWWWWWWW.toml", "robots/WWWWWW.npz")
    for i in range(9):
        write_atomic(folders().data / "trash" / f"20261129-2358{i:02}-000000" / names[i % 3], b"")
    return TrashPage(arcade.context)


def typed(page: DigitsPage, count: int, said: str) -> DigitsPage:
    """A page with so many digits, after a sentence."""
    page.tell(said, True)
    page.digits = "8" * count
    return page


def figures(arcade: Arcade) -> FiguresPage:
    """The figures of a busy day."""
    page = FiguresPage(arcade.context)
    day = page.report.day
    records: list[Record] = [ProgramEvent(datetime(day.year, day.month, day.day, 8), "start")] * 13
    for hour in range(9, 20):
        at = datetime(day.year, day.month, day.day, hour)
        records += [PlayedMatch(at, game, 299.0, 4, 0) for i, game in enumerate(games()) for _ in range(4 * i + hour)]
        records += [Battery(at, robot, 4.9) for robot in range(1, 5)]
    page.report = day_figures(day, records)
    return page


PHONES = [Device("phone", number) for number in range(4)]
URL = "http://192.168.100.200:65535/mmmmmmmmmm"  # the widest one


def with_phones(arcade: Arcade, trouble: str = "") -> Arcade:
    """Phones are on, without a server: at the widest address, or with the trouble of this key."""
    host = arcade.context.shared(phone_host)
    host._asked = ("", 65535)
    if trouble:
        host.trouble = ServerUnavailable(trouble, port=65535, name="Intel(R) Wi-Fi 6E AX210 160MHz")
    else:
        server: Any = SimpleNamespace(url=URL, port=65535, visited=False, stop=lambda: None)
        host.server = server
    return arcade


def join_by_phone(arcade: Arcade, trouble: str = "") -> Scene:
    page = JoinByPhone(with_phones(arcade, trouble).context, lambda: PHONES)
    page.age = PATIENCE + 1.0
    return page


def crowded(arcade: Arcade) -> Arcade:
    """Thirty-two phones with the widest names, and a Wi-Fi with a code."""
    roster = arcade.context.shared(phone_host).roster
    for i in range(MAX_CONNECTED):
        admitted = roster.admit("", f"10.0.0.{i}")
        assert not isinstance(admitted, str)
        roster.wish(admitted[0], Wish(WishKind.NAME, text=MAX_NAME * "W"))
    settings = arcade.context.settings
    settings.phones_wifi, settings.phones_wifi_key = 32 * "W", 63 * "W"
    return arcade


def phone_list(arcade: Arcade) -> Scene:
    page = PhoneList(crowded(arcade).context)
    for guest in page.guests:
        guest.played = 188
    page.guests[0].stage = Stage.PLAYING
    page.guests[1].stage = Stage.IDLE
    page.guests[2].connected = False
    return page


def phones_page(arcade: Arcade, trouble: str = "") -> Scene:
    page = PhonesPage(with_phones(arcade, trouble).context)
    page.networks = [NetworkInterface("Intel(R) Wi-Fi 6E AX210 160MHz", "192.168.100.200")]
    arcade.context.settings.phones_network = page.networks[0].name
    return page


def programs(arcade: Arcade, focus: str) -> Scene:
    """The page of programs, of which there are some; one name is as long as it may be."""
    for name in ("ada", "mmmmmmmmmmmm"):
        brains.book().add(name)
    page = BotsPage(arcade.context)
    page.focus.move_to(focus)
    return page


def consent(arcade: Arcade, ages: Sequence[int]) -> Scene:
    """Keyboards on as many seats, with these age bands; all but the last have agreed."""
    page = ConsentPage(arcade.context, "factory")
    for device, age in zip(KEYS, ages, strict=False):
        page.seats.join(device)
        page.ages[device] = age
    for seat in range(len(ages) - 1):
        page.seats.places[seat].ready = True
    return page


def lobby_with_phones(arcade: Arcade, game: str) -> Scene:
    return lobby(with_phones(arcade), game, 0, 0)


def locked_phone(arcade: Arcade) -> Scene:
    scene = match(arcade)
    scene.devices[3] = PHONES[3]
    return Reconnect(scene, 3)


PLUGINS = (
    *found(),
    Plugin("robot_sumo_tournament_24", "sumo.game", Path("/opt/sumo/game"), origin="robot-sumo-tournament 10.10.1"),
    *(Plugin(f"game_{i}", f"game_{i}", Path(f"/home/a.long.name/.local/share/pigaming/games/{i}")) for i in range(9)),
    Plugin(
        "football", "soccer", Path("/opt"), fault="there is one in /home/pigaming/PiGaming/pigaming_football already"
    ),
)


def board_failed(arcade: Arcade) -> Scene:
    """The page after a test on blocks that found no micro:bit."""
    page = SetUpPage(arcade.context)
    page.work = BoardWork("blocks", lambda note: 0)
    page.work.done = [arcade.context.words(f"board.turn_{turn}") for turn in ("left", "right", "back", "lamp")]
    page.show_message(
        arcade.context.words.sentence(OperatorMessage("board_microbit", port="/dev/ttyACM10")), wrong=True
    )
    page.focus.move_to("blocks")
    return page


def added_games(arcade: Arcade, first: int = 0) -> Scene:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(games_page, "found", lambda: PLUGINS)
        return games_page.GamesPage(arcade.context, first)


def new_game(arcade: Arcade, state: str) -> Scene:
    page = NewGame(arcade.context, PLUGINS[1] if state == "plays" else PLUGINS[5])
    page.state = state
    return page


WIDEST = 9 * "W"  # the longest name of an arena


def editor(arcade: Arcade, game: str, problem: str = "", said: str = "") -> Scene:
    """The editor with the first part of an arena selected; `problem`: of this kind; `said`: a sentence."""
    drawing = store.titled(drawing_of(load(game, shipped_arenas(game)[0]).source), WIDEST)
    scene = Editor(arcade.context, game, WIDEST.lower(), drawing)
    scene.bench.close()
    for task in (scene.bench.checker._finder, scene.bench.checker._planner):
        if task._thread:
            task._thread.join()
    scene.bench.selected = scene.tools.items(drawing)[-1]
    found = [Problem(problem, 800.0, 450.0, 60.0, "", problem != "gap", problem)] if problem else []
    scene.bench.checker.verdict = CheckResult(drawing, found, done=True)
    if said:
        scene.say(said, name=WIDEST)
        scene._message_left = 999.0
    return scene


def tool_bar(arcade: Arcade) -> Scene:
    scene = editor(arcade, "pitanks")
    scene.handle(InputEvent(Button.Y, KEYS[0]))
    return scene


def drawn_arenas(arcade: Arcade, game: str, page: bool = False) -> Scene:
    """The gallery, or the page of an arena, with its widest name."""
    for name in (WIDEST.lower(), *(f"{WIDEST.lower()}-{i}" for i in range(4))):
        drawing = drawing_of(load(game, shipped_arenas(game)[0]).source)
        write_atomic(store.draft_file(game, name), store.titled(drawing, WIDEST).text().encode())
    if not page:
        return Gallery(arcade.context, game)
    scene = DrawingPage(arcade.context, game, WIDEST.lower())
    scene._share(drawing)
    return scene


def fetch_page(arcade: Arcade, state: str) -> Scene:
    """What networks need is being fetched, or was not."""
    fetch: Any = SimpleNamespace(state=state, share=0.4, start=lambda: None)
    arcade.context.shared(LabBackground).network_fetch = fetch
    return FetchPage(arcade.context, lambda: pygame.Surface((1920, 1080)), lambda: None)


FETCH_STATES = ("fetching", "offline", "full", "restart", "foreign", "failed", "built")

SCREENS: dict[str, Callable[[Arcade], Scene]] = {
    **{f"editor {game}": partial(editor, game=game) for game in EDITORS},
    "editor with a problem": partial(editor, game="pitanks", problem="machine"),
    "editor with a goal out of reach": partial(editor, game="football", problem="goal"),
    "editor and a full disk": partial(editor, game="race", said="editor.disk"),
    "editor tool bar": tool_bar,
    "gallery": partial(drawn_arenas, game="race"),
    "page of a drawing": partial(drawn_arenas, game="pitanks", page=True),
    "name of a drawing": lambda arcade: ArenaName(arcade.context, "race", "new-1", WIDEST, lambda name: None),
    "lab line": lambda arcade: LinePage(arcade.context, "10*distance+" * 6 + "distance", lambda line: ""),
    **{f"lab fetch {state}": partial(fetch_page, state=state) for state in FETCH_STATES},
    "events": events,
    **{f"event setup {form.value}": partial(event_setup, form=form, row="format") for form in Format},
    "event setup order": partial(event_setup, form=Format.GRAND_PRIX, row="order"),
    "event setup arenas": event_arenas,
    "no entrants": lambda arcade: EntrantsPage(arcade.context, Draft(), lambda draft: ""),
    "entrants": partial(entrants, count=64),
    "entrants of classes": partial(entrants, count=30, classes=True),
    "event letters": lambda arcade: LettersPage(arcade.context, lambda name: "", lambda: drawn.names(20)),
    "next match": partial(next_match, count=64, seats=4),
    "next match of two": partial(next_match, count=5, seats=2, said="events.missing"),
    "next match alone": lambda arcade: NextMatch(
        arcade.context, drawn.running(drawn.an_event(Format.TIME_TRIAL, 3).arrange("AAA"))
    ),
    "event weeks": partial(event_table, form=Format.CHALLENGE, count=12, page=1, matches=9),
    "correction of a try": correction_of_a_try,
    "event results of tries": lambda arcade: ResultsList(arcade.context, event(Format.TIME_TRIAL, 9, 1, 9)),
    "next match of AIs": partial(next_match, count=8, seats=3, brains="level5"),
    **{f"event table {count}": partial(event_table, form=Format.SWISS, count=count) for count in (3, 8, 16, 64)},
    "event groups": partial(event_table, form=Format.GROUPS, count=16),
    "event groups knocked out": partial(event_table, form=Format.GROUPS, count=16, page=1, matches=99),
    "event groups round by round": partial(event_table, form=Format.GROUPS, count=64, page=8),
    "event ladder": partial(event_table, form=Format.CHALLENGE, count=12),
    "event lap times": partial(event_table, form=Format.TIME_TRIAL, count=8),
    "event scores": partial(event_table, form=Format.HIGH_SCORE, count=20),
    "widest event groups": partial(event_table, form=Format.GROUPS, count=23, wide=True),
    "event challenger": partial(arranged, form=Format.CHALLENGE, count=12),
    "event challenged": partial(arranged, form=Format.CHALLENGE, count=64, called=60),
    "event who tries": partial(arranged, form=Format.HIGH_SCORE, count=30, called=2),
    "widest event challenged": partial(arranged, form=Format.CHALLENGE, count=30, called=20, wide=True),
    "event ladder managed": lambda arcade: event_managed(arcade, "close_week", Format.CHALLENGE),
    "event day managed": lambda arcade: event_managed(arcade, "close_day", Format.TIME_TRIAL),
    **{
        f"event bracket {count}": partial(event_table, form=Format.KNOCKOUT, count=count, page=page, seats=seats)
        for count, page, seats in ((3, 0, 2), (8, 1, 2), (16, 0, 4), (64, 0, 2))
    },
    "sudden death": sudden_death,
    "event results": lambda arcade: ResultsList(arcade.context, event(Format.KNOCKOUT, 64, 4, 12)),
    "correction": correction,
    "correction in own words": lambda arcade: correction(arcade, 40 * "W"),
    "event managed": lambda arcade: event_managed(arcade, "rename"),
    "event withdrawal": lambda arcade: event_managed(arcade, "withdraw"),
    "event in browser": lambda arcade: event_managed(arcade, "desk"),
    "event desk": lambda arcade: event_desk(arcade, "http://192.168.100.200:65535/"),
    "event desk without PIN": lambda arcade: event_desk(arcade, trouble="desk.no_pin"),
    "event waiting": event_waiting,
    "event break": event_break,
    "event deletion": lambda arcade: event_managed(arcade, "delete"),
    "event title": lambda arcade: TextPage(arcade.context, arcade.context.words("events.rename"), 20 * "W", 60, str),
    "widest next match": partial(next_match, count=64, seats=4, wide=True),
    **{
        f"widest event table {count}": partial(event_table, form=Format.SWISS, count=count, wide=True)
        for count in (8, 16, 64)
    },
    "widest event bracket": partial(event_table, form=Format.KNOCKOUT, count=8, wide=True),
    "widest event results": lambda arcade: ResultsList(arcade.context, event(Format.KNOCKOUT, 64, 4, 12, wide=True)),
    "widest correction": partial(correction, wide=True),
    "widest event podium": partial(event_podium, wide=True),
    **{f"fault {name}": partial(robots_drawn.fault_page, rule=rule) for name, rule in robots_drawn.PAUSING.items()},
    "build an arena": robots_drawn.arena_page,
    **{
        f"arena with a {kind.value} thing": partial(robots_drawn.arena_page, things=[robots_drawn.thing(kind)])
        for kind in ThingKind
    },
    "arena without a camera": partial(
        robots_drawn.arena_page, fault=OperatorMessage("not_allowed", node="/dev/v4l/by-id/video-index0")
    ),
    "things in the way": robots_drawn.unplayable,
    **{
        f"calibration {name}": partial(calibration_drawn.result_page, picture=name)
        for name in calibration_drawn.PICTURES
    },
    "calibration inaccurate": partial(calibration_drawn.result_page, picture="sharp", mm=123.4),
    "calibration of a wrong width": partial(calibration_drawn.result_page, picture="small", marker=148.8),
    "calibration failed": calibration_drawn.failed_page,
    "phone as camera": phone_drawn.code_page,
    "phone as camera, live": partial(phone_drawn.code_page, live=True),
    "phone as camera, none": partial(phone_drawn.code_page, age=99.0),
    **{f"phone as camera, {key}": partial(phone_drawn.code_page, trouble=key) for key in phone_drawn.TROUBLES},
    "arena and radio": robots_drawn.radio_page,
    **{f"radio {reason}": partial(robots_drawn.radio_page, message=f"setup_{reason}") for reason in RADIO_REFUSALS},
    "event podium": event_podium,
    "event awards": event_awards,
    "ladder": lambda arcade: LadderChoice(arcade.context, "all"),
    "ladder resumed": partial(ladder, said="", rung=5, wins=1, losses=1, beaten=4, lost=999),
    "ladder assisted": partial(ladder, said="assisted", rung=3, beaten=2),
    "ladder easier": easier,
    "summit": summit,
    "climbers": climbers,
    "strengths": strengths,
    "title": lambda arcade: Title(arcade.context),
    "options": options,
    "operator": lambda arcade: OptionsPage(arcade.context, operator=True),
    "operator day": lambda arcade: OperatorPage(arcade.context),
    "operator quiet": lambda arcade: OperatorPage(arcade.context, quiet=True),
    "operator figures": figures,
    "trash": deleted,
    "empty trash": lambda arcade: TrashPage(arcade.context),
    "PIN": lambda arcade: typed(PinPage(arcade.context), LONGEST, "access.wrong"),
    "new PIN": lambda arcade: NewPinPage(arcade.context, first=True),
    "easy PIN": lambda arcade: typed(NewPinPage(arcade.context), 4, "access.easy"),
    "two PINs": lambda arcade: typed(NewPinPage(arcade.context), 0, "access.different"),
    **{f"options {section}": partial(options, section=section) for section in SECTIONS},
    "remap": lambda arcade: RemapPage(arcade.context),
    "board set-up": lambda arcade: SetUpPage(arcade.context),
    "board set-up that failed": board_failed,
    "guide of the mat": robots_drawn.guide,
    "robots menu": lambda arcade: RobotsMenu(arcade.context),
    "marker sheet written": sheet_written,
    "added games": added_games,
    "added games that failed": partial(added_games, first=6),
    **{f"new game, {state}": partial(new_game, state=state) for state in ("question", "plays", "stays_off", "unsaved")},
    "pad test": lambda arcade: ControlsTest(arcade.context),
    "pause": lambda arcade: Pause(match(arcade), KEYS[0]),
    "reconnect": lambda arcade: Reconnect(match(arcade), 3),
    "reconnect a phone": locked_phone,
    "join by phone": join_by_phone,
    "options of phones": phones_page,
    "join by phone, crowded": lambda arcade: join_by_phone(crowded(arcade)),
    "options of phones, crowded": lambda arcade: phones_page(crowded(arcade)),
    "all phones": phone_list,
    **{f"programs, {row}": partial(programs, focus=row) for row in ("enabled", "bot:mmmmmmmmmmmm")},
    "Wi-Fi password": lambda arcade: wifi_typing(PhonesPage(crowded(arcade).context), "wifi_key"),
    **{f"join by phone, {key}": partial(join_by_phone, trouble=key) for key in ("missing", "network_gone")},
    **{f"options of phones, {key}": partial(phones_page, trouble=key) for key in ("port_taken", "port_forbidden")},
    **{f"lobby {game} with phones": partial(lobby_with_phones, game=game) for game in games()},
    "pause with phones": lambda arcade: Pause(match(with_phones(arcade)), KEYS[0]),
    "still there": lambda arcade: StillThere(match(arcade)),
    "replays": lambda arcade: ReplaysPage(arcade.context),
    "play test": lambda arcade: PlayTestPage(arcade.context),
    "consent": partial(consent, ages=(0, 1, 2, 3)),
    "consent of nobody": partial(consent, ages=()),
    "devices": lambda arcade: DeviceTable(
        arcade.context, KEYS, Access(arcade.context, lambda: KEYS), lambda device: POINT
    ),
    **{f"how to play {game}": partial(how_to_play, game=game) for game in games()},
    **{f"setup {game}": partial(choice, game=game) for game in games()},
    **{f"lobby {game}": partial(lobby, game=game, people=0, ais=0) for game in games()},
    **{f"full lobby {game}": partial(lobby, game=game, people=3, ais=1) for game in games()},
    "lobby with one button": one_button,
    **{f"best {game}": partial(best, game=game) for game in games()},
    **{f"results {name}": ending.results for name, ending in ENDINGS.items()},
    **{f"numbers {name}": ending.numbers for name, ending in ENDINGS.items()},
}
