"""Match setup, the last page before a match: arena, goal, duration, rules. Starts with the previous selection.

Any seated device may operate it: up and down select a row, left and right change its value, FIRE starts.
"""

from collections.abc import Sequence
from dataclasses import replace

import pygame

from pigaming_app.games.arenas import own_arenas, score_name
from pigaming_app.games.game import ALLIES, Game, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.scenes.features.registry import draw_arena
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title, change_arena, change_rules, last_choice, playable_arenas
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation
from pigaming_app.scenes.lobby import match_setup_view as choice
from pigaming_app.scenes.lobby.begin import begin, chosen_setup, minutes_of
from pigaming_app.scenes.lobby.dealt import deal, first_state, start_positions
from pigaming_app.scenes.lobby.seats import EMPTY, LobbySeats
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.results.high_scores import contest, format_score, table_of
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import PLAYERS, reads_large
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, LitImage, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, frame

INPUT_LOCKOUT = 0.35  # s during which a start is ignored, because players may still hammer on "ready"
SLIDE_SECONDS = 0.18  # s, slide-in of another arena
FRAME = pygame.Rect(LEFT, 216, span(0, 8)[1], 660)
PICTURE = FRAME.inflate(-24, -24)
MARGIN = 8  # px around the arena preview
ROW_X, ROW_W = span(8, 4)
GO = pygame.Rect(ROW_X, 780, ROW_W, 96)


class MatchSetupPage(Page):
    """Setup page for the match of `seats`. `game_choice`: see `Results`."""

    title, idle = "setup.title", 60.0

    def __init__(self, context: Context, game: str, seats: LobbySeats, game_choice: SceneFactory | None = None) -> None:
        self.access = Access(context, seats.devices)
        self.context, self.game, self.seats, self.game_choice = context, games()[game], seats, game_choice
        self.arenas = playable_arenas(game)
        self.versions: dict[str, str] = {}  # of the user's own arenas
        self.chosen = last_choice(context, game)
        self.rows = rows(self.game, self.variant)
        self.slide, self.direction = SLIDE_SECONDS, 1
        self.going = False  # start requested, waiting for the preloader
        self.seed = 0  # of the next match
        self.things: tuple[ThingSpec, ...] = ()  # on the mat, for a match with real robots
        self.editor = draw_arena(context, game)
        spots = [FocusSpot(name, box) for name, box in self.rows.items()]
        super().__init__(context, Focus(spots, "arena"), self.access)

    @property
    def hints(self) -> Hints:
        build = [(Button.Y, "things.hint_build")] if self._on_mat else []
        draw = [(Button.X, "setup.hint_editor")] if self.editor else []
        change = [(Button.FIRE, "setup.hint_go"), (Button.RIGHT, "setup.hint_change")]
        return [*change, *build, *draw, (Button.BACK, "setup.hint_back")]

    def on_enter(self) -> None:
        """Reset on first display and on return from the results."""
        from pigaming_app.scenes.play.drivers import new_seed

        self.age, self.going, self.seed = 0.0, False, new_seed()
        self.context.sounds.music("title")
        self._find_arenas()
        if self._on_mat and self.context.mat:
            self.things = self.context.mat.things

    def handle(self, event: InputEvent) -> StackOperation:
        """Nothing counts while the match is loaded."""
        return None if self.going else super().handle(event)

    def press(self, event: InputEvent) -> StackOperation:
        """Change a value or start."""
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._change(self.focus.name, 1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                return self._go() if self.age > INPUT_LOCKOUT else None
            case Button.Y if self._on_mat and self.context.mat:
                self.context.sounds.play("accept")
                return Push(self.context.mat.arena_page(self.seats.devices))
            case Button.X if self.editor:
                self.context.sounds.play("accept")
                return Push(self.editor())
            case Button.CLICK:
                self.focus.handle(event)
                return self._click(event)
            case _:
                return super().press(event)
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Animate the preview; go back if a seat lost its device."""
        if any(device and not self.context.controls.connected(device) for device in self.seats.devices()):
            return Pop()
        self.slide = min(SLIDE_SECONDS, self.slide + seconds)
        return self._begin() if self.going else None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the preview and the rows."""
        choice.lineup(self._lineup()).draw(screen, RIGHT, 112)
        black_out(screen, FRAME, *self.rows.values())
        self._picture(screen)
        for name, box in self.rows.items():
            self._row(name).draw(screen, *box.topleft)
        self._records(screen)
        choice.focus_outline(self.rows[self.focus.name].h).draw(screen, *self.rows[self.focus.name].topleft)
        self.focus.draw(screen)

    # ---- inside

    def _find_arenas(self) -> None:
        """List the arenas again, as the user may have drawn or deleted some; the one saved last is chosen."""
        self.arenas = self._with_room(playable_arenas(self.game.name))
        self.versions = {name: score_name(self.game.name, name) for name in own_arenas(self.game.name)}
        first_state.cache_clear()
        saved = self.context.settings.choice(self.game.name).arena
        if saved in self.arenas:
            self.chosen.arena = saved
        elif self.chosen.arena not in self.arenas:
            self.chosen.arena = self.arenas[0]

    def _with_room(self, arenas: tuple[str, ...]) -> tuple[str, ...]:
        """The arenas that real robots fit into on their surface; all if there are none, which the match then says."""
        mat, real = self.context.mat, self.seats.real()
        if mat is None or not real:
            return arenas
        return tuple(name for name in arenas if mat.has_room(self.game.name, name, real)) or arenas

    @property
    def _on_mat(self) -> bool:
        """True if real robots play under our own camera."""
        mat = self.context.mat
        return mat is not None and mat.scans and bool(self.seats.real())

    def _go(self) -> StackOperation:
        if self.context.settings.keep_choices:
            self.save()
        self.context.sounds.play("accept")
        self.going = True
        return self._begin()

    def _begin(self) -> StackOperation:
        """Push the match, or return None while the preloader is busy."""
        return begin(self.context, self._setup(), self.chosen.rounds, self.seats, self.game_choice)

    def _setup(self) -> Setup:
        """The setup selected now."""
        return chosen_setup(self.context, self.game, self.chosen, self.seats, self.seed)

    def _row(self, name: str) -> LitImage:
        """Render a row."""
        words, now, game, sizes = self.context.words, self.chosen, self.game, row_sizes(self.game, self.variant)
        if name == "arena":
            position = f"{self.arenas.index(now.arena) + 1} / {len(self.arenas)}"
            arena = arena_title(load_cached(game.name, now.arena), words.language)
            return choice.row(sizes, words(f"setup.arena_{game.name}"), arena, position)
        if name == "goal":
            return choice.chips(sizes, self._goal_name(), tuple(map(str, self.variant.goals)), str(now.goal))
        if name == "minutes":
            minutes = str(minutes_of(game, now))
            return choice.chips(sizes, words("setup.minutes"), tuple(map(str, self.minutes)), minutes)
        if name == "rounds":
            return choice.short_chips(words("setup.rounds"), self._round_labels(), game.rounds.index(now.rounds))
        if name == "rules":
            line = words(f"rules.{game.name}_{now.variant}")
            return choice.row(sizes, words("setup.rules"), words(f"setup.{game.name}_{now.variant}"), line=line)
        return choice.start_button(words("setup.go"))

    def _goal_name(self) -> str:
        allied = self.variant.team_mode == ALLIES
        return self.context.words(f"setup.{self.game.goal}_of_all" if allied else f"setup.{self.game.goal}")

    def _change(self, name: str, delta: int) -> None:
        """Step a row's value by `delta`."""
        now, game = self.chosen, self.game
        before = replace(now)
        if name == "arena":
            change_arena(game, now, self.arenas[(self.arenas.index(now.arena) + delta) % len(self.arenas)])
            self.slide, self.direction = 0.0, delta
        elif name == "goal":
            now.goal = step_clamped(self.variant.goals, now.goal, delta)
        elif name == "minutes" and now.rounds == 1:
            now.minutes = step_clamped(self.variant.minutes, now.minutes, delta)
        elif name == "rounds":
            now.rounds = step_clamped(game.rounds, now.rounds, delta)
        elif name == "rules":
            self._change_variant(delta)
        if now != before:
            self.context.sounds.play("move")
        self.context.settings.games[game.name] = now

    @property
    def variant(self) -> Variant:
        """The selected rule set."""
        return self.game.variants[self.chosen.variant]

    @property
    def minutes(self) -> Sequence[int]:
        """The choices of minutes; of a match of several rounds only one."""
        return self.variant.minutes if self.chosen.rounds == 1 else (self.game.round_minutes,)

    def _round_labels(self) -> tuple[str, ...]:
        return tuple(self.context.words(f"setup.rounds_{count}") for count in self.game.rounds)

    def _change_variant(self, delta: int) -> None:
        """Step the rule set by `delta`; see `change_rules` for minutes and goal."""
        names, now = list(self.game.variants), self.chosen
        change_rules(self.game, now, names[(names.index(now.variant) + delta) % len(names)])
        self.seats.change_mode(self.variant.team_mode)
        self.rows = rows(self.game, self.variant)
        self.focus.set_spots([FocusSpot(name, box) for name, box in self.rows.items()])

    def _click(self, event: InputEvent) -> StackOperation:
        """Handle a click on the arrows or chips of a row, the preview (next arena) or the start button."""
        name = self.focus.spot_at(event)
        at = event.at or (0.0, 0.0)
        if name == "go":
            return self._go()
        if name in ("goal", "minutes"):
            values = self.variant.goals if name == "goal" else self.minutes
            now = self.chosen.goal if name == "goal" else minutes_of(self.game, self.chosen)
            chip = choice.chip_at(len(values), at[0] - self.rows[name].left)
            if chip is not None:
                self._change(name, chip - values.index(now))
        elif name == "rounds":
            chip = choice.short_chip_at(self._round_labels(), at[0] - self.rows[name].left)
            if chip is not None:
                self._change(name, chip - self.game.rounds.index(self.chosen.rounds))
        elif name:
            self._change(name, 1 if at[0] > self.rows[name].centerx else -1)
        elif FRAME.collidepoint(at):
            self._change("arena", 1)
        return None

    def _records(self, screen: pygame.Surface) -> None:
        """Draw the best scores for this selection, if the rows leave room."""
        gap = row_sizes(self.game, self.variant).gap
        low = max(box.bottom for name, box in self.rows.items() if name != "go") + gap
        lines = []
        for achievement in self.game.records_of(self.variant.name):
            best = self.context.scores.best(table_of(contest(self._setup()), achievement))
            if best:
                name = self.context.words(f"setup.best_{achievement.name}")
                lines.append(
                    (name, self.context.words.decimal(format_score(best[0].score, achievement)), best[0].initials)
                )
        if lines and low + choice.records_height(len(lines)) <= GO.top - gap:
            choice.records(tuple(lines)).draw(screen, ROW_X, low)

    def _lineup(self) -> tuple[tuple[int, str], ...]:
        """(seat, driver icon) of every occupied seat."""
        kinds = ((i, place) for i, place in enumerate(self.seats.places) if place.kind != EMPTY)
        return tuple((i, self.context.controls.sign(place.device) if place.device else "ai") for i, place in kinds)

    def _picture(self, screen: pygame.Surface) -> None:
        """Draw the arena preview sliding in, with markers at the start positions."""
        frame(*FRAME.size).draw(screen, *FRAME.topleft)
        left = (1.0 - self.slide / SLIDE_SECONDS) ** 2
        dx = round(self.direction * 160 * left)
        screen.set_clip(FRAME.inflate(-12, -12))
        allies, arena = self.variant.team_mode == ALLIES, self.chosen.arena
        picture(self.game.name, arena, allies, self.versions.get(arena, "")).draw(screen, dx)
        k = min((PICTURE.w - 2 * MARGIN) / WIDTH, (PICTURE.h - 2 * MARGIN) / HEIGHT)
        x0, y0 = PICTURE.centerx - k * WIDTH / 2, PICTURE.centery - k * HEIGHT / 2
        choice.draw_things(screen, self.things, (x0 + dx, y0), k)
        dealt = deal(self._setup(), *PICTURE.size)
        screen.blit(dealt.image, (PICTURE.x + dx, PICTURE.y), special_flags=pygame.BLEND_PREMULTIPLIED)
        starts = start_positions(self._setup())
        for i, _ in self._lineup():
            stage = int((self.age * 0.7 + 0.25 * i) % 1.0 * 1.5 * effects.WAVE_STEPS)
            if stage < effects.WAVE_STEPS // 2:
                wave = effects.wave(PLAYERS[i], stage)
                screen.blit(
                    wave.image,
                    (round(x0 + dx + k * starts[i][0] + wave.dx), round(y0 + k * starts[i][1] + wave.dy)),
                    special_flags=pygame.BLEND_RGB_ADD,
                )
        screen.set_clip(None)


@cached
@resumable
def picture(game: str, name: str, allies: bool, version: str) -> Steps[LitImage]:
    """Large preview of an arena, positioned for the page. `allies`: all robots are in one team.

    `version`: of its file, which the user may have changed.
    """
    image = yield from SCREENS[game].picture(load_cached(game, name), *PICTURE.size, allies)
    return LitImage(image, PICTURE.topleft)


def rows(game: Game, variant: Variant) -> dict[str, pygame.Rect]:
    """Rectangles of the rows that offer a choice, and of the start button."""
    sizes, boxes, y = row_sizes(game, variant), {}, FRAME.top
    for name in row_names(game, variant):
        height = _height(name, sizes)
        boxes[name] = pygame.Rect(ROW_X, y, ROW_W, height)
        y += height + sizes.gap
    return {**boxes, "go": GO}


def row_names(game: Game, variant: Variant) -> list[str]:
    """The rows that offer a choice, top to bottom."""
    there = {
        "arena": True,
        "goal": bool(variant.goals),
        "minutes": len(variant.minutes) > 1,
        "rounds": len(game.rounds) > 1,
        "rules": len(game.variants) > 1,
    }
    return [name for name, offered in there.items() if offered]


def row_sizes(game: Game, variant: Variant) -> choice.RowSizes:
    """Sizes with which all rows fit above the start button."""
    wide, tight = (choice.LARGE_WIDE, choice.LARGE_TIGHT) if reads_large() else (choice.WIDE, choice.TIGHT)
    needed = sum(_height(name, wide) + wide.gap for name in row_names(game, variant))
    return wide if needed <= GO.top - FRAME.top else tight


def _height(name: str, sizes: choice.RowSizes) -> int:
    return choice.LOW if name == "rounds" else sizes.described if name == "rules" else sizes.choice


def step_clamped(values: Sequence[int], value: int, delta: int) -> int:
    """The element `delta` places after `value`, clamped at both ends."""
    return values[max(0, min(len(values) - 1, values.index(value) + delta))]
