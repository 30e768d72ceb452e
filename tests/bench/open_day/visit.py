"""What visitors do on the screens of a game: title, lobby, set-up, match, results."""

import math
from copy import copy
from typing import Any

from pigaming_app.ai.brain.driving import FORESIGHT, TURN_GAIN
from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.game_ai import HELPED_POINT, POINT
from pigaming_app.ai.race.racer import HAND3, act
from pigaming_app.games.game import Game
from pigaming_app.games.race.observation import observe
from pigaming_app.games.registry import games
from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.flow.match_choice import last_choice
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.ladder.choice import LadderChoice
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.pages.pin_page import PinPage
from pigaming_app.scenes.phones.join import JoinByPhone
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect, StillThere
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.replays.page import ReplaysPage
from pigaming_app.scenes.results.high_scores import HighScores
from pigaming_app.scenes.results.initials import Initials
from pigaming_app.scenes.results.scene import LATE, Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.scores import LETTERS
from pigaming_app.storage.settings import Choice
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.letter_picker import LetterPicker
from tests.bench.open_day.hands import PadHands, PhoneHands
from tests.bench.open_day.plan import GUESS
from tests.bench.open_day.stage import Player, Stage

FAST = 0.1  # s between two letters
DRIVING, RACING = 0.7, 0.1  # s between two movements of the stick
AWAY = 4.0  # s for which a pad is pulled, or a phone locked
LOOK = 8.0  # s on a page of the title's menu
REST = 95.0  # s for which nobody drives
MINUTES, GOAL = 1, 3  # of a match, at most, where its rules allow it
MISHAP_AT = 8.0  # s of the match
LEAST_REACH = 0.3  # deflection of a stick that turns a robot where it stands


class Visit:
    """The reactions of the group on the stage."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.away: tuple[float, Player] | None = None  # s when a device comes back, and whose
        self.resting = 0.0  # s until which nobody drives
        self.raced: MatchScene | None = None
        self.drivers: dict[int, tuple[Any, Any]] = {}  # mind and action of each seat of that race
        self.leaves_match = False  # ends the match in the pause
        stage.fallback = self.leave_page
        stage.reactions |= {
            Attract: lambda: stage.one_presses(Button.FIRE),
            Title: self.title,
            Lobby: self.lobby,
            JoinByPhone: self.lobby,
            MatchSetupPage: self.setup,
            MatchScene: self.match,
            Reconnect: self.reconnect,
            StillThere: self.still_there,
            Pause: self.pause,
            WinnersMoment: self.winner,
            Initials: self.initials,
            HighScores: lambda: stage.one_presses(Button.FIRE),
            Results: self.results,
            HowTo: self.look_around,
            ReplaysPage: self.look_around,
            LadderChoice: self.look_around,
            PinPage: self.guess,
        }

    @property
    def group(self):
        assert self.stage.group is not None
        return self.stage.group

    # ---- before the match

    def title(self) -> None:
        stage, top = self.stage, self.stage.top
        self.return_device()
        if self.group.language and top.context.words.language != self.group.language and not stage.matches:
            stage.one_presses(Button.Y)
            return
        if self.group.look == GUESS and not stage.looked:
            self.seek_a_way_out()
            return
        goal = "events" if self.group.event else self.group.game if stage.looked else self.group.look
        if stage.focus(top.focus, goal):
            stage.one_presses(Button.FIRE)

    def seek_a_way_out(self) -> None:
        """Hold the combination that the page for operators tells, on a pad."""
        stage = self.stage
        pads = [player.hands for player in stage.players if isinstance(player.hands, PadHands)]
        if not pads:
            stage.looked = True
        else:
            pads[0].steer(0.0, -1.0, False, True)

    def guess(self) -> None:
        """Enter what comes to mind, until the arcade makes them wait."""
        stage, page = self.stage, self.stage.top
        stage.looked = True
        pads = [player for player in stage.players if isinstance(player.hands, PadHands)]
        pads[0].hands.steer(0.0, 0.0, False, False)
        if page.waiting:
            stage.all_press(Button.BACK, pads[:1])
        elif len(page.digits) == 4:
            stage.watch.count("guesses of the PIN")
            stage.all_press(Button.START, pads[:1])
        else:
            stage.all_press(stage.rng.choice((Button.FIRE, Button.FIRE, Button.UP, Button.LEFT)), pads[:1])

    def look_around(self) -> None:
        """Look at a page, turn it over, and go back."""
        stage = self.stage
        stage.looked = True
        if stage.now - stage.changed > LOOK:
            stage.one_presses(Button.BACK)
        elif stage.rng.random() < 0.03:
            stage.one_presses(stage.rng.choice((Button.LEFT, Button.RIGHT)))

    def lobby(self) -> None:
        """Everybody joins and is ready; somebody who is alone wants an AI, somebody a shorter match."""
        stage, lobby = self.stage, self.stage.lobby
        assert lobby is not None
        seated = lobby.seats.devices()
        absent = [player for player in stage.players if player.hands.device not in seated]
        if absent:
            stage.all_press(Button.FIRE, absent)
        elif lobby.seats.robots < 2:
            stage.one_presses(Button.Y)
        elif long_rows(last_choice(lobby.context, lobby.game), games()[lobby.game]):
            stage.one_presses(Button.START)
        else:
            waiting = [player for player in stage.players if not self._is_ready(player)]
            stage.all_press(Button.FIRE, waiting)

    def _is_ready(self, player: Player) -> bool:
        lobby = self.stage.lobby
        assert lobby is not None
        return any(place.device == player.hands.device and place.ready for place in lobby.seats.places)

    def setup(self) -> None:
        """Change something; then make it a short match, since others wait, and start."""
        stage, page = self.stage, self.stage.top
        if stage.now - stage.changed < 3.0:
            stage.one_presses(stage.rng.choice((Button.DOWN, Button.RIGHT)))
            return
        rows = [row for row in long_rows(page.chosen, page.game) if row in page.rows]
        if not rows:
            stage.one_presses(Button.START)
        elif stage.focus(page.focus, rows[0]):
            stage.one_presses(Button.LEFT)

    # ---- the match

    def match(self) -> None:
        stage, scene = self.stage, self.stage.top
        show = not scene.drivers.people  # of AIs: any turbo would halt it
        if scene.match.over or scene.opening.countdown.locked or show:
            return
        self._mishap(scene)
        if stage.now < self.resting:
            for player in stage.players:
                player.hands.steer(0.0, 0.0, False, False)
            return
        for player in stage.players:
            racing = scene.setup.game == "race" and player.hands.device in scene.devices
            if racing and stage.ready(player, RACING):
                player.hands.steer(*self._racing_line(scene, scene.devices.index(player.hands.device)))
            elif not racing and stage.ready(player, DRIVING):
                x, y = stage.rng.uniform(-1.0, 1.0), stage.rng.choice((-1.0, -1.0, -1.0, 0.6, 0.0))
                player.hands.steer(x, y, stage.rng.random() < 0.5, stage.rng.random() < 0.3)

    def _racing_line(self, scene: MatchScene, seat: int) -> tuple[float, float, bool, bool]:
        """Stick and buttons of a hand-written driver: without one, each race would last until its time is up.

        It decides whenever it is asked, on an action of its own: that of the match is the device's.
        """
        state = scene.match.state
        if self.raced is not scene:
            self.raced, self.drivers = scene, {}
        if seat not in self.drivers:
            self.drivers[seat] = BrainPlayer(HAND3, seat + 1).mind, copy(state.actions[seat])
        mind, action = self.drivers[seat]
        observe(state, seat, mind.senses, mind.obs)
        act(mind.obs, mind, action)
        x, y = float(action.angular), -float(action.linear)
        if (device := scene.devices[seat]) and scene.drivers.style_of(device) in (POINT, HELPED_POINT):
            x, y = where_to_go(action, state.robots[seat], state.rules.turn_rate)
        return x, y, bool(action.fire), bool(action.turbo)

    def _mishap(self, scene: MatchScene) -> None:
        """The mishap of the group, once."""
        stage, group = self.stage, self.group
        self.return_device()
        if stage.mishap_over or not group.mishap or scene.match.seconds < MISHAP_AT:
            return
        stage.mishap_over = True
        kinds = {"pull": PadHands, "lock": PhoneHands}
        victims = [one for one in stage.players if isinstance(one.hands, kinds.get(group.mishap, object))]
        if not victims:
            return
        if group.mishap in kinds:
            victims[0].hands.unplug()
            self.away = stage.now + AWAY, victims[0]
        elif group.mishap == "rest":
            self.resting = stage.now + REST
        else:
            self.leaves_match = group.mishap == "stop" and scene.after is None
            for player in stage.players:
                player.hands.steer(0.0, 0.0, False, False)
            stage.tap(victims[0].hands, Button.START)
        stage.watch.count(group.mishap)

    def return_device(self) -> None:
        """Put the pulled pad back, or unlock the phone, when it is time."""
        if self.away and self.stage.now >= self.away[0]:
            self.away[1].hands.plug()
            self.away = None

    def reconnect(self) -> None:
        self.return_device()
        gone = [player for player in self.stage.players if player.hands.device != self.stage.top.device]
        same = [player for player in self.stage.players if player not in gone]
        free = [player for player in gone if player.hands.device not in self.stage.top.match.devices]
        self.stage.all_press(Button.FIRE, [player for player in (*same, *free) if player.hands.device])

    def still_there(self) -> None:
        self.resting = 0.0
        self.stage.one_presses(Button.FIRE)

    def pause(self) -> None:
        """Go on, or end the match."""
        stage = self.stage
        stage.mishap_over = True
        owner = [one for one in stage.players if one.hands.device == stage.top.access.owner] or stage.players
        if stage.focus(stage.top.focus, "end" if self.leaves_match else "continue", owner[0]):
            stage.all_press(Button.FIRE, owner[:1])

    # ---- after the match

    def winner(self) -> None:
        for player in self.stage.players:
            player.hands.steer(0.0, 0.0, False, False)

    def initials(self) -> None:
        """Everybody spells their own initials."""
        page, stage = self.stage.top, self.stage
        for player in stage.players:
            spelling = page.spellings.get(player.hands.device)
            if spelling and not spelling.done and stage.ready(player, FAST):
                stage.tap(player.hands, next_letter(spelling.picker, player.visitor.initials))

    def results(self) -> None:
        """Another match, or the title. B is held."""
        stage, page = self.stage, self.stage.top
        self.leaves_match = False
        self.resting = 0.0
        if page.age < LATE or page.claims:
            return
        if not stage.finished:
            stage.all_press(Button.FIRE)
        elif stage.speaker and stage.ready(stage.speaker[0]):
            stage.tap(stage.speaker[0].hands, Button.BACK, 0.8)

    def leave_page(self) -> None:
        """An unexpected page is left."""
        self.stage.one_presses(Button.BACK)


def long_rows(choice: Choice, game: Game) -> list[str]:
    """The rows of match setup that make a match too long for those who wait."""
    variant = game.variants[choice.variant]
    long = {"minutes": choice.rounds == 1 and choice.minutes > max(MINUTES, min(variant.minutes))}
    long["goal"] = bool(variant.goals) and choice.goal > max(GOAL, min(variant.goals))
    return [row for row, is_long in long.items() if is_long]


def where_to_go(action: Any, robot: Any, turn_rate: float) -> tuple[float, float]:
    """The stick that points where an action leads; backwards it turns round. See `driving.pointed`."""
    reach, angle = max(LEAST_REACH, abs(action.linear)), action.angular * turn_rate / TURN_GAIN
    heading = robot.heading + (math.pi if action.linear < 0.0 else FORESIGHT * robot.angular + angle)
    return reach * math.cos(heading), reach * math.sin(heading)


def next_letter(picker: LetterPicker, wanted: str) -> Button:
    """The button that brings a name nearer; at its end the one that enters it."""
    missing = [i for i, letter in enumerate(wanted) if picker.spelled[i] != letter]
    if not missing:
        return Button.FIRE
    slot = missing[0]
    if slot != picker.slot:
        return Button.RIGHT if slot > picker.slot else Button.LEFT
    turns = (LETTERS.index(wanted[slot]) - LETTERS.index(picker.spelled[slot])) % len(LETTERS)
    return Button.DOWN if turns <= len(LETTERS) // 2 else Button.UP
