"""The next match of an event: who plays what, in which seat and on which pad, and who is next after that.

Each person presses FIRE to take the seat of their name: the first pad that of the first person, and so on. Whoever is
absent is skipped with one press, or an AI drives in their place with another. A match of AIs is a show, or is played at
once in the background.
"""

import logging
from collections.abc import Callable, Iterator
from functools import partial
from itertools import takewhile

import pygame

from pigaming_app.ai.registry import find_brain, level_of
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import outcome_of, setup_of
from pigaming_app.events.spec import DEFAULT_AI, Entrant, Fixture
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.events import next_view as view
from pigaming_app.scenes.events.podium_page import PodiumPage
from pigaming_app.scenes.events.quick_match import QuickMatches
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.brain_names import brain_name
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_title, load_cached
from pigaming_app.scenes.flow.match_words import match_length
from pigaming_app.scenes.flow.stack import Pop, Push, StackOperation, Swap
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.scenes.robots.start_match import match_of
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, LABEL, MIST, text_width
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import LEFT, RIGHT, backdrop
from pigaming_app.ui.draw.text import text
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.labels import black_out, call_to_action, heading, pulse
from pigaming_app.ui.widgets.player_card import ask_bar, ready_bar

INPUT_LOCKOUT = 0.6  # s during which input is ignored: players may still hammer
ALL_READY = 2.5  # s from the last seat taken to the match
MESSAGE_SECONDS = 4.0
SHOW_AFTER = 8.0  # s until the next match of AIs begins, after one that was watched

log = logging.getLogger("pigaming")


class NextMatch:
    """The page of the first open match. `said`: key of a message; `show`: matches of AIs begin by themselves."""

    def __init__(self, context: Context, running: RunningEvent, said: str = "", show: bool = False) -> None:
        self.context, self.running, self.show = context, running, show
        self.claims: dict[int, Device] = {}  # by seat
        self.quick: QuickMatches | None = None  # matches of AIs in the background
        self._known: tuple[Event, Setup | None] | None = None  # the match, as long as the event is the same
        self.access = Access(context, lambda: [self.claims.get(seat) for seat in range(ROBOTS)])  # seats of phones
        self.clock, self.ready = 0.0, 0.0
        self.going = False  # a match is wanted, but not loaded yet
        self.message, self.message_left = said, MESSAGE_SECONDS if said else 0.0
        self.queue = PrewarmQueue(self._jobs())

    # ---- lifecycle

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        self.context.sounds.music(True)
        self.ready = 0.0

    def on_leave(self) -> None:
        """Stop the matches in the background."""
        self._stop_quick()

    @property
    def fixture(self) -> Fixture | None:
        """The match; None when all have been played."""
        open_now = self.running.event.open
        return open_now[0] if open_now else None

    @property
    def people(self) -> list[int]:
        """Seats of people who play themselves."""
        fixture = self.fixture
        return [i for i, name in enumerate(fixture.entrants) if not self.running.brain(name)] if fixture else []

    @property
    def waiting(self) -> list[int]:
        """Seats of people that nobody has taken."""
        return [seat for seat in self.people if seat not in self.claims]

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE takes a seat, START begins, X skips the match, Y lets an AI drive, UP shows the table, BACK leaves."""
        event = self.prompts.as_button(event)
        if event.button is Button.LOST:
            self._release(event.device)
        if self.clock < INPUT_LOCKOUT or self.going:
            return None
        if self.quick:
            if event.button is Button.BACK:
                self._stop_quick()
                self.context.sounds.play("back")
            return None
        if event.button in (Button.POINT, Button.FOUND, Button.LOST, Button.STOP):
            return None
        self.show = False
        device = event.among[0] if event.among else event.device
        match event.button:
            case Button.BACK | Button.LEAVE_SEAT if device in self.claims.values():
                self._release(device)
                self.context.sounds.play("back")
            case Button.BACK:
                self.context.sounds.play("back")
                return Pop()
            case Button.UP:
                self.context.sounds.play("accept")
                return Push(TablePage(self.context, self.running))
            case Button.DOWN if self._late_allowed:
                self.context.sounds.play("accept")
                return Push(LettersPage(self.context, self._add, self._names))
            case Button.LEFT | Button.RIGHT:
                self._move(device, 1 if event.button is Button.RIGHT else -1)
            case Button.X:
                self._postpone()
            case Button.Y:
                self._replace_absent()
            case Button.FIRE if self.people:
                self._take(device)
            case Button.FIRE | Button.START:
                return self._start()
            case _:
                pass
        return None

    def update(self, seconds: float) -> StackOperation:
        """Begin when everybody is there; record a match played in the background."""
        self.clock += seconds
        self.message_left -= seconds
        self.queue.work(2.0)
        if self.fixture is None:
            return Swap(PodiumPage(self.context, self.running))
        if self.going:
            return self._begin()
        if self.quick:
            self._record_quick(self.quick)
        else:
            self.ready = self.ready + seconds if self.people and not self.waiting else 0.0
            shown = self.show and not self.people and self.clock > SHOW_AFTER
            if shown or self.ready > ALL_READY:
                return self._start()
        return None

    def draw(self, screen: pygame.Surface) -> None:
        fixture, words = self.fixture, self.context.words
        screen.blit(backdrop(), (0, 0))
        if fixture is None:
            return
        heading(words("events.next"), self._what(fixture)).draw(screen)
        count = len(fixture.entrants)
        black_out(screen, *(view.card_rect(i, count) for i in range(count)))
        for seat, name in enumerate(fixture.entrants):
            self._card(screen, seat, name, count)
        self._draw_message(screen, fixture)
        event = self.running.event
        then = [" ".join(other.entrants) for other in event.open[1:4]]
        line = progress_line(words, event)
        text(line, BODY, MIST, "body", "r").draw(screen, RIGHT, view.THEN_Y)
        if then:
            room = RIGHT - LEFT - 48 - text_width(line, BODY, "body")
            said = view.following(lambda names: words("events.then", names=names), then, room)
            text(said, LABEL, MIST, "head", "l", round(room)).draw(screen, LEFT, view.THEN_Y)
        self.prompts.draw(screen)

    @property
    def prompts(self) -> ButtonPrompts:
        """The prompts of this match."""
        late = [(Button.DOWN, "events.hint_late")] if self._late_allowed else []
        if self.quick:
            hints = [(Button.BACK, "events.hint_stop")]
        elif self.people:
            hints = [
                (Button.START, "events.hint_begin"),
                (Button.X, "events.hint_skip"),
                (Button.Y, "events.hint_ai"),
                (Button.UP, "events.hint_table"),
                *late,
                (Button.BACK, "events.hint_back"),
            ]
        else:
            hints = [
                (Button.FIRE, "events.hint_watch"),
                (Button.Y, "events.hint_quick"),
                (Button.X, "events.hint_skip"),
                (Button.UP, "events.hint_table"),
                *late,
                (Button.BACK, "events.hint_back"),
            ]
        return self.context.prompts(hints)

    # ---- seats

    def _take(self, device: Device) -> None:
        """Take a seat: the one of this device, or the first that is free; a person for whom an AI drives comes back."""
        if device.kind == "mouse" or device in self.claims.values():
            return
        fixture = self.fixture
        assert fixture is not None
        own = [seat for seat in self.waiting if self._suggested(seat) == device or self._last(seat) == device]
        if seats := [*own, *self.waiting]:
            self.claims[seats[0]] = device
            self.running.devices[fixture.entrants[seats[0]]] = device
            self.context.sounds.play("join", seats[0])
        else:
            self._bring_back(device)

    def _bring_back(self, device: Device) -> None:
        """A person for whom an AI drives is there again."""
        fixture = self.fixture
        assert fixture is not None
        for seat, name in enumerate(fixture.entrants):
            if self.running.brain(name) and self.running.is_person(name):
                if self._change(self.running.event.substitute(name, "")):
                    self.claims[seat] = device
                    self.context.sounds.play("join", seat)
                return

    def _move(self, device: Device, by: int) -> None:
        """Move a device to the next seat of a person; whoever sits there takes the other one."""
        seats = self.people
        own = next((seat for seat, other in self.claims.items() if other == device), None)
        if own is None or len(seats) < 2:
            return
        there = seats[(seats.index(own) + by) % len(seats)]
        other = self.claims.pop(there, None)
        del self.claims[own]
        self.claims[there] = device
        if other:
            self.claims[own] = other
        self.ready = 0.0
        self.context.sounds.play("move")

    def _release(self, device: Device) -> None:
        self.claims = {seat: other for seat, other in self.claims.items() if other != device}

    def _suggested(self, seat: int) -> Device | None:
        """The device for the seat of a person: the first pad for the first one, and so on; then the keyboard."""
        players, index = self.context.controls.players(), self.people.index(seat)
        return players[index] if index < len(players) else None

    def _last(self, seat: int) -> Device | None:
        """What the entrant on a seat has driven with before."""
        fixture = self.fixture
        return self.running.devices.get(fixture.entrants[seat]) if fixture else None

    # ---- changes of the event

    @property
    def _late_allowed(self) -> bool:
        return self.running.accepts_late

    def _names(self) -> list[str]:
        return [entrant.name for entrant in self.running.event.entrants]

    def _add(self, name: str) -> str:
        """Enter a late person; returns the sentence why not, or an empty one."""
        words = self.context.words
        if name in self._names():
            return words("events.taken", name=name)
        try:
            event = self.running.event.add(Entrant(name))
        except ValueError as reason:
            log.warning("%s", reason)
            return words("events.too_late")
        self.claims.clear()
        return "" if self.running.change(event) else words("app.unsaved")

    def _postpone(self) -> None:
        fixture = self.fixture
        assert fixture is not None
        if len(self.running.event.open) == 1:
            self._say("events.only_one")
            return
        if self._change(self.running.event.postpone(fixture.number)):
            self._say("events.skipped", "move")

    def _replace_absent(self) -> None:
        """An AI drives for everybody who is absent; without people, play the matches of AIs in the background."""
        fixture = self.fixture
        assert fixture is not None
        if not self.people:
            self._play_quick()
            return
        event = self.running.event
        for seat in self.waiting:
            event = event.substitute(fixture.entrants[seat], DEFAULT_AI)
        if event is not self.running.event and self._change(event):
            self._say("events.stand_in", "join")

    def _change(self, event: Event) -> bool:
        """Save a changed event; false, with a message, if that is impossible."""
        before, saved = self.fixture, self.running.change(event)
        if self.fixture != before:
            self.claims.clear()
            self.ready = 0.0
        if not saved:
            self._say("app.unsaved", "error")
        return saved

    def _say(self, key: str, sound: str = "refused") -> None:
        self.message, self.message_left = key, MESSAGE_SECONDS
        self.context.sounds.play(sound)

    # ---- matches

    def _start(self) -> StackOperation:
        if self.waiting:
            self._say("events.missing")
            return None
        self.context.sounds.play("accept")
        self.going = True
        return self._begin()

    def _begin(self) -> StackOperation:
        """Swap to the match, or return None while it is being loaded."""
        fixture = self.fixture
        assert fixture is not None
        setup = self._setup_of(fixture)
        if setup is None:
            self.going = False
            self._say("events.failed", "error")
            return None
        if not self.context.preloader.ready(setup.game, setup.arena):
            return None
        devices = [self.claims.get(seat) for seat in range(4)]
        real = [seat - 1 for seat in self.context.settings.real] if self.context.robots else []
        after = partial(after_match, self.running, fixture)
        return Swap(match_of(self.context, setup, devices, real, after=after))

    def _setup_of(self, fixture: Fixture) -> Setup | None:
        """The match of a fixture; None, with a line in the log, if a brain or an arena is missing."""
        if self._known is None or self._known[0] is not self.running.event:
            try:
                setup = setup_of(self.running.event, fixture)
                for brain in {seat.brain for seat in setup.seats} - {"human", "off"}:
                    find_brain(fixture.game, brain)
                self._known = self.running.event, setup
            except ValueError as reason:
                log.warning("%s", reason)
                self._known = self.running.event, None
        return self._known[1]

    def _play_quick(self) -> None:
        """Play the matches up to the next one with people in the background."""
        open_now = self.running.event.open
        try:
            self.quick = QuickMatches(self.running.event, list(takewhile(self.running.without_people, open_now)))
        except OSError as error:
            log.warning("%s", error)
            self._say("events.failed", "error")

    def _record_quick(self, quick: QuickMatches) -> None:
        """Record what has been played in the background; after the last one, those that are open now."""
        if outcome := quick.next_outcome():
            if not self._change(self.running.event.record(outcome)):
                self._stop_quick()
        elif quick.over:
            self._stop_quick()
            if quick.left:
                self._say("events.failed", "error")
            elif (fixture := self.fixture) and self.running.without_people(fixture):
                self._play_quick()

    def _stop_quick(self) -> None:
        """Stop the matches in the background; those without a result count as not played."""
        if self.quick:
            self.quick.end()
            self.quick = None

    # ---- drawing

    def _what(self, fixture: Fixture) -> str:
        """Game, length and arena in one line."""
        words, setup = self.context.words, self._setup_of(fixture)
        if setup is None:
            return words(f"games.{fixture.game}")
        arena = arena_title(load_cached(setup.game, setup.arena), words.language)
        length = match_length(words, games()[setup.game], setup.minutes, setup.goal)
        return "  ·  ".join((words(f"games.{setup.game}"), length, arena))

    def _card(self, screen: pygame.Surface, seat: int, name: str, count: int) -> None:
        words, brain = self.context.words, self.running.brain(name)
        x, y = view.card_rect(seat, count).topleft
        taken = seat in self.claims
        state = view.AI if brain else view.TAKEN if taken else view.WANTED
        view.frame(seat, name, *self._driver(seat, brain), state).draw(screen, x, y)
        view.draw_robot(screen, seat, x, self.clock, taken)
        if brain:
            fixture = self.fixture
            assert fixture is not None
            view.note_bar(brain_name(words, fixture.game, brain)).draw(screen, x, y)
        elif taken:
            ready_bar(seat, words("lobby.ready")).draw(screen, x, y)
        else:
            label = words.key_name(self.context.controls.label(self._suggested(seat), Button.FIRE))
            ask_bar(label, words("events.press"), pulse(self.clock, 5)).draw(screen, x, y)

    def _driver(self, seat: int, brain: str) -> tuple[str, str]:
        """Icon and name of who or what drives: a numbered pad, a phone, a part of the keyboard, an AI."""
        words, controls = self.context.words, self.context.controls
        if brain:
            return "ai", words("events.ai" if level_of(brain) else "events.robot")
        device, pads = self.claims.get(seat) or self._suggested(seat), controls.pads()
        if device and device.kind == "pad":
            return "pad", words("events.pad", number=1 + pads.index(device) if device in pads else 1)
        if device and device.kind == "phone":
            return "phone", words("devices.Phone")
        return "keys", "".join(controls.moves(device).split()) if device else ""

    def _draw_message(self, screen: pygame.Surface, fixture: Fixture) -> None:
        words = self.context.words
        if self.message_left > 0.0:
            caption(words(self.message), ALARM if self.message in ("app.unsaved", "events.failed") else FOCUS).draw(
                screen, 960, view.MESSAGE_Y
            )
        elif self.quick:
            call_to_action(words("events.playing"), "", LABEL, pulse(self.clock, 5)).draw(screen, 960, view.MESSAGE_Y)
        elif self.people and not self.waiting:
            call_to_action(words("lobby.starting"), "", LABEL).draw(screen, 960, view.MESSAGE_Y)
        elif self.waiting:
            seat = self.waiting[0]
            label = words.key_name(self.context.controls.label(self._suggested(seat), Button.FIRE))
            said = words("events.call", name=fixture.entrants[seat], button="{button}")
            call_to_action(said, label, LABEL, pulse(self.clock, 5)).draw(screen, 960, view.MESSAGE_Y)

    def _jobs(self) -> Iterator[Callable[[], object]]:
        """What the page draws, part by part."""
        yield backdrop
        fixture = self.fixture
        if fixture is None:
            return
        for seat, name in enumerate(fixture.entrants):
            brain = self.running.brain(name)
            yield partial(view.frame, seat, name, *self._driver(seat, brain), view.AI if brain else view.WANTED)


def after_match(running: RunningEvent, fixture: Fixture, scene: MatchScene) -> AfterMatch:
    """The next page after a match, whose result is on the disk by then. One that was ended by hand is still open."""
    if not scene.match.over:
        return NextMatch(scene.context, running, "events.unplayed")
    scene.names = fixture.entrants
    outcome = outcome_of(fixture, scene.match.outcome().rows)
    saved = running.change(running.event.record(outcome))
    return NextMatch(scene.context, running, "" if saved else "app.unsaved", show=not scene.humans)
