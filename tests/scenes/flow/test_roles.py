"""Roles: every screen with each role and device, stories of visitors and operators in a kiosk, and random mashing."""

import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pygame
import pytest

from pigaming_app.events import event_files
from pigaming_app.events.spec import Format
from pigaming_app.scenes.app import App
from pigaming_app.scenes.events.choice import EventsPage
from pigaming_app.scenes.events.manage.corrections import Correction
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.access import BREAK, LOWEST, SESSION, Right, Role, Roles
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.guard import Guard
from pigaming_app.scenes.kiosk.operator.page import OperatorPage
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.pages.pin_page import NewPinPage, PinPage
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.title.kiosk_unlock import HOLD as UNLOCK
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.screens import SCREENS, event

PHONE, MOUSE, PAD = Device("phone", 3), Device("mouse"), Device("pad", 1)
PIN = "274918"
# Screens that only operators may use, by the beginning of their names, as the issue of a school lists them.
OPERATORS = {
    "operator": Right.SETTINGS,
    "operator day": Right.OPERATE,
    "operator quiet": Right.OPERATE,
    "operator figures": Right.OPERATE,
    "trash": Right.RESTORE,
    "empty trash": Right.RESTORE,
    "new PIN": Right.OPERATE,
    "easy PIN": Right.OPERATE,
    "two PINs": Right.OPERATE,
    "event managed": Right.EVENTS,
    "event ladder managed": Right.EVENTS,
    "event day managed": Right.EVENTS,
    "event withdrawal": Right.EVENTS,
    "event deletion": Right.EVENTS,
    "event in browser": Right.EVENTS,
    "event desk": Right.EVENTS,
    "correction": Right.EVENTS,
    "widest correction": Right.EVENTS,
    "robots menu": Right.ROBOTS,
    "board set-up": Right.ROBOTS,
    "guide of the mat": Right.ROBOTS,
    "marker sheet": Right.ROBOTS,
    "options of phones": Right.SETTINGS,
    "all phones": Right.SETTINGS,
    "programs": Right.SETTINGS,
    "added games": Right.SETTINGS,
    "play test": Right.SETTINGS,
    "new game": Right.SETTINGS,
}
BELOW = {"operator figures": "operator day"}  # screens that need the right of the one below


def expected(name: str, kiosk: bool) -> Right:
    """The right that a screen needs; the options are the house's outside a kiosk."""
    if name.startswith("options") and "phones" not in name:
        return Right.PLAY if kiosk else Right.SETTINGS
    rights = [right for start, right in OPERATORS.items() if name.startswith(start)]
    return rights[-1] if rights else Right.PLAY


class Situation:
    """A kiosk or none, with a PIN or none, which was entered on a device or not."""

    def __init__(self, kiosk: bool, pin: bool, entered: Device | None) -> None:
        self.kiosk, self.pin, self.entered = kiosk, pin, entered

    def may(self, device: Device, right: Right) -> bool:
        """By the sentences of docs/open-day.md."""
        if right is Right.PLAY:
            return True
        if device.kind == "phone":
            return False
        if not self.kiosk:
            return True
        if not self.pin:
            return right is not Right.OWN
        hand = "keys" if device.kind == "mouse" else device.kind
        return right is not Right.OWN and self.entered is not None and self.entered.kind == hand


SITUATIONS = {
    "no kiosk": Situation(False, False, None),
    "no kiosk with a PIN": Situation(False, True, None),
    "kiosk": Situation(True, False, None),
    "kiosk with a PIN": Situation(True, True, None),
    "kiosk with an operator at a pad": Situation(True, True, PAD),
    "kiosk with an operator at the keyboard": Situation(True, True, KEYS[0]),
}


@pytest.mark.parametrize("kiosk", [False, True])
@pytest.mark.parametrize("name", SCREENS)
def test_every_screen_with_each_role_and_device(arcade: Arcade, name: str, kiosk: bool) -> None:
    context, file = arcade.context, PinFile(folders().config)
    scene = SCREENS[name](arcade)
    context.kiosk = kiosk
    if name.startswith("options") and "phones" not in name:
        scene = OptionsPage(context)
    below: list[Scene] = [SCREENS[BELOW[name]](arcade)] if name in BELOW else []
    right, roles = expected(name, kiosk), context.shared(Roles)
    handled: list[InputEvent] = []
    scene.handle = handled.append  # type: ignore[method-assign, assignment]
    for situation, now in SITUATIONS.items():
        if now.kiosk != kiosk:
            continue
        (file.set if now.pin else lambda _: file.remove())(PIN)
        roles.end()
        if now.entered:
            roles.begin(now.entered)
        for device in (KEYS[0], KEYS[3], MOUSE, PAD, PHONE):
            for button in (Button.FIRE, Button.START, Button.X, Button.UP, Button.CLICK):
                press = InputEvent(button, device, at=(9.0, 9.0))
                Guard(context).handle([*below, scene], press)
                got = handled.pop() if handled else None
                assert (got is press) == now.may(device, right), (name, situation, device, button)
        assert roles.role_of(PHONE) is Role.VISITOR


def test_all_rights_are_needed_somewhere_or_named() -> None:
    assert set(LOWEST) == set(Right)
    assert set(OPERATORS.values()) | {Right.PLAY, Right.CLOSE, Right.OWN} == set(Right)


def test_the_table_of_the_docs_is_that_of_the_code() -> None:
    page = (Path(__file__).parents[3] / "docs" / "open-day.md").read_text()
    rows = [line.split("|")[1:-1] for line in page.splitlines() if line.startswith("| `")]
    found = {cells[0].strip(" `"): [cell.strip() for cell in cells[2:]] for cells in rows if len(cells) == 5}
    wanted = {right.value: ["yes" if role >= LOWEST[right] else "" for role in Role] for right in Right}
    assert found == wanted


# ---- stories


@pytest.fixture
def kiosk(arcade: Arcade) -> Arcade:
    """A kiosk with a PIN."""
    arcade.context.kiosk = True
    PinFile(folders().config).set(PIN)
    return arcade


def enter(arcade: Arcade, pin: str, device: Device = KEYS[0]) -> None:
    """Type a PIN on the page that asks for it."""
    page = arcade.shown(PinPage)
    for digit in pin:
        page.type(digit)
    arcade.press(Button.START, device=device)


def managed(arcade: Arcade) -> Path:
    """The list of events of a kiosk with one event; its file."""
    running = event(Format.SWISS, 8, 2, 4)
    path = folders().data / "events" / "cup.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    event_files.save(path, running.event)
    arcade.open(EventsPage(arcade.context))
    return path


def test_no_phone_manages_an_event_locked_or_not(kiosk: Arcade) -> None:
    path = managed(kiosk)
    for pin in (PIN, None):
        if pin is None:
            PinFile(folders().config).remove()
        kiosk.press(Button.DOWN, Button.Y, device=PHONE)
        assert isinstance(kiosk.stack.top, EventsPage)
        assert kiosk.context.notices.waiting
    kiosk.press(Button.Y)
    assert isinstance(kiosk.stack.top, EventPage)
    kiosk.press(*[Button.DOWN] * 4, Button.FIRE, Button.BACK, device=PHONE)
    kiosk.wait(7)
    assert path.exists()
    assert isinstance(kiosk.stack.top, EventPage)


def test_a_pin_opens_the_management_of_an_event_and_phones_stay_out(kiosk: Arcade) -> None:
    managed(kiosk)
    kiosk.press(Button.DOWN, Button.Y)
    enter(kiosk, "1111")
    enter(kiosk, PIN)
    page = kiosk.shown(EventPage)
    before = page.focus.name
    kiosk.press(Button.DOWN, Button.BACK, device=PHONE)
    kiosk.press(Button.DOWN, Button.BACK, device=PAD)
    assert kiosk.stack.top is page
    assert page.focus.name == before
    kiosk.press(Button.DOWN)
    assert page.focus.name != before


def test_a_correction_needs_the_pin(kiosk: Arcade) -> None:
    kiosk.open(TablePage(kiosk.context, event(Format.SWISS, 8, 2, 4)))
    kiosk.press(Button.X)
    kiosk.press(Button.FIRE, device=PHONE)
    assert not isinstance(kiosk.stack.top, Correction | PinPage)
    kiosk.press(Button.FIRE)
    enter(kiosk, PIN)
    assert isinstance(kiosk.stack.top, Correction)


def test_the_session_ends_by_itself(kiosk: Arcade) -> None:
    roles = kiosk.context.shared(Roles)
    roles.begin(KEYS[0])
    page = kiosk.open(OperatorPage(kiosk.context))
    for _ in range(3):
        roles.update(SESSION - 1, kiosk.stack.scenes)
        kiosk.press(Button.DOWN)
    assert roles.may(MOUSE, Right.OPERATE)
    assert not roles.may(PAD, Right.OPERATE)
    kiosk.stack.scenes.remove(page)
    roles.update(BREAK + 1, kiosk.stack.scenes)
    assert not roles.may(KEYS[0], Right.OPERATE)
    kiosk.open(page)
    kiosk.press(Button.DOWN)
    assert isinstance(kiosk.stack.top, PinPage)
    kiosk.press(Button.BACK)
    kiosk.press(Button.BACK, device=PHONE)
    assert page in kiosk.stack.scenes
    roles.update(BREAK + 1, kiosk.stack.scenes)
    kiosk.press(Button.BACK, device=PHONE)
    assert page not in kiosk.stack.scenes, "whoever finds it open may leave it"


@pytest.mark.parametrize("seed", range(6))
def test_mashing_neither_enters_nor_sets_a_pin(kiosk: Arcade, seed: int) -> None:
    rng = random.Random(seed)
    file = PinFile(folders().config)
    before = file.path.read_text()
    for make in (lambda: PinPage(kiosk.context), lambda: NewPinPage(kiosk.context, first=True)):
        for _ in range(8):
            page = make()
            kiosk.open(page)
            for _ in range(150):
                kiosk.press(rng.choice([*Button]), device=rng.choice([*KEYS, PAD, PHONE]))
                if kiosk.stack.top is not page:
                    break
            kiosk.stack.scenes[2:] = []
    kiosk.context.controls.typist = None
    assert not kiosk.context.shared(Roles).in_session
    assert before.split('"failures"')[0] == file.path.read_text().split('"failures"')[0]


def test_one_device_types_at_a_time(kiosk: Arcade) -> None:
    page = kiosk.open(PinPage(kiosk.context))
    kiosk.press(Button.FIRE, device=PAD)
    kiosk.press(Button.FIRE, Button.START, device=KEYS[0])
    assert page.digits == "5"


def test_a_pin_is_set_by_typing_it_twice(arcade: Arcade) -> None:
    page = arcade.open(NewPinPage(arcade.context))
    for typed in ("12", PIN, "274919", PIN, PIN):
        assert not PinFile(folders().config).is_set
        for digit in typed:
            page.type(digit)
        arcade.press(Button.START)
    assert PinFile(folders().config).check(PIN)
    assert page not in arcade.stack.scenes


# ---- the whole arcade


@pytest.fixture
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], App]]:
    """Opens a kiosk."""
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    stack: list[App] = []
    with opened(Options(headless=True, step=0.1, kiosk=True)) as one:
        stack.append(one)
        yield lambda: stack[0]


def frames(app: App, count: int) -> None:
    for _ in range(count):
        app.compose(0.1)


def test_the_first_title_of_a_kiosk_offers_a_pin_once(app: Callable[[], App]) -> None:
    arcade = app()
    frames(arcade, 2)
    assert isinstance(arcade.stack.top, NewPinPage)
    frames(arcade, 620)
    assert isinstance(arcade.stack.top, Title)
    frames(arcade, 20)
    assert isinstance(arcade.stack.top, Title)
    assert "pin_asked = true" in (folders().config / "settings.toml").read_text()


def test_the_hidden_combination_and_f10_lead_to_the_pin(
    app: Callable[[], App], monkeypatch: pytest.MonkeyPatch
) -> None:
    arcade = app()
    PinFile(folders().config).set(PIN)
    arcade.context.settings.pin_asked = True
    frames(arcade, 2)
    monkeypatch.setattr(arcade.stack.scenes[0].kiosk_unlock, "_holds", lambda device: True)  # type: ignore[attr-defined]
    frames(arcade, round(10 * UNLOCK) + 2)
    page = arcade.stack.top
    assert isinstance(page, PinPage)
    monkeypatch.undo()
    for letter in f"{PIN}\r":
        key = pygame.K_RETURN if letter == "\r" else ord(letter)
        for kind in (pygame.KEYDOWN, pygame.KEYUP):
            pygame.event.post(pygame.Event(kind, key=key, unicode=letter, scancode=40 if letter == "\r" else 30, mod=0))
        frames(arcade, 1)
    assert isinstance(arcade.stack.top, OptionsPage)
    arcade.stack.top.leave()
    arcade.stack.scenes[1:] = []
    with monkeypatch.context() as patch:
        patch.setattr(arcade.stack.scenes[0].kiosk_unlock, "_holds", lambda device: True)  # type: ignore[attr-defined]
        frames(arcade, round(10 * UNLOCK) + 2)
    assert isinstance(arcade.stack.top, PinPage), "whoever holds it after the operator has left needs the PIN, too"
    arcade.stack.scenes[1:] = []
    frames(arcade, 10 * round(BREAK) + 5)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_F10, unicode="", scancode=67, mod=0))
    frames(arcade, 15)
    assert isinstance(arcade.stack.top, PinPage)
