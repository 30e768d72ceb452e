"""The people in front of the arcade: they look at the screen between two frames, and press what leads on."""

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pigaming_app.scenes.app import App
from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.kiosk.operator.figures_page import FiguresPage
from pigaming_app.scenes.kiosk.operator.page import QUIET as QUIET_ROWS
from pigaming_app.scenes.kiosk.operator.page import OperatorPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.pages.pin_page import PinPage
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.input.phones.guest import hash_of
from pigaming_app.ui.widgets.focus import Focus
from tests.bench.open_day.hands import Hands, KeyHands, PadHands, PhoneHands
from tests.bench.open_day.handsets import Handsets
from tests.bench.open_day.ledger import Ledger
from tests.bench.open_day.plan import PADS, PIN, PLACES, Day, Group, Task, Visitor
from tests.bench.open_day.school_class import SchoolClass
from tests.bench.open_day.watch import Watch

TEMPO = 0.35  # s between two presses of a person
PATIENCE = 1500.0  # s without a match after which a group gives up
FAREWELL = 1.5  # s on the title before a group that wants no more goes: memory is read then
ARROWS = (Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT)


@dataclass
class Player:
    """A visitor with what is in their hands."""

    visitor: Visitor
    hands: Hands
    due: float = 0.0  # s, of the next press


class Stage:
    """Call it between two frames; s since the opening are handed in. `reactions`: by class of the top scene;
    `folder`: for pictures of screens where a group is stuck."""

    def __init__(self, app: App, day: Day, seen: Ledger, watch: Watch, now: float, folder: Path) -> None:
        self.app, self.day, self.watch, self.folder = app, day, watch, folder
        self.rng = random.Random(day.seed * 1000 + watch.life)
        self.pads: list[Hands] = [PadHands() for _ in range(PADS)]
        self.handsets = Handsets()
        self.players: list[Player] = []
        self.group: Group | None = None
        self.school_class: SchoolClass | None = None  # the group, if it is one
        self.done = set(seen.done)
        self.played = dict(seen.played)  # matches by group, of the runs before
        self.events = dict(seen.events)
        self.tokens = dict(seen.tokens)  # of the phones, by visitor
        watch.seated |= seen.seated
        self.now = self.moved = self.changed = now  # s; the last two: progress of the group, change of the top scene
        self.top: Any = None
        self.looked = self.mishap_over = False
        self.counted = 0  # matches at the last progress
        self.focused: tuple[Focus, str] | None = None  # at the last press that was to move it
        self.held: list[tuple[float, Hands, Button]] = []  # buttons to release, and when
        self.released: list[Hands] = []  # in this frame: a press in the same one would be none
        self.keys = KeyHands()
        self.tasks = [task for task in day.tasks if task.at >= now]
        self.task: Task | None = None
        self.figures_seen = False
        self.reactions: dict[type, Callable[[], None]] = {}
        self.fallback: Callable[[], None] = lambda: None

    def play(self, now: float) -> None:
        """Let everybody look at the screen and act."""
        self.now = now
        top = self.app.stack.scenes[-1] if self.app.stack.scenes else None
        if top is not self.top:
            if isinstance(self.top, MatchScene):
                self._let_go()
            self.top, self.changed = top, now
            if isinstance(top, OptionsPage) and top.operator:
                self.watch.trouble("visitors have opened the options of the operator")
        due = [held for held in self.held if held[0] <= now]
        self.held = [held for held in self.held if held not in due]
        for _, hands, button in due:
            hands.release(button)
        self.released = [hands for _, hands, _ in due]
        if self.task or self._task_due():
            self._operate()
            return
        if self.group is None:
            self._next_group()
        if self.school_class:
            self.players = self.school_class.look(now, top)
        if self.group is not None:
            if self.matches > self.counted:
                self.counted, self.moved = self.matches, now
            if now - self.moved > PATIENCE:
                self._give_up()
            elif isinstance(top, Title) and self.finished:
                if now - self.changed >= FAREWELL:
                    self.leave()
            else:
                self.reactions.get(type(top), self.fallback)()
        elif not isinstance(top, Title | Attract):
            self.someone(self.pads[0], Button.BACK)

    def close(self) -> None:
        """Unplug all pads and end all phones."""
        for hands in self.pads:
            hands.unplug()
        self.handsets.close()

    # ---- the group

    @property
    def matches(self) -> int:
        """Matches that the group has played."""
        number = self.group.number if self.group else -1
        return self.played.get(number, 0) + self.watch.played[number]

    @property
    def finished(self) -> bool:
        """True if the group wants no more."""
        group = self.group
        assert group is not None
        if group.event:
            return group.number in self.done
        if self.school_class:
            return self.school_class.finished
        return self.matches >= group.matches

    def visitors(self, match: MatchScene) -> list[int]:
        """The numbers of those of the group who play a match, by pad or by phone."""
        if self.school_class:
            return self.school_class.visitors(match)
        return [visitor.number for visitor in self.group.visitors[:PLACES]] if self.group else []

    @property
    def waiting(self) -> list[Group]:
        """The groups that have come and not left."""
        return [group for group in self.day.groups if group.number not in self.done and group.at <= self.now]

    @property
    def busy(self) -> bool:
        """True while somebody is there."""
        return self.group is not None or self.task is not None or bool(self.waiting)

    def _next_group(self) -> None:
        waiting = self.waiting
        shared = bool(waiting and waiting[0].event and waiting[0].event.shared)  # the arcade opens it by itself
        if not waiting or not isinstance(self.top, NextMatch if shared else Title | Attract):
            return
        self.group = group = waiting[0]
        self.moved, self.counted = self.now, self.matches
        self.looked, self.mishap_over = not group.look or self.matches > 0, self.matches > 0
        if group.is_class:
            hall = [Player(visitor, self._phone(visitor)) for visitor in group.visitors]
            self.school_class = SchoolClass(self, hall)
            return
        pads = list(self.pads)
        for visitor in group.visitors[:PLACES]:
            plays_by_phone = visitor.phone or not pads
            self.players.append(Player(visitor, self._phone(visitor) if plays_by_phone else pads.pop(0)))

    def _phone(self, visitor: Visitor) -> PhoneHands:
        """The visitor's phone, which returns with the token that it had."""
        host, token = self.app.context.shared(phone_host), self.tokens.get(visitor.number, "")
        self.watch.count("phones that return" if token else "phones")
        return PhoneHands(
            self.handsets.new(host.url, token, visitor.number), self.app.context.controls.phones, self._number
        )

    def _number(self, token: str) -> int | None:
        """The arcade's number of the phone with a token."""
        hashed = hash_of(token)
        guests = self.app.context.shared(phone_host).roster.guests()
        return next((guest.number for guest in guests if guest.token == hashed), None)

    def note_tokens(self, players: Sequence[Player]) -> None:
        """Keep the tokens of the phones for the next run."""
        for player in players:
            token = player.hands.handset.token if isinstance(player.hands, PhoneHands) else ""
            if token and token != self.tokens.get(player.visitor.number):
                self.tokens[player.visitor.number] = token
                self.watch.ledger.note("phone", visitor=player.visitor.number, token=token)

    def leave(self) -> None:
        """The group goes home; its phones are locked."""
        assert self.group is not None
        self.done.add(self.group.number)
        self.watch.ledger.note("done", group=self.group.number)
        self._let_go()
        for player in self.school_class.hall if self.school_class else self.players:
            if isinstance(player.hands, PhoneHands):
                player.hands.unplug()
        self.players, self.group, self.school_class = [], None, None
        self.watch.memory(self.now)

    def _let_go(self) -> None:
        """Release sticks and buttons after a match."""
        for player in self.school_class.hall if self.school_class else self.players:
            player.hands.steer(0.0, 0.0, False, False)

    def _give_up(self) -> None:
        """The group goes home without having played what it wanted; a picture shows where."""
        assert self.group is not None
        devices = [player.hands.device for player in self.players]
        what = f"group {self.group.number} is stuck at {type(self.top).__name__} with {devices}"
        self.watch.trouble(f"{self.day.times.wall(self.now):%H:%M}: {what}")
        self.app.context.canvas.screenshot(self.folder / f"stuck-{self.group.number}.png")
        self.leave()

    # ---- presses

    def someone(self, hands: Hands, button: Button) -> None:
        """Tap a button, at the tempo of a person."""
        if self.now - self.changed >= TEMPO and self._free(hands):
            self.tap(hands, button)

    def tap(self, hands: Hands, button: Button, seconds: float = 0.1) -> None:
        """Press a button now, and release it later."""
        hands.press(button)
        self.held.append((self.now + seconds, hands, button))

    def ready(self, player: Player, tempo: float = TEMPO) -> bool:
        """True if a player acts now; the next time will be later."""
        if self.now < player.due or self.now - self.changed < TEMPO or not self._free(player.hands):
            return False
        player.due = self.now + tempo * self.rng.uniform(0.8, 1.6)
        return True

    def _free(self, hands: Hands) -> bool:
        """True if nothing is held, nor was until this frame."""
        return hands not in [*(held[1] for held in self.held), *self.released]

    def all_press(self, button: Button, players: Sequence[Player] | None = None) -> None:
        """Each of these players taps a button, at their tempo."""
        for player in self.players if players is None else players:
            if self.ready(player):
                self.tap(player.hands, button)

    def one_presses(self, button: Button) -> None:
        """The first player who has a device taps a button."""
        self.all_press(button, self.speaker)

    @property
    def speaker(self) -> list[Player]:
        """The first player who has a device, if there is one."""
        return [player for player in self.players if player.hands.device][:1]

    def focus(self, focus: Focus, name: str, player: Player | None = None) -> bool:
        """Move the focus one step towards a spot; true if it is there."""
        if focus.name == name:
            return True
        (x, y), (to_x, to_y) = focus.rect(focus.name).center, focus.rect(name).center
        across = Button.RIGHT if to_x > x else Button.LEFT
        along = Button.DOWN if to_y > y else Button.UP
        button = across if abs(to_y - y) < 20 else along
        for one in [player] if player else self.speaker:
            if self.ready(one):
                if self.focused == (focus, focus.name):  # the last press has not moved it: no way there
                    button = self.rng.choice(ARROWS)
                self.focused = focus, focus.name
                self.tap(one.hands, button)
        return False

    # ---- the operator

    def _task_due(self) -> bool:
        """Take the next task if the screen permits it: at the title, or, to end matches, in a match."""
        due = [task for task in self.tasks if task.at <= self.now]
        if not due:
            return False
        fits = (
            isinstance(self.top, MatchScene) and not self.top.match.over
            if due[0].end_all
            else len(self.app.stack.scenes) == 1
        )
        if not fits or self.held or (self.group and self.group.event and due[0].end_all):
            return False
        self.task, self.figures_seen = due[0], False
        self.tasks.remove(self.task)
        self._let_go()
        self.keys.hold_f10(True)
        return True

    def _operate(self) -> None:
        """One step of the task."""
        task, top = self.task, self.top
        assert task is not None
        operator = Player(Visitor(-1, "", False), self.keys)
        if isinstance(top, FiguresPage):
            self.figures_seen = True
            if self.now - self.changed > 2.0:
                self.someone(self.keys, Button.BACK)
            elif 1.0 < self.now - self.changed < 1.2:
                self.someone(self.keys, Button.FIRE)
        elif isinstance(top, PinPage):
            self.keys.hold_f10(False)
            if len(top.digits) == len(PIN):
                self.all_press(Button.START, [operator])
            elif self.ready(operator):
                self.keys.type(PIN[len(top.digits)])
        elif isinstance(top, OperatorPage):
            self.keys.hold_f10(False)
            if self.now - self.changed > 240.0:
                self.watch.trouble(f"the operator is stuck at {top.focus.name}")
                self.task = None
            elif wrong := [
                row for row, value in task.settings.items() if getattr(self.app.context.settings, row) != value
            ]:
                row = wrong[0] if wrong[0] in top.rows else "quiet" if wrong[0] in QUIET_ROWS else ""
                if not row:
                    self.someone(self.keys, Button.BACK)
                elif not self.focus(top.focus, row, operator):
                    pass
                elif row == "quiet":
                    self.all_press(Button.FIRE, [operator])
                else:
                    self._change(wrong[0], task.settings[wrong[0]], operator)
            elif top.rows == QUIET_ROWS:
                self.someone(self.keys, Button.BACK)
            elif task.figures and not self.figures_seen:
                if self.focus(top.focus, "figures", operator):
                    self.all_press(Button.FIRE, [operator])
            elif task.end_all:
                if self.focus(top.focus, "end_all", operator) and self.ready(operator):
                    self.tap(self.keys, Button.FIRE, 1.3)
            elif self.ready(operator):
                self.tap(self.keys, Button.BACK)
                self._finish_task()
        elif self.now - self.changed > 1.0 and task.end_all and isinstance(top, Title):
            self._finish_task()

    def _change(self, row: str, value: str | int, operator: Player) -> None:
        now = getattr(self.app.context.settings, row)
        self.all_press(Button.RIGHT if now < value else Button.LEFT, [operator])

    def _finish_task(self) -> None:
        self.watch.count("tasks of the operator")
        self.task = None

    @property
    def lobby(self) -> Lobby | None:
        """The lobby on the stack."""
        return next((scene for scene in reversed(self.app.stack.scenes) if isinstance(scene, Lobby)), None)
