"""A match with real robots: they take their places, the match waits for whatever goes wrong with them, and any of them
can be handed to a simulated one and back.
"""

import logging
from collections.abc import Callable, Collection, Mapping, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.safety import Does, Fault
from pigaming_app.hardware.session.real import Mat, NoMat, exact, refused, unfit
from pigaming_app.scenes.calibration.corner_markers import DriftWatch
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, Push, Scene, Turn
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.play.countdown import Countdown
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import LEAD, NOTICE, MatchScene, rematch_setup
from pigaming_app.scenes.results.scene import After
from pigaming_app.scenes.robots.fault_page import FaultPage, fault_sentence
from pigaming_app.scenes.robots.interrupted import MatchOf
from pigaming_app.scenes.robots.marker_discs import MarkerDiscs
from pigaming_app.scenes.robots.swap_page import SwapPage
from pigaming_app.scenes.robots.take_places import TakePlaces
from pigaming_app.ui.draw import ALARM
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import caption

IDLE = 180.0  # seconds without a press while robots take their places, until the title
TOLD = ("low", "drifts", "deadman")  # what is only said

log = logging.getLogger("pigaming")


class RealMatch(MatchScene):
    """A match in which the robots of the seats `real` are real ones. Raises NoMat where they cannot be used.

    `match_of`: makes the rematch.
    """

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        mat: Mat,
        match_of: MatchOf,
        game_choice: After | None = None,
    ) -> None:
        if reason := unfit(context.settings):
            raise refused(NoMat(reason))
        rig = mat.open()
        chosen = {seat for seat in real if setup.seats[seat].brain != "off"}
        self.mat, self.match_of = mat, match_of
        super().__init__(
            context, setup, devices, plant=lambda world: MixedPlant(world, rig, chosen), game_choice=game_choice
        )
        plant = self.match.plant
        assert isinstance(plant, MixedPlant)
        self.plant = plant
        self.discs = MarkerDiscs(rig)
        self.watch = DriftWatch(rig)
        self.gathering: TakePlaces | None = TakePlaces(context, plant, lambda: self.access.voice)
        self.gone = False  # it has let go of the mat
        self.waiting = FixedTimestep()  # ticks in which all wait
        self.logged: set[tuple[str, int | None]] = set()
        self._dressed()

    @property
    def real(self) -> set[int]:
        """The seats whose robots are real, or will be once they have taken their places."""
        return self.plant.real | self.plant.arriving

    def entered(self) -> None:
        """Begin, or go on after an interruption."""
        if self.gathering is None:
            super().entered()
        else:
            self.context.sounds.music(True)
            self.begun = True

    def left(self) -> None:
        """Stop the robots; let go of camera and radio, unless the next match has them already."""
        if not self.gone:
            self.gone = True
            self.mat.close()

    def on(self, event: InputEvent) -> Turn:
        """As in every match. STOP stops all robots. While places are taken, START begins as they stand, X
        lets simulated robots begin where real ones are missing, and BACK leaves.
        """
        if event.button is Button.STOP and not self.match.over:
            self.plant.safety.all_stop()
            self.plant.watch()
            return Push(FaultPage(self, event.device))
        if self.gathering is None:
            return super().on(event)
        admitted = self.access.admit(self.gathering.prompts.as_button(event))
        if admitted is None:
            return None
        event = admitted
        if event.button is Button.START and self.gathering.clock > self.gathering.DEAF:
            self.plant.accept_places()
            self._begin()
        elif event.button is Button.X:
            for seat in self._missing():
                self.swap(seat, False)
            self.context.sounds.play("accept")
        elif event.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> Turn:
        """Let the match run on, unless something is wrong with a robot in it."""
        if self.repeated or self.stopped:
            return super().update(seconds)
        seconds = self.mat.advance(seconds)
        if self.gathering is not None:
            return self._gather(self.gathering, seconds)
        if self.plant.safety.pauses and not self.match.over:
            return Push(FaultPage(self))
        if self.count.locked or self.match.over:
            self._rest(seconds)
        turn = super().update(seconds)
        self._tell()
        return turn

    def draw(self, screen: pygame.Surface) -> None:
        """The match or the places; the discs last of all."""
        if self.gathering is None:
            super().draw(screen)
        else:
            self.gathering.draw(screen)
            if self.gathering.flood.whole:
                self.watch.draw(screen)
                return
        self.shine(screen)

    # ---- what the pages above it may do

    @property
    def extras(self) -> Mapping[str, Callable[[Access], Scene]]:
        """Which robots are real can be changed in a pause."""
        return {"robots": lambda access: SwapPage(self, access)}

    @property
    def stuck(self) -> bool:
        """Whether something is wrong with a robot."""
        return self.plant.safety.pauses

    def hold(self, seconds: float) -> None:
        """Let time pass under a page: all robots stand, and faults come and go."""
        self._rest(self.mat.advance(seconds))

    def shine(self, screen: pygame.Surface) -> None:
        """The corner markers and the discs, over everything."""
        if self.real:
            self.watch.draw(screen)
        self.discs.draw(screen, self.real)

    def paired(self, channels: Sequence[int], well: Collection[int]) -> None:
        """Which radio drives which robot has been found anew; the robots `well` turned as they should."""
        self.plant.rig.channels = channels
        self.context.settings.radios = [channel + 1 for channel in channels]
        for robot in well:
            self.plant.forgive(robot)

    def swap(self, seat: int, real: bool) -> None:
        """Hand a seat to its simulated or its real robot; that one takes its place first."""
        if real == (seat in self.real):
            return
        self.plant.swap(seat, real)
        if self.plant.arriving:
            self.gathering = TakePlaces(self.context, self.plant, lambda: self.access.voice)
        self._dressed()

    def again(self, context: Context, setup: Setup, devices: Sequence[Device | None]) -> Scene:
        """The same match with other luck and the same robots."""
        self.left()
        return self.match_of(rematch_setup(setup, devices), devices, self.real)

    # ---- inside

    def _gather(self, gathering: TakePlaces, seconds: float) -> Turn:
        """Drive the robots to their places."""
        if lost := self.lost:
            return Push(Reconnect(self, lost[0]))
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        gathering.update(seconds)
        self.signs.work(0.0)
        self.runner.warm(4.0)
        for _ in range(self.waiting.due(seconds)):
            if self.plant.take_places():
                self._begin()
                break
        self._tell()
        if self.plant.safety.stopped or self.plant.safety.lasting:
            return Push(FaultPage(self))
        return Home() if self.context.idle > IDLE else None

    def _missing(self) -> list[int]:
        """The robots that will not get to their places by themselves."""
        troubled = {fault.robot for fault in self.plant.faults if fault.pauses}
        late = [place for place in self.plant.places if not place.there]
        return [place.robot for place in late if not place.moving or {None, place.robot} & troubled]

    def _begin(self) -> None:
        """All are where they begin, or may begin where they are."""
        self.gathering = None
        self.count = Countdown(lead=LEAD)
        self.idle = 0.0
        self.context.sounds.play("ready", 0)
        self._dressed()

    def _rest(self, seconds: float) -> None:
        """All robots stand."""
        for _ in range(self.waiting.due(seconds)):
            self.plant.watch()
        self._tell()

    def _dressed(self) -> None:
        """The view and the tracker know which robots are real."""
        self.runner.view.real = frozenset(self.real)
        self.plant.rig.tracker.expected = self.real

    def _tell(self) -> None:
        """Write what is newly wrong into the log; what is only said, over the match."""
        now = {(fault.name, fault.robot): fault for fault in self.plant.faults if self._worth(fault)}
        for key in now.keys() - self.logged:
            detail = exact(self.plant.rig, now[key].name)
            log.warning("%s", " ".join(filter(None, (fault_sentence(now[key], ENGLISH, "FIRE"), detail))))
            if now[key].name in TOLD:
                said = fault_sentence(now[key], self.context.words, "")
                self.notice, self.noticed = caption(said, ALARM, player=now[key].robot), 2 * NOTICE
        self.logged = set(now)

    def _worth(self, fault: Fault) -> bool:
        """A robot that is hard to see for a moment is not worth a line."""
        return fault.does is not Does.HALF and (fault.pauses or fault.name in TOLD)


ENGLISH = Words("en")
