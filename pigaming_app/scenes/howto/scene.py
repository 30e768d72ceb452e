"""How to play: pages of four lessons with captions, and the buttons of the device used last."""

from collections.abc import Sequence

import pygame

from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_words import last_minutes, last_variant, limits_line
from pigaming_app.scenes.flow.scene import Context, Home, Pop, StackOperation
from pigaming_app.scenes.howto.clip import Cutout, LessonClip
from pigaming_app.scenes.howto.keys import draw_keys
from pigaming_app.scenes.views.game_screens import LESSONS_PER_PAGE
from pigaming_app.scenes.views.lesson import Lesson
from pigaming_app.scenes.views.registry import SCREENS, shown_games
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, budget, resumable
from pigaming_app.ui.draw.layers import (
    LEFT,
    RIGHT,
    SMALLEST,
    Layer,
    LitImage,
    backdrop,
    fit_lines,
    fit_size,
    span,
    text,
    wrap,
    wrap_balanced,
)
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import black_out, button_label, chip, chip_width, heading

TOP, HIGH = 220, 620
PICTURE, KEYS_Y = 384, TOP + 438  # px: height of a lesson's picture, and the middle of its keys
CAPTION_Y, LIMITS_Y, FOOT_Y = TOP + 546, 900, 988
LARGE, PITCH = 46, 48  # px: size of the limits in larger text, and pitch of their lines
BADGE = 40  # px, radius of a lesson's number
IDLE = 90.0  # seconds without input until the title
GAP = 24  # px on either side of the arrows between heading and names
APART = 44  # px between the keys of the row at the foot
DOT = 32  # px from dot to dot of the pages
LEAVE = (Button.FIRE, Button.BACK, Button.START, Button.CLICK)


class HowTo:
    """The pages of all games; left and right turn them, a click on a name opens its game, most other buttons leave.

    A game without lessons has no page: the first that has some is shown.
    """

    def __init__(self, context: Context, game: str = "pitanks") -> None:
        self.context, self.game, self.page = context, game if game in taught() else taught()[0], 0
        self.canvas = Cutout((1920, 1080))
        self._begin()

    def on_enter(self) -> None:
        """Restart the lessons."""
        self._begin()

    def _begin(self) -> None:
        self.clips: list[LessonClip] = []

    def _build(self) -> None:
        """Build missing clips. Raises Unfinished when the budget of the frame is spent."""
        for name, lesson in self.lessons()[len(self.clips) :]:
            budget.claim()
            self.clips.append(LessonClip(self.context, self.game, name, lesson, self._variant(), self.canvas))
            budget.note()

    def handle(self, event: InputEvent) -> StackOperation:
        """Turn the page, open a game, or leave."""
        clicked = next((game for game, box in self._names() if event.at and box.collidepoint(event.at)), None)
        if event.button in (Button.LEFT, Button.RIGHT):
            pages = [(game, page) for game in taught() for page in range(SCREENS[game].page_count)]
            step = 1 if event.button is Button.RIGHT else -1
            self._show(*pages[(pages.index((self.game, self.page)) + step) % len(pages)])
        elif event.button is Button.CLICK and clicked:
            self._show(clicked)
        elif event.button in LEAVE:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        for clip in self.clips:
            clip.update(seconds)
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        self._build()
        heading(words("title.howto")).draw(screen)
        for game, box in self._names():
            chip(words(f"events.short_{game}"), box.w, "on" if game == self.game else "off").draw(screen, *box.topleft)
        button_label("<>").draw(screen, self._names()[0][1].left - GAP - kit.button_width("<>"), 112)
        boxes = [pygame.Rect(span(3 * i, 3)[0], TOP, span(3 * i, 3)[1], HIGH) for i in range(4)]
        black_out(screen, *boxes)
        for i, (box, clip) in enumerate(zip(boxes, self.clips, strict=False)):
            clip.draw(screen, pygame.Rect(box.x + 4, TOP + 4, box.w - 8, PICTURE))
            draw_keys(screen, self.context, clip.script, clip.action, pygame.Rect(box.x + 12, KEYS_Y, box.w - 24, 0))
            pygame.draw.circle(screen, kit.BLACK, (box.centerx, TOP), BADGE)
            frame(i + 1, box.w).draw(screen, *box.topleft)
            caption(words(f"howto.{clip.name}"), box.w - 48).draw(screen, box.centerx, CAPTION_Y)
        self._foot(screen)
        keys(self._keys()).draw(screen)

    def _show(self, game: str, page: int = 0) -> None:
        if (game, page) != (self.game, self.page):
            self.context.sounds.play("move")
            self.game, self.page = game, page
            self._begin()

    def lessons(self) -> list[tuple[str, Lesson]]:
        """The lessons of this page: text keys of their captions, and the lessons."""
        first = LESSONS_PER_PAGE * self.page
        return list(SCREENS[self.game].lessons.items())[first : first + LESSONS_PER_PAGE]

    def _foot(self, screen: pygame.Surface) -> None:
        """The limits of the rules, after the name of the rule set and a dot for each page if there are several."""
        words, count, left = self.context.words, SCREENS[self.game].page_count, float(LEFT)
        if SCREENS[self.game].lesson_pages:
            name = words(f"setup.{self.game}_{self._variant()}")
            pages(name, self.page, count).draw(screen)
            left += pages_width(name, count) + 40
        limits = limits_line(words, self.game, self.minutes(), self._variant())
        size, lines = fit_lines(limits, RIGHT - left, 2, range(LARGE if kit.reads_large() else kit.BODY, SMALLEST, -2))
        for i, line in enumerate(wrap_balanced(limits, len(lines), size)):
            y = LIMITS_Y + PITCH * (i - (len(lines) - 1) / 2)
            text(line, size, kit.ICE, "body", "l", round(RIGHT - left)).draw(screen, left, y)

    def minutes(self) -> int:
        """The minutes of the last match, or by default those of another rule set that the page is about."""
        settings, last = self.context.settings, last_variant(self.context.settings, self.game)
        shown = self._variant()
        return (
            last_minutes(settings, self.game)
            if shown == last.name
            else games()[self.game].variants[shown].default_minutes
        )

    def _variant(self) -> str:
        """The rule set of the page; if the game has only one page, that of the last match."""
        names = SCREENS[self.game].lesson_pages
        return names[self.page] if names else last_variant(self.context.settings, self.game).name

    def _names(self) -> list[tuple[str, pygame.Rect]]:
        """The games and the rectangles of their names, at the right end of the heading: as many as have room, with
        the shown game among them.
        """
        words, games = self.context.words, taught()
        room = RIGHT - LEFT - kit.text_width(words("title.howto"), kit.TITLE) - 2 * GAP - kit.button_width("<>")
        widths = {game: chip_width(words(f"events.short_{game}")) for game in games}
        while sum(widths[game] + 16 for game in games) - 16 > room and len(games) > 1:
            games.pop(0 if games.index(self.game) > len(games) // 2 else -1)
        boxes, right = [], RIGHT
        for game in reversed(games):
            boxes.append((game, pygame.Rect(right - widths[game], 80, widths[game], 64)))
            right -= widths[game] + 16
        return boxes[::-1]

    def _keys(self) -> tuple[tuple[str, str], ...]:
        """(label, action) pairs for the device used last; the last pair is right-aligned."""
        words, controls = self.context.words, self.context.controls
        device = controls.last
        turbo = Button.LEAVE_SEAT if device.kind == "keys" else Button.BACK
        keypad, drive = controls.name(device) == "Keypad", words("howto.hint_drive")
        pairs = [
            (kit.KEYPAD, f"{drive} ({words('devices.Keypad')})") if keypad else (controls.moves(device) or "<>", drive),
            (controls.label(device, turbo), words("howto.hint_turbo")),
            (controls.label(device, Button.BACK), words("howto.hint_back")),
        ]
        if fire := SCREENS[self.game].fire:
            pairs.insert(1, (controls.label(device, Button.FIRE), words(f"howto.{fire}")))
        return tuple((words.key_name(label), action) for label, action in pairs if label)


def taught() -> list[str]:
    """The games that have lessons."""
    return [game for game in shown_games() if SCREENS[game].lessons]


@cached
def pages(name: str, page: int, count: int) -> LitImage:
    """The name of a rule set, and a dot for each page."""
    layer = Layer(LEFT, LIMITS_Y - 40, pages_width(name, count), 80)
    for i in range(count):
        x = LEFT + DOT * (i + 0.5)
        if i == page:
            layer.glow.disc(x, LIMITS_Y, 10, kit.FOCUS)
        else:
            layer.glow.ring(x, LIMITS_Y, 8, kit.STEEL, kit.THIN)
    layer.canvas.text(name, kit.BODY, LEFT + DOT * count + 12, LIMITS_Y, kit.FOCUS)
    return layer.render()


def pages_width(name: str, count: int) -> float:
    """Width of that, px."""
    return DOT * count + 12 + kit.text_width(name, kit.BODY)


@cached
@resumable
def frame(number: int, w: int) -> Steps[LitImage]:
    """An empty panel with its number; upper left corner at (0, 0)."""
    layer = Layer(0, 0, w, HIGH)
    kit.panel(layer.glow, 0, 0, w, HIGH, kit.STEEL)
    layer.glow.fill(kit.regular_polygon(40, BADGE - 8, 0, w / 2, 0), kit.ICE)
    layer.glow.text(str(number), kit.LABEL, w / 2, 0, kit.BLACK, "hero", "c")
    yield
    return (yield from layer.render_steps())


@cached
def caption(sentence: str, room: int) -> LitImage:
    """A caption in lines of similar length, centred on (0, 0)."""
    count = len(wrap(sentence, kit.BODY, room))
    sizes = range(kit.readable(kit.BODY), kit.BODY, -2)
    most = next((size for size in sizes if len(wrap(sentence, size, room)) <= max(2, count)), kit.BODY)
    lines = wrap_balanced(sentence, max(count, len(wrap(sentence, most, room))), most)
    layer = Layer(-room / 2, -70, room, 140)
    for i, line in enumerate(lines):
        size = fit_size(line, most, room, "body")
        layer.canvas.body(line, 0, 1.35 * most * (i - (len(lines) - 1) / 2), kit.ICE, "c", size)
    return layer.render()


@cached
@resumable
def keys(items: Sequence[tuple[str, str]]) -> Steps[LitImage]:
    """The row at the foot: left-aligned, except for the last item at the right end."""
    layer = Layer(LEFT, FOOT_Y - 40, RIGHT - LEFT, 80)
    x: float = LEFT
    sizes = range(kit.readable(kit.BODY), SMALLEST, -2)
    size = next((size for size in sizes if _row_width(items, size) <= RIGHT - LEFT), SMALLEST)
    for i, (label, action) in enumerate(items):
        if i == len(items) - 1:
            x = RIGHT - _width(label, size) - 10 - kit.text_width(action, size, "body")
        for part in _parts(label):
            x += kit.button(layer.canvas, x, FOOT_Y, part, size=size) + 8
        layer.canvas.body(action, x + 10, FOOT_Y, kit.MIST, size=size)
        x += 10 + kit.text_width(action, size, "body") + APART
    yield
    return (yield from layer.render_steps())


def _row_width(items: Sequence[tuple[str, str]], size: int) -> float:
    widths = [_width(label, size) + 10 + kit.text_width(action, size, "body") for label, action in items]
    return sum(widths) + APART * (len(items) - 1)


def _width(label: str, size: int) -> float:
    return sum(kit.button_width(part, size) + 8 for part in _parts(label))


def _parts(label: str) -> list[str]:
    """The keys of a label: of arrows each, else one."""
    return label.split() if label[0] in kit.ARROWS else [label]
