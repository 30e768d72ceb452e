"""The next match of an event: who plays what, in which seat and on which pad, and who is next after that.

Each person presses FIRE to take the seat of their name: the first pad that of the first person, and so on. Whoever is
absent is skipped with one press, or an AI drives in their place with another. A match of AIs is a show, or is played at
once in the background.
"""

import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import takewhile

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import outcome_of
from pigaming_app.events.spec import DEFAULT_AI, Entrant, Fixture
from pigaming_app.scenes.events import next_view as view
from pigaming_app.scenes.events.drivers import stood_in
from pigaming_app.scenes.events.names import shortened
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.quick_match import QuickMatches
from pigaming_app.scenes.events.running import RunningEvent, lots_line, progress_line
from pigaming_app.scenes.events.seats import EventSeats
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.play.scene import MatchScene, match_of
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.draw import ALARM, FOCUS, LABEL
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.labels import call_to_action, heading, pulse

INPUT_LOCKOUT = 0.6  # s during which input is ignored: players may still hammer
ALL_READY = 2.5  # s from the last seat taken to the match
MESSAGE_SECONDS = 4.0
NAME_ROOM = 640  # px, of a name in a sentence
LOOK = 1.0  # s between two looks at the file
SHOW_AFTER = 8.0  # s until the next match of AIs begins, after one that was watched

log = logging.getLogger("pigaming")


class NextMatch:
    """The page of the first open match. `notice`: a message; `show`: matches of AIs begin by themselves; `again`: those
    who have just played keep their devices.
    """

    def __init__(
        self, context: Context, running: RunningEvent, notice: str = "", show: bool = False, again: bool = False
    ) -> None:
        self.context, self.running, self.show = context, running, show
        self.seats = EventSeats(context, running)
        self._seated = self.fixture
        if again:
            self.seats.keep()
        self.quick: QuickMatches | None = None  # matches of AIs in the background
        self.access = Access(context, lambda: [self.seats.claims.get(seat) for seat in range(ROBOTS)])  # of phones
        self.clock, self.ready, self.looked = 0.0, 0.0, 0.0
        self.going = False  # a match is wanted, but not loaded yet
        self.message, self.message_left = notice, MESSAGE_SECONDS if notice else 0.0
        self.queue = PrewarmQueue(self._jobs())

    # ---- lifecycle

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        self.context.sounds.music("title")
        self._look()
        self.ready = 0.0

    def on_leave(self) -> None:
        """Stop the matches in the background."""
        self._stop_quick()

    @property
    def called(self) -> dict[int, tuple[str, bool]]:
        """The people who are called, by seat; nobody while AIs play."""
        return {} if self.quick else self.seats.called

    @property
    def fixture(self) -> Fixture | None:
        """The match; None when all have been played, or are played elsewhere."""
        return self.seats.fixture

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE takes a seat, START begins, X skips the match, Y lets an AI drive, UP shows the table, BACK leaves."""
        event = self.prompts.as_button(event)
        if event.button is Button.LOST:
            self.seats.release(event.device)
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
            case Button.BACK | Button.LEAVE_SEAT if device in self.seats.claims.values():
                self.seats.release(device)
                self.context.sounds.play("back")
            case Button.BACK:
                self.context.sounds.play("back")
                self.running.release()
                return Pop()
            case Button.UP:
                self.context.sounds.play("accept")
                return Push(TablePage(self.context, self.running))
            case _ if self.fixture is None:
                return None
            case Button.DOWN if self.running.accepts_late:
                self.context.sounds.play("accept")
                return Push(LettersPage(self.context, self._add, self._names))
            case Button.LEFT | Button.RIGHT:
                if self.seats.move(device, 1 if event.button is Button.RIGHT else -1):
                    self.ready = 0.0
                    self.context.sounds.play("move")
            case Button.X:
                self._postpone()
            case Button.Y:
                self._replace_absent()
            case Button.FIRE if self.seats.people or self.seats.stood_in:
                self._take(device)
            case Button.FIRE | Button.START:
                return self._start()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Begin when everybody is there; record a match played in the background."""
        self.clock += seconds
        self.message_left -= seconds
        self.queue.work(2.0)
        self.looked += seconds
        if self.looked > LOOK and not self.going:
            self._look()
        if self.fixture is None:
            waits = self.running.event.open or self.running.event.pause is not None  # for other arcades, or its end
            return self._after_last() if not waits and self.message_left <= 0.0 else None
        if self.going:
            return self._begin()
        if self.quick:
            self._record_quick(self.quick)
        else:
            self.ready = self.ready + seconds if self.seats.people and not self.seats.waiting else 0.0
            shown = self.show and not self.seats.people and self.clock > SHOW_AFTER
            if (shown or self.ready > ALL_READY) and self.running.event.pause is None:
                return self._start()
        return None

    def _after_last(self) -> StackOperation:
        """The podium; in a format on call, those who choose the next match, or the next ones of AIs alone."""
        event = self.running.event
        if event.over:
            return Swap(EventPodiumPage(self.context, self.running))
        if any(not entrant.brain for entrant in event.entrants):
            return Pop()
        self._change(lambda event: event if event.open or event.over else event.continued())
        return None

    def draw(self, screen: pygame.Surface) -> None:
        fixture, words = self.fixture, self.context.words
        screen.blit(backdrop(), (0, 0))
        if fixture is None:
            self._draw_message(screen)
            if self.running.event.open:
                heading(words("events.next"), "").draw(screen)
                self.prompts.draw(screen)
            return
        title = words("events.sudden_death" if fixture.extra else "events.next")
        heading(title, view.match_line(words, fixture, self.running.setup(fixture))).draw(screen)
        self.seats.draw(screen, self.clock)
        self._draw_message(screen)
        view.draw_following(screen, words, self.running)
        self.prompts.draw(screen)

    @property
    def prompts(self) -> ButtonPrompts:
        """The prompts of this match."""
        if self.quick:
            return self.context.prompts([(Button.BACK, "events.hint_stop")], view.PROMPTS_Y)
        if self.fixture is None:
            hints = [(Button.UP, "events.hint_table"), (Button.BACK, "events.hint_back")]
            return self.context.prompts(hints, view.PROMPTS_Y)
        if self.seats.people:
            own = [(Button.START, "events.hint_begin"), (Button.X, "events.hint_skip"), (Button.Y, "events.hint_ai")]
        else:
            watch = Button.START if self.seats.stood_in else Button.FIRE
            own = [(watch, "events.hint_watch"), (Button.Y, "events.hint_quick"), (Button.X, "events.hint_skip")]
        late = [(Button.DOWN, "events.hint_late")] if self.running.accepts_late else []
        hints = [*own, (Button.UP, "events.hint_table"), *late, (Button.BACK, "events.hint_back")]
        return self.context.prompts(hints, view.PROMPTS_Y)

    # ---- seats

    def _take(self, device: Device) -> None:
        """Take a seat; a person for whom an AI drives comes back."""
        free = device.kind != "mouse" and device not in self.seats.claims.values()
        if free and not self.seats.take(device):
            self._bring_back(device)

    def _bring_back(self, device: Device) -> None:
        """A person for whom an AI drives is there again."""
        fixture = self.fixture
        assert fixture is not None
        for seat in self.seats.returning(device):
            if self._change(partial(Event.substitute, name=fixture.entrants[seat], brain="")):
                self.seats.claims[seat] = device
                self.context.sounds.play("join", seat)

    # ---- changes of the event

    def _names(self) -> list[str]:
        return [entrant.name for entrant in self.running.event.entrants]

    def _add(self, name: str) -> str:
        """Enter a late person; returns the sentence why not, or an empty one."""
        words = self.context.words
        if name in self._names():
            return words("events.taken", name=name)
        self.seats.claims.clear()
        try:
            saved = self.running.change(lambda event: event.add(Entrant(name)))
        except ValueError as reason:
            log.warning("%s", reason)
            return words("events.too_late")
        return "" if saved else words("app.unsaved")

    def _postpone(self) -> None:
        fixture = self.fixture
        assert fixture is not None
        if len(self.running.queue) == 1:
            self._say("events.only_one")
            return
        if self._change(lambda event: event.postpone(fixture.number)):
            self._say("events.skipped", "move")
            self._look()

    def _replace_absent(self) -> None:
        """An AI drives for everybody who is absent; without people, play the matches of AIs in the background."""
        fixture = self.fixture
        assert fixture is not None
        if not self.seats.people:
            self._play_quick()
            return
        absent = [fixture.entrants[seat] for seat in self.seats.waiting]

        def replaced(event: Event) -> Event:
            for name in absent:
                event = event.substitute(name, DEFAULT_AI)
            return event

        if absent and self._change(replaced):
            self._say("events.stand_in", "join")

    def _change(self, change: Callable[[Event], Event]) -> bool:
        """Change and save the event; false, with a message, if that is impossible."""
        trouble = ""
        try:
            trouble = "" if self.running.change(change) else "app.unsaved"
        except ValueError as reason:  # another process was faster
            log.warning("%s", reason)
            trouble = "events.elsewhere"
        self._reset_if_changed()
        if trouble:
            self._say(trouble, "error")
        return not trouble

    def _look(self) -> None:
        """Follow what others have changed, and claim the match for this arcade."""
        self.looked = 0.0
        self.running.refresh()
        self.running.claim()
        self._reset_if_changed()

    def _reset_if_changed(self) -> None:
        """Free all seats if another match is the next one."""
        if self.fixture != self._seated:
            self._seated = self.fixture
            self.seats.claims.clear()
            self.ready = 0.0

    def _say(self, key: str, sound: str = "refused") -> None:
        self.message, self.message_left = self.context.words(key), MESSAGE_SECONDS
        self.context.sounds.play(sound)

    # ---- matches

    def _start(self) -> StackOperation:
        if self.running.event.pause is not None:
            self.context.sounds.play("refused")
            return None
        if self.seats.waiting:
            self._say("events.missing")
            return None
        before = self.fixture
        self.running.refresh()
        self._reset_if_changed()
        if self.fixture != before:
            self._say("events.elsewhere", "error")
            return None
        self.context.sounds.play("accept")
        self.going = True
        return self._begin()

    def _begin(self) -> StackOperation:
        """Swap to the match, or return None while it is being loaded."""
        fixture = self.fixture
        assert fixture is not None
        setup = self.running.setup(fixture)
        if setup is None:
            self.going = self.show = False
            self._say("events.failed", "error")
            return None
        if not self.context.preloader.ready(setup.game, setup.arena):
            return None
        devices = [self.seats.claims.get(seat) for seat in range(4)]
        real = [seat - 1 for seat in self.context.settings.real] if self.context.robots else []
        after = EventMatch(self.running, fixture)
        return Swap(match_of(self.context, setup, devices, real, after=after))

    def _play_quick(self) -> None:
        """Play the matches up to the next one with people in the background."""
        if self.running.event.pause is not None:
            self.context.sounds.play("refused")
            return
        queue = takewhile(self.running.without_people, self.running.queue)
        try:
            self.quick = QuickMatches(self.running.event, list(queue))
        except OSError as error:
            log.warning("%s", error)
            self._say("events.failed", "error")

    def _record_quick(self, quick: QuickMatches) -> None:
        """Record what has been played in the background; after the last one, those that are open now."""
        if outcome := quick.next_outcome():
            if not self._change(lambda event: event.record(outcome)):
                self._stop_quick()
            elif notice := lots_line(self.context.words, self.running.event, outcome):
                self.message, self.message_left = notice, MESSAGE_SECONDS
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

    def _draw_message(self, screen: pygame.Surface) -> None:
        words, fixture = self.context.words, self.fixture
        if self.message_left > 0.0:
            grave = self.message in (words("app.unsaved"), words("events.failed"))
            caption(self.message, ALARM if grave else FOCUS).draw(screen, 960, view.MESSAGE_Y)
        elif (note := self.running.event.pause) is not None:
            line = f"{words('desk.pause')}  {note}".strip()
            caption(shortened(line, 1600), FOCUS).draw(screen, 960, view.MESSAGE_Y)
        elif fixture is None:
            if self.running.event.open:
                key = "events.alone" if self.running.alone else "desk.elsewhere"
                caption(words(key), FOCUS).draw(screen, 960, 540)
        elif self.quick:
            call_to_action(words("events.playing"), "", LABEL, pulse(self.clock, 5)).draw(screen, 960, view.MESSAGE_Y)
        elif (self.seats.people and not self.seats.waiting) or (self.show and not self.seats.people):
            call_to_action(words("lobby.starting"), "", LABEL).draw(screen, 960, view.MESSAGE_Y)
        elif self.seats.stood_in and not self.seats.people:
            caption(words("events.stand_in"), FOCUS).draw(screen, 960, view.MESSAGE_Y)
        elif self.seats.waiting:
            seat = self.seats.waiting[0]
            name = shortened(fixture.entrants[seat], NAME_ROOM)
            call = words("events.call", name=name, button="{button}")
            call_to_action(call, self.seats.label(seat), LABEL, pulse(self.clock, 5)).draw(screen, 960, view.MESSAGE_Y)

    def _jobs(self) -> Iterator[Callable[[], object]]:
        """What the page draws, part by part."""
        yield backdrop
        yield from self.seats.jobs()


@dataclass(frozen=True)
class EventMatch:
    """A match of an event. Called after it, it returns the next page; the result is on the disk by then."""

    running: RunningEvent
    fixture: Fixture

    @property
    def names(self) -> tuple[str, ...]:
        """Who plays, in the order of the seats."""
        return self.fixture.entrants

    def round_line(self, words: Words) -> str:
        """Its round, and its number in the event; the week, or the number of tries."""
        if self.running.event.progress.kind.on_call:
            return progress_line(words, self.running.event)
        fixtures = self.running.event.fixtures
        at = next((i for i, one in enumerate(fixtures, 1) if one.number == self.fixture.number), len(fixtures))
        return words("events.progress", round=self.fixture.round, match=at, of=len(fixtures))

    def __call__(self, scene: MatchScene) -> AfterMatch:
        """A match that was ended by hand is still open. A tie in a knock-out leads to an extra match."""
        words, running = scene.context.words, self.running
        if not scene.match.over:
            return NextMatch(scene.context, running, words("events.unplayed"))
        scene.sequel.stood_in = stood_in(running, self.fixture)
        outcome = outcome_of(running.event.spec, self.fixture, scene.match.outcome().rows)
        try:
            notice = "" if running.change(lambda event: event.record(outcome)) else words("app.unsaved")
        except ValueError as reason:  # another process has played this match
            log.warning("%s", reason)
            return NextMatch(scene.context, running, words("events.elsewhere"), show=not scene.drivers.people)
        follows = next((one for one in running.event.open if one.number == self.fixture.number), None)
        again = follows is not None and follows.extra == self.fixture.extra + 1
        notice = notice or lots_line(words, running.event, outcome) or (words("events.tied") if again else "")
        return NextMatch(scene.context, running, notice, not scene.drivers.people, again)
