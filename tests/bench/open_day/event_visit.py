"""What the entrants of an event do: they set it up, take their seats, and play it to its podium."""

from pigaming_app.scenes.events.choice import NEW, EventsPage
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.setup.entrants_page import ADD_AI, LETTERS, EntrantsPage
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.ui.input.events import Button
from tests.bench.open_day.plan import EventWish
from tests.bench.open_day.stage import Stage
from tests.bench.open_day.visit import FAST, next_letter

PODIUM = 8.0  # s at the podium
ODDITIES = 0.04  # chance of each match to be skipped, and of an entrant to be absent


class EventVisit:
    """The reactions of a group that plays an event."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.decided: tuple[int, float] = 0, 0.0  # match, and the draw that decides its oddity
        self.late = ""  # initials that are being entered
        stage.reactions |= {
            EventsPage: self.events,
            SetupPage: self.setup,
            EntrantsPage: self.entrants,
            LettersPage: self.letters,
            NextMatch: self.next_match,
            TablePage: lambda: stage.one_presses(Button.BACK),
            EventPodiumPage: self.podium,
        }

    @property
    def wish(self) -> EventWish:
        group = self.stage.group
        assert group is not None
        assert group.event is not None
        return group.event

    @property
    def names(self) -> list[str]:
        """The entrants who are people, from the beginning."""
        group = self.stage.group
        assert group is not None
        return [visitor.initials for visitor in group.visitors]

    def events(self) -> None:
        """Open the own event, or begin a new one."""
        stage, page = self.stage, self.stage.top
        if stage.group is None or stage.group.event is None or stage.finished:
            stage.one_presses(Button.BACK)
            return
        own = [str(i) for i, listed in enumerate(page.saved) if self._is_own(listed.event)]
        if stage.focus(page.focus, own[0] if own else NEW):
            stage.one_presses(Button.FIRE)

    def _is_own(self, event: object) -> bool:
        entrants = getattr(event, "entrants", ())
        return {*self.names} <= {entrant.name for entrant in entrants}

    def setup(self) -> None:
        draft = self.stage.top.draft
        if draft.format is not self.wish.format:
            if self.stage.focus(self.stage.top.focus, "format"):
                self.stage.one_presses(Button.RIGHT)
        else:
            self.stage.one_presses(Button.START)

    def entrants(self) -> None:
        stage, page = self.stage, self.stage.top
        entered = page.draft.entrants
        if [name for name in self.names if name not in [one.name for one in entered]]:
            if stage.focus(page.focus, LETTERS):
                stage.one_presses(Button.FIRE)
        elif sum(bool(one.brain) for one in entered) < self.wish.ais:
            if stage.focus(page.focus, ADD_AI):
                stage.one_presses(Button.FIRE)
        else:
            stage.one_presses(Button.START)

    def letters(self) -> None:
        """Spell the next name; go back after the last one."""
        stage, page = self.stage, self.stage.top
        below = stage.app.stack.scenes[-2]
        wanted = [self.wish.late] if isinstance(below, NextMatch) else self.names
        missing = [name for name in wanted if name not in page.names()]
        picker = page.spelling.picker
        if stage.speaker and stage.ready(stage.speaker[0], FAST):
            stage.tap(stage.speaker[0].hands, next_letter(picker, missing[0]) if missing else Button.BACK)

    def next_match(self) -> None:
        stage, page = self.stage, self.stage.top
        group, fixture = stage.group, page.fixture
        assert group is not None
        self._note_event(str(page.running.path))
        if fixture is None or page.going or page.quick:
            return
        late = self.wish.late
        if late and late not in {one.name for one in page.running.event.entrants} and page.running.accepts_late:
            self.late = late
            stage.one_presses(Button.DOWN)
            return
        if self.late:
            stage.watch.count("late entrants")
            self.late = ""
        if self.decided[0] != fixture.number:
            self.decided = fixture.number, stage.rng.random()
        odd = self.decided[1]
        if not page.seats.people:
            stage.one_presses(Button.Y if odd < 0.5 else Button.FIRE)
        elif odd < ODDITIES and len(page.running.event.open) > 1:
            self.decided = fixture.number, 1.0
            self._odd(Button.X, "matches skipped")
        elif odd > 1.0 - ODDITIES and odd < 1.0 and page.seats.waiting:
            self.decided = fixture.number, 1.0
            self._odd(Button.Y, "entrants absent")
        elif page.seats.waiting:
            free = [player for player in stage.players if player.hands.device not in page.seats.claims.values()]
            stage.all_press(Button.FIRE, free[: len(page.seats.waiting)])

    def _odd(self, button: Button, name: str) -> None:
        for player in self.stage.speaker:
            self.stage.tap(player.hands, button)
            self.stage.watch.count(name)

    def _note_event(self, path: str) -> None:
        stage = self.stage
        assert stage.group is not None
        if stage.events.get(stage.group.number) != path:
            stage.events[stage.group.number] = path
            stage.watch.ledger.note("event", group=stage.group.number, path=path)

    def podium(self) -> None:
        stage = self.stage
        assert stage.group is not None
        self._note_event(str(stage.top.running.path))
        if stage.now - stage.changed > PODIUM:
            stage.done.add(stage.group.number)
            stage.one_presses(Button.BACK)
