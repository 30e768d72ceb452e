"""Events on the screen: set-up by pad and list, seats, results on disk, absent and late people, corrections, podium."""

from dataclasses import replace
from pathlib import Path
from time import sleep

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Corrected
from pigaming_app.events.match_setup import outcome_of, setup_of
from pigaming_app.events.spec import Entrant, Format
from pigaming_app.games.registry import OURS
from pigaming_app.scenes.events import next_page
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.manage.corrections import Correction, ResultsList
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.next_view import match_line
from pigaming_app.scenes.events.paper.poster import poster
from pigaming_app.scenes.events.podium_page import EventPodiumPage, robots_of
from pigaming_app.scenes.events.quick_match import QuickMatches
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.seats import EventSeats
from pigaming_app.scenes.events.setup.arenas_page import ArenasPage
from pigaming_app.scenes.events.setup.draft import BY_TURNS, Draft
from pigaming_app.scenes.events.setup.entrants_page import EntrantsPage
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.scene import Pop
from pigaming_app.scenes.pages.page import MESSAGE_ROOM
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.scenes.phones.link import PhoneLink
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.phone_messages import SeatView
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.widgets import setting_row
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import an_event, played, result_of, running, saved
from tests.ui.input.virtual_pad import VirtualPad

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


def at_next(arcade: Arcade, run: RunningEvent) -> NextMatch:
    """The page of the next match, ready for input."""
    page = arcade.open(NextMatch(arcade.context, run))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    return page


def test_an_event_is_set_up_by_pad_and_saved_before_its_first_match(arcade: Arcade) -> None:
    arcade.open(EventsPage(arcade.context))
    arcade.press(Button.FIRE)
    page = arcade.shown(SetupPage)
    arcade.press(Button.RIGHT)
    assert page.draft.format is Format.ROUND_ROBIN
    arcade.press(Button.START)
    arcade.shown(EntrantsPage)
    arcade.press(Button.FIRE)
    letters = arcade.shown(LettersPage)
    arcade.wait(0.4)
    arcade.press(Button.DOWN, *[Button.FIRE] * 3, *[Button.UP, Button.FIRE, Button.FIRE, Button.FIRE], Button.START)
    assert letters.names() == ["BAA", "ZAA", "AAA"]
    arcade.press(Button.START)
    assert letters.refusal, "AAA is taken"
    arcade.press(Button.BACK)
    entrants = arcade.shown(EntrantsPage)
    arcade.press(Button.RIGHT, Button.FIRE)
    assert entrants.draft.entrants[-1] == Entrant("BOT3", "level3")
    arcade.press(Button.START)
    run = arcade.shown(NextMatch).running
    assert [entrant.name for entrant in saved(run).entrants] == ["BAA", "ZAA", "AAA", "BOT3"]
    assert len(run.event.fixtures) == 6


def test_games_and_arenas_take_turns_in_the_order_that_is_chosen(arcade: Arcade) -> None:
    """By pad and mouse: a Grand Prix of race, PiTanks and factory, the race on two tracks."""
    arcade.open(EventsPage(arcade.context))
    arcade.press(Button.FIRE)
    page = arcade.shown(SetupPage)
    while page.draft.format is not Format.GRAND_PRIX:
        arcade.press(Button.RIGHT)
    arcade.press(Button.DOWN)
    assert page.focus.name == "order"
    while page.draft.order[:3] != ("race", "pitanks", "factory"):
        arcade.press(Button.RIGHT)
    page.draft.choose("rounds", 8)
    arcade.press(Button.DOWN, Button.FIRE)
    arenas = arcade.shown(ArenasPage)
    assert arenas.focus.name == "race classic"
    arcade.press(Button.DOWN, Button.FIRE, Button.UP, Button.FIRE, Button.FIRE)
    assert page.draft.arenas("race") == ("hairpin", "classic")
    arcade.click(*arenas.focus.rect("factory hall").center)
    assert page.draft.arenas("factory") == ("hall",), "the only one stays"
    arcade.press(Button.BACK)
    page.draft.entrants += [Entrant(name) for name in ("ANA", "BEA", "EVA")]
    arcade.shown(SetupPage)
    arcade.press(Button.START, Button.START)
    event = saved(arcade.shown(NextMatch).running)
    played = [(one.game, one.arena) for one in event.fixtures[:6] if one.game in OURS]
    assert played[:5] == [
        ("race", "hairpin"), ("pitanks", "classic"), ("factory", "hall"), ("race", "classic"), ("pitanks", "classic"),
    ]  # fmt: skip


def test_hammering_fire_enters_no_name(arcade: Arcade) -> None:
    names: list[str] = []
    page = LettersPage(arcade.context, lambda name: names.append(name) or "", lambda: names)  # type: ignore[func-returns-value]
    arcade.open(page)
    arcade.wait(0.4)
    arcade.press(*[Button.FIRE] * 6)
    assert names == []
    assert page.refusal


def test_a_list_is_pasted_or_dropped_and_a_bad_one_is_refused(arcade: Arcade, tmp_path: Path) -> None:
    page = arcade.open(EntrantsPage(arcade.context, Draft(), lambda draft: "no"))
    page.add_list("Ana, Bea, Carla")
    page.add_list("Ana\nDuda=level2\nEva/Blue")
    assert [(one.name, one.brain, one.team) for one in page.draft.entrants] == [
        ("Ana", "", ""),
        ("Bea", "", ""),
        ("Carla", "", ""),
        ("Duda", "level2", ""),
        ("Eva", "", "Blue"),
    ]
    (tmp_path / "list.csv").write_text("name;ai;team\nFred;;\nGil;level1;\n", encoding="utf-8")
    (tmp_path / "list.bin").write_bytes(b"\xff\xfe\x00broken")
    arcade.context.dropped += [tmp_path / "list.csv", tmp_path / "list.bin", tmp_path / "nowhere.txt"]
    arcade.frame(draw=True)
    assert len(page.draft.entrants) == 7
    assert page.message == "nowhere.txt: " + arcade.context.words("events.unread")
    page.focus.move_to("0")
    arcade.press(Button.X)
    assert page.draft.entrants[0].name == "Bea"


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ("Ana\nAna Beatriz Carla Duarte E\n", "bad_name", {"line": 2, "text": "Ana Beatriz C…uarte E"}),
        ("Ana\nAna\n", "bad_taken", {"line": 2, "text": "Ana"}),
        ("Ana\nBea,level1,Red,x\n", "bad_line", {"line": 2, "text": "Bea, level1, Red, x"}),
        ("\n".join(f"N{i}" for i in range(500)), "bad_full", {"line": 65, "text": "N64", "most": 64}),
        ("Ana\nBea=level9\n", "bad_ai", {"line": 2, "text": "level9"}),
    ],
)
def test_a_list_is_refused_as_a_whole_with_file_line_and_reason(
    arcade: Arcade, tmp_path: Path, text: str, key: str, words: dict[str, object]
) -> None:
    page = EntrantsPage(arcade.context, Draft(), lambda draft: "no")
    page.add_list(text)
    assert page.draft.entrants == []
    assert page.message == arcade.context.words(f"events.{key}", **words)
    (tmp_path / "list.csv").write_text(text, encoding="utf-8")
    arcade.context.dropped.append(tmp_path / "list.csv")
    page.update(0.1)
    assert page.message == "list.csv: " + arcade.context.words(f"events.{key}", **words)


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_said_of_a_list_is_legible_on_the_page(arcade: Arcade) -> None:
    """Long names of files, AIs, people and columns."""
    page = EntrantsPage(arcade.context, Draft(), lambda draft: "no")
    name = "Bernardino Albuquerque de Sousa"
    lists = (name, "Ana\nAna", f"Ana,a,b,{name}", f"Ana={name}", "\n".join(f"N{i}" for i in range(99)))
    for text in (*lists, f"Name;Anmerkungen;Jahrgangsstufe;{name};Klassenleitung\nAna\nBea\n"):
        page.add_list(text, "Anmeldungen Tag der offenen Tür.csv")
        assert fit_size(page.message, BODY, MESSAGE_ROOM, "body") >= 36, page.message
    assert len(page.draft.entrants) == 2


def test_the_clipboard_may_be_empty(arcade: Arcade) -> None:
    page = arcade.open(EntrantsPage(arcade.context, Draft(), lambda draft: "no"))
    page.focus.move_to("paste")
    arcade.press(Button.FIRE)
    assert page.draft.entrants == []
    assert page.message


def test_too_few_entrants_do_not_begin(arcade: Arcade) -> None:
    page = EntrantsPage(arcade.context, Draft(entrants=[Entrant("ANA"), Entrant("BEA")]), lambda draft: "never asked")
    arcade.open(page)
    arcade.press(Button.START)
    assert page.message == arcade.context.words("events.few", fewest=3)


def test_only_what_can_be_done_now_is_offered(arcade: Arcade) -> None:
    page = arcade.open(EntrantsPage(arcade.context, Draft(Format.GRAND_PRIX), lambda draft: ""))
    page.draw(arcade.screen)
    assert page.prompts.buttons == [Button.FIRE, Button.BACK]
    page.add_list("AAA\nBBB\nCCC")
    page.update(9.0)
    page.draw(arcade.screen)
    assert page.prompts.buttons == [Button.FIRE, Button.X, Button.START, Button.BACK]
    arcade.press(Button.UP)
    page.draw(arcade.screen)
    assert page.prompts.buttons == [Button.X, Button.Y, Button.START, Button.BACK]


@pytest.mark.parametrize("form", Format)
def test_every_row_of_the_set_up_has_a_picture_of_its_value(arcade: Arcade, form: Format) -> None:
    draft = Draft()
    draft.choose("format", form)
    page = arcade.open(SetupPage(arcade.context, draft, lambda draft: ""))
    pictures = set()
    for _ in page.focus.spots:
        page.update(1.0)
        page.draw(arcade.screen)
        inner = setting_row.PANEL.inflate(-40, -40)
        pictures.add(arcade.screen.subsurface(inner.x, inner.y, inner.w, 320).copy().get_buffer().raw)
        arcade.press(Button.DOWN)
    shared = len({"game", "order", "arena"} & {spot.name for spot in page.focus.spots})
    assert len(pictures) == len(page.focus.spots) - max(0, shared - 1), "game and arena share one"


def test_every_draft_makes_an_event_that_can_be_played(arcade: Arcade) -> None:
    page = EventsPage(arcade.context)
    for form in Format:
        draft = Draft()
        draft.choose("format", form)
        for row in draft.rows:
            for option in draft.options(row):
                changed = Draft(entrants=[Entrant(f"E{i}") for i in range(12)])
                changed.choose("format", form)
                if row == "length":
                    changed.choose("game", BY_TURNS)
                changed.choose(row, option)
                assert not isinstance(page.begin(changed), str), (form, row, option)


def test_people_take_the_seats_of_their_names_and_the_result_is_on_disk_at_once(arcade: Arcade) -> None:
    run = running(an_event())
    page = at_next(arcade, run)
    fixture = page.fixture
    assert fixture
    arcade.press(Button.FIRE, device=KEYS[0])
    assert page.seats.claims == {0: KEYS[0]}
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.wait(ALL_READY + 0.2, draw=True)
    scene = arcade.shown(MatchScene)
    assert scene.devices[:2] == KEYS[:2]
    assert [seat.brain for seat in scene.setup.seats] == ["human", "human", "off", "off"]
    arcade.finish(5, 1)
    assert saved(run).outcomes[fixture.number].places == ((fixture.entrants[0],), (fixture.entrants[1],))
    assert arcade.shown(WinnersMoment).name == f"{fixture.entrants[0]} wins!"
    arcade.skip_moments()
    assert arcade.shown(NextMatch).fixture != fixture


@pytest.mark.parametrize("then", ["people", "AIs", "nothing"])
@pytest.mark.parametrize("seats", [2, 4])
def test_another_match_may_become_the_next_one_while_cards_are_prepared(arcade: Arcade, seats: int, then: str) -> None:
    for prepared in range(seats + 2):
        run = running(an_event(seats=seats, count=8), f"{prepared}")
        page = NextMatch(arcade.context, run)
        for _ in range(prepared):
            page.prewarm(0.0)  # one part
        run.event = played(run.event, 10_000 if then == "nothing" else 1)
        for name in run.event.open[0].entrants if then == "AIs" else ():
            run.event = run.event.substitute(name, "level3")
        assert page.prewarm(10_000.0)


def test_cards_are_prepared_to_the_last_although_the_file_is_read_anew(arcade: Arcade) -> None:
    run = running(an_event(seats=4))
    jobs = EventSeats(arcade.context, run).jobs()
    next(jobs)
    run.event = saved(run)
    assert len(list(jobs)) == 3


def test_an_ai_that_wins_for_somebody_absent_is_called_one(arcade: Arcade) -> None:
    page = at_next(arcade, running(an_event()))
    assert page.fixture
    absent = page.fixture.entrants[1]
    arcade.press(Button.FIRE, device=KEYS[0])
    arcade.press(Button.Y)
    arcade.wait(ALL_READY + 0.2)
    arcade.finish(1, 5)
    assert arcade.shown(WinnersMoment).name == f"The AI for {absent} wins!"


def test_each_pad_takes_its_own_seat_first(arcade: Arcade) -> None:
    with VirtualPad() as one, VirtualPad() as two:
        arcade.frame()
        page = at_next(arcade, running(an_event()))
        pads = arcade.context.controls.pads()
        assert {pad.number for pad in pads} == {one.number, two.number}
        arcade.press(Button.FIRE, device=pads[1])
        assert page.seats.claims == {1: pads[1]}
        arcade.press(Button.LEFT, device=pads[1])
        assert page.seats.claims == {0: pads[1]}
        arcade.press(Button.BACK, device=pads[1])
        assert page.seats.claims == {}


def test_a_phone_takes_a_seat_shows_it_and_frees_it_when_locked(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: dict[int, SeatView] = {}
    monkeypatch.setattr(Phones, "show", lambda self, number, view: shown.__setitem__(number, view))
    phones, link = arcade.context.controls.phones, PhoneLink(arcade.context)
    page = at_next(arcade, running(an_event()))
    numbers = [phones.connect(), phones.connect()]
    arcade.frame()
    two = Device("phone", numbers[1])
    arcade.press(Button.FIRE, device=two)
    assert page.seats.claims == {1: two}, "the second handheld has the second seat"
    page.draw(arcade.screen)
    assert page.seats._driver(1, "") == ("phone", "Phone")
    link.update(arcade.stack.scenes)
    assert [shown[number].seat for number in numbers] == [-1, 1]
    phones.disconnect(two.number)
    arcade.frame()
    assert page.seats.claims == {}
    phones.connect(two.number)
    arcade.frame()
    arcade.press(Button.FIRE, device=two)
    arcade.press(Button.FIRE, device=Device("phone", numbers[0]))
    arcade.wait(ALL_READY + 0.2)
    assert [device.number for device in arcade.shown(MatchScene).devices if device] == numbers
    for number in numbers:
        phones.disconnect(number)


def test_a_match_ended_by_hand_is_still_to_be_played(arcade: Arcade) -> None:
    run = running(an_event())
    page = at_next(arcade, run)
    fixture = page.fixture
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device=device)
    arcade.press(Button.START)
    arcade.shown(MatchScene).opening.countdown.seconds_left = 0.05
    arcade.wait(0.3)
    arcade.press(Button.START)
    pause = arcade.shown(Pause)
    assert "restart" not in [spot.name for spot in pause.focus.spots]
    arcade.press(Button.UP, Button.FIRE, Button.FIRE)
    assert arcade.reach(NextMatch).fixture == fixture
    assert saved(run).outcomes == {}


def test_absent_people_are_skipped_or_replaced_and_may_come_back(arcade: Arcade) -> None:
    run = running(an_event())
    page = at_next(arcade, run)
    first = page.fixture
    arcade.press(Button.X)
    assert page.fixture != first
    assert saved(run).open[-1] == first
    second = page.fixture
    assert second
    arcade.press(Button.FIRE, device=KEYS[0])
    arcade.press(Button.START)
    assert isinstance(arcade.stack.top, NextMatch), "somebody is missing"
    arcade.press(Button.Y)
    assert (page.seats.claims, page.seats.waiting) == ({0: KEYS[0]}, [])
    assert run.brain(second.entrants[1]) == "level3"
    arcade.press(Button.FIRE, device=KEYS[1])
    assert page.seats.claims == {0: KEYS[0], 1: KEYS[1]}
    assert saved(run).entrants == run.event.spec.entrants


@pytest.mark.parametrize("late", [False, True])
def test_whoever_is_back_takes_a_seat_even_if_ais_have_all_of_them(arcade: Arcade, late: bool) -> None:
    """Of people who are in the list from the beginning, and of late ones."""
    event = an_event(Format.ROUND_ROBIN, brains="level1" if late else "")
    event = event.add(Entrant("EVA")).add(Entrant("IDA")) if late else event
    while late and {*event.open[0].entrants} != {"EVA", "IDA"}:
        event = event.postpone(event.open[0].number)
    run = running(event)
    page = at_next(arcade, run)
    arcade.press(Button.Y)
    fixture = page.fixture
    assert fixture
    assert run.without_people(fixture)
    arcade.shown(NextMatch)
    arcade.press(Button.FIRE, device=KEYS[2])
    assert page.seats.claims == {0: KEYS[2]}
    assert (run.brain(fixture.entrants[0]), run.brain(fixture.entrants[1])) == ("", "level3")
    assert saved(run) == run.event
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))


def test_a_late_entrant_joins_before_round_two_only(arcade: Arcade) -> None:
    run = running(an_event())
    at_next(arcade, run)
    arcade.press(Button.DOWN)
    arcade.shown(LettersPage)
    arcade.wait(0.4)
    arcade.press(Button.DOWN, Button.DOWN, Button.START, Button.BACK)
    assert "CAA" in [entrant.name for entrant in saved(run).entrants]
    run.change(lambda event: played(event, 3))
    assert not run.accepts_late
    arcade.press(Button.DOWN)
    assert isinstance(arcade.stack.top, NextMatch)


def test_a_result_is_corrected_with_a_note(arcade: Arcade) -> None:
    run = running(played(an_event(Format.ROUND_ROBIN), 2))
    arcade.open(TablePage(arcade.context, run))
    arcade.press(Button.X)
    arcade.shown(ResultsList)
    arcade.press(Button.FIRE)
    page = arcade.shown(Correction)
    before = run.event.outcomes[page.fixture.number]
    arcade.press(Button.RIGHT, Button.DOWN, Button.LEFT, Button.START)
    arcade.shown(ResultsList)
    after = saved(run).outcomes[page.fixture.number]
    assert after.places == before.places[::-1]
    assert after.note
    assert isinstance(saved(run).journal[-1], Corrected)


def test_matches_of_ais_are_played_in_the_background_and_counted_once(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    class AtOnce:
        """Matches that are over as soon as they are asked for."""

        def __init__(self, event, fixtures):
            self.outcomes = [result_of(fixture) for fixture in fixtures]
            self.left = 0

        @property
        def over(self) -> bool:
            return not self.outcomes

        def next_outcome(self):
            return self.outcomes.pop(0) if self.outcomes else None

        def end(self) -> None:
            self.outcomes.clear()

    monkeypatch.setattr(next_page, "QuickMatches", AtOnce)
    run = running(an_event(brains="level1"))
    at_next(arcade, run)
    arcade.press(Button.Y)
    arcade.until(lambda: isinstance(arcade.stack.top, EventPodiumPage))
    assert len(saved(run).outcomes) == len(run.event.fixtures) == 6


def test_a_match_of_ais_is_a_show_and_the_next_one_begins_by_itself(arcade: Arcade) -> None:
    run = running(an_event(brains="level1"))
    at_next(arcade, run)
    arcade.press(Button.FIRE)
    arcade.finish(3, 1)
    assert arcade.shown(WinnersMoment).name == f"AI {run.event.fixtures[0].entrants[0]} wins!"
    arcade.until(lambda: isinstance(arcade.stack.top, NextMatch))
    assert len(saved(run).outcomes) == 1
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))


def test_the_podium_ends_an_event_and_leads_to_the_table(arcade: Arcade) -> None:
    run = running(played(an_event(Format.KNOCKOUT, 5)))
    at_next(arcade, run)
    page = arcade.shown(EventPodiumPage)
    assert page.best[0].entrant == run.event.standings[0].entrant
    assert not page.robots
    ais = running(played(an_event(Format.KNOCKOUT, 5, brains="level1")), "ais")
    assert {row.entrant for row in EventPodiumPage(arcade.context, ais).best} <= robots_of(ais)
    arcade.wait(4.0, draw=True)
    arcade.press(Button.FIRE)
    arcade.shown(TablePage)
    arcade.press(Button.BACK)
    arcade.shown(EventPodiumPage)


def test_an_event_goes_on_after_a_restart_and_a_damaged_one_is_listed(arcade: Arcade) -> None:
    run = running(played(an_event(), 1))
    (run.path.parent / "broken.json").write_text("{", encoding="utf-8")
    arcade.open(EventsPage(arcade.context))
    page = arcade.shown(EventsPage)
    broken = next(i for i, listed in enumerate(page.saved) if listed.event is None)
    page.focus.move_to(str(broken))
    arcade.press(Button.FIRE)
    arcade.shown(EventsPage)
    page.focus.move_to(str(1 - broken))
    arcade.press(Button.FIRE)
    assert arcade.shown(NextMatch).running.event == run.event


def test_a_result_that_cannot_be_saved_is_said_and_kept(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, text: str) -> None:
        raise NotSaved("the disk is full")

    run = running(an_event(Format.ROUND_ROBIN, brains="level1"))
    at_next(arcade, run)
    arcade.press(Button.FIRE)
    with monkeypatch.context() as disk:
        disk.setattr(event_files, "write_with_backup", full)
        arcade.finish(3, 1)
        arcade.until(lambda: isinstance(arcade.stack.top, NextMatch))
    assert arcade.shown(NextMatch).message == arcade.context.words("app.unsaved")
    assert len(run.event.outcomes) == 1
    assert saved(run).outcomes == {}
    arcade.wait(INPUT_LOCKOUT + 0.1)
    arcade.press(Button.X)
    assert saved(run).outcomes == run.event.outcomes, "saved with the next change"


def test_two_processes_on_one_event_lose_and_double_nothing(arcade: Arcade) -> None:
    run = running(an_event(Format.ROUND_ROBIN, brains="level1"))
    other = RunningEvent(run.path, saved(run))
    at_next(arcade, run)
    arcade.press(Button.FIRE)
    second = other.event.open[1]
    assert other.change(lambda event: event.record(result_of(second)))
    assert run.event.outcomes == {}, "this process has read less"
    arcade.finish(3, 1)
    assert sorted(saved(run).outcomes) == [1, second.number]
    arcade.until(lambda: isinstance(arcade.stack.top, NextMatch))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    third = run.event.open[0]
    assert other.change(lambda event: event.record(result_of(third)))
    arcade.press(Button.FIRE)
    assert arcade.shown(NextMatch).message == arcade.context.words("events.elsewhere")
    assert run.event == other.event, "nobody plays a match that has a result"
    arcade.press(Button.FIRE)
    third = run.event.open[0]
    assert other.change(lambda event: event.record(result_of(third)))
    arcade.finish(3, 1)
    assert arcade.reach(NextMatch).message == arcade.context.words("events.elsewhere")
    assert saved(run) == run.event == other.event


def test_a_robot_that_is_gone_is_said_and_its_match_skipped(arcade: Arcade) -> None:
    run = running(an_event(brains=str(folders().data / "robots" / "GONE.npz")))
    page = at_next(arcade, run)
    arcade.press(Button.FIRE)
    assert arcade.shown(NextMatch).message == arcade.context.words("events.failed")
    arcade.press(Button.X)
    assert page.message == arcade.context.words("events.skipped")


def test_no_folder_for_events_is_said(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, event: object) -> None:
        raise NotSaved("the disk is full")

    monkeypatch.setattr(event_files, "save", full)
    page = EventsPage(arcade.context)
    draft = Draft(entrants=[Entrant("ANA"), Entrant("BEA"), Entrant("EVA")])
    assert page.begin(draft) == arcade.context.words("app.unsaved")


def test_every_page_survives_every_press(arcade: Arcade) -> None:
    run = running(played(an_event(Format.GRAND_PRIX, 6, 4), 2))
    pages = (
        lambda: EventsPage(arcade.context),
        lambda: SetupPage(arcade.context, Draft(), lambda draft: "no"),
        lambda: ArenasPage(arcade.context, Draft(game=BY_TURNS)),
        lambda: EntrantsPage(arcade.context, Draft(entrants=[Entrant("ANA")]), lambda draft: "no"),
        lambda: LettersPage(arcade.context, lambda name: "", list),
        lambda: NextMatch(arcade.context, run),
        lambda: TablePage(arcade.context, run),
        lambda: ResultsList(arcade.context, run),
        lambda: Correction(arcade.context, run, run.event.fixtures[0]),
        lambda: EventPage(arcade.context, run.path, run, Pop()),
        lambda: EventPage(arcade.context, run.path, None, Pop()),
        lambda: TextPage(arcade.context, "Title", "Cup", 5, lambda text: ""),
        lambda: EventPodiumPage(arcade.context, running(played(an_event(count=3)), "over")),
    )
    for make in pages:
        for button in Button:
            for device in (KEYS[0], Device("mouse"), Device("pad", 99)):
                scene = make()
                scene.on_enter()
                scene.update(0.7)
                at = (960.0, 240.0) if device.kind == "mouse" else None
                scene.handle(InputEvent(button, device, at=at))
                scene.update(0.1)


def test_an_event_of_a_game_that_was_removed_is_shown_and_plays_nothing(arcade: Arcade) -> None:
    event = Event(replace(an_event(brains="fsm").spec, games=("gone_game",)))
    page = at_next(arcade, running(event))
    assert page.fixture
    assert match_line(arcade.context.words, page.fixture, page.running.setup(page.fixture)) == "Gone Game"
    page.draw(arcade.screen)
    assert [*filter(None, poster(event, arcade.context.words))]
    for button in (Button.FIRE, Button.START, Button.Y):
        arcade.press(button)
        arcade.wait(0.5, draw=True)
    assert not running(event).event.outcomes


@pytest.mark.long
def test_a_match_in_the_background_ends_as_the_show_does(arcade: Arcade) -> None:
    event = an_event(brains="level2")
    quick = QuickMatches(event, event.open[:1])
    while (outcome := quick.next_outcome()) is None and not quick.over:
        sleep(0.01)
    shown = new_match(setup_of(event, event.open[0]))
    while not shown.over:
        shown.tick()
    assert outcome == outcome_of(event.spec, event.open[0], shown.outcome().rows)
    assert quick.left == 0


def test_matches_in_the_background_end_with_the_page(arcade: Arcade) -> None:
    page = at_next(arcade, running(an_event(brains="level1")))
    arcade.press(Button.Y)
    quick = page.quick
    assert quick
    arcade.press(Button.BACK)
    assert (page.quick, quick.left) == (None, 2)
    arcade.press(Button.Y)
    quick = page.quick
    assert quick
    arcade.press(Button.START)
    arcade.stack.clear()
    assert quick.over
