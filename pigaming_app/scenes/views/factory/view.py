"""View of Robot Factory: robots with forks, crates, running machines, people."""

import math
from collections.abc import Sequence
from functools import partial

import pygame

from pigaming_app.games.factory.pallets import side_of
from pigaming_app.games.factory.start import floor_of
from pigaming_app.games.factory.state import (
    DAMAGED,
    DONE,
    HALF,
    IN_SLOT,
    PALLETS,
    SHELVES,
    SHIPPED,
    TEAMS,
    WAITING,
    WORKING,
    A,
    Factory,
    Slot,
)
from pigaming_app.scenes.views.background import LEFT, TOP, Background
from pigaming_app.scenes.views.factory import contest, countdowns
from pigaming_app.scenes.views.factory.announcements import FactoryAnnouncements
from pigaming_app.scenes.views.factory.background import bare
from pigaming_app.scenes.views.factory.effects import CratePops, react
from pigaming_app.scenes.views.factory.events import FactoryEventDetector, spot
from pigaming_app.scenes.views.factory.hud import CALLS, FactoryHud
from pigaming_app.scenes.views.factory.next_step import NextStepGuide
from pigaming_app.scenes.views.factory.panels import H as PANEL_H
from pigaming_app.scenes.views.factory.panels import W as PANEL_W
from pigaming_app.scenes.views.factory.panels import X as PANELS
from pigaming_app.scenes.views.factory.panels import Y as TOP_OF_PANELS
from pigaming_app.scenes.views.factory.prewarm import jobs
from pigaming_app.scenes.views.hud.parts import pulse
from pigaming_app.scenes.views.particles import reel
from pigaming_app.scenes.views.rumble import BLOCKED, DELIVERED, GIVEN, PICKED, TAKEN, rumbles
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites.teams import TEAMS as COLORS
from pigaming_app.scenes.views.things.styles import WORKSHOP
from pigaming_app.scenes.views.view import MatchView, Pose, SoundCue, ViewOptions
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HZ, WIDTH
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step
from pigaming_app.ui.i18n import Words

SHOWN_REFUSED = 14  # ticks for which a cross marks a refused action
HANDS = 40.0  # px from a worker to its load
BEFORE = 124.0  # px from a real robot, in its wide disc, to its load
BESIDE = 102.0  # px from a robot to its countdown

# by kind of event
RUMBLES = {"delivered": DELIVERED, "stolen": GIVEN, "freeze": TAKEN, "spoiled": BLOCKED, "lift": PICKED}


class FactoryView(MatchView):
    """The view of one match of Robot Factory."""

    style = WORKSHOP

    def __init__(
        self, arena: Arena, state: Factory, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        floor, kinds = floor_of(state, arena), (bool(state.rules.allies), bool(state.rules.party))
        super().__init__(state, players, options, words, Background(partial(bare, floor, *kinds)), arena.things)
        self.hud = FactoryHud(self.background, players, state, words)
        self.detector = FactoryEventDetector(state)
        self.guide = NextStepGuide(players)
        self.pops = CratePops()
        self.notes = FactoryAnnouncements(words)
        self.people = self.people_before = _people(state)
        self.add_prewarm_jobs(self.hud.jobs(state))
        self.add_prewarm_jobs(partial(bare, other, *kinds) for other in (floor.swapped,) if not state.rules.allies)
        self.add_prewarm_jobs(jobs(self.seats, state, self.notes))

    def show_names(self, names: Sequence[str]) -> None:
        self.hud.names = names

    def watch(self, state: Factory) -> list[SoundCue]:
        self.record_poses(state)
        self.people_before, self.people = self.people, _people(state)
        self.guide.update(state)
        events = self.detector.detect(state)
        self.rumbles = rumbles(RUMBLES, ((event.kind, event.player) for event in events))
        for event in events:
            if event.kind in CALLS:
                self.hud.call(event.worth, event.kind, state.tick)
        cues = react(events, state, self.particles, self.pops, self.notes, self.options)
        return [*cues, *countdowns.sounds(state)]

    def draw(self, screen: pygame.Surface, state: Factory, blend: float, seconds: float) -> None:
        self.particles.advance(seconds)
        for team in self.hud.show(state):
            if self.options.flashes != "off":
                self.particles.bloom(PANELS[team], TOP_OF_PANELS, 0.4, reel(pulse, COLORS[team], PANEL_W, PANEL_H))
        under: Batch = []
        over: Batch = []
        light: Batch = []
        top: Batch = []
        if state.rules.party:
            contest.draw_floor(light, state, self.particles.clock)
        poses = {seat: self.pose(seat, blend) for seat in self.seats}
        self._machines(over, light, state)
        self._crates(over, light, top, state)
        self._people(over, light, top, state, blend)
        for seat, pose in poses.items():
            self._robot(under, over, light, top, state, seat, pose)
            self.guide.draw(light, top, state, seat, pose, self.particles.clock)
        countdowns.draw(light, top, state)
        self._counts(light, state)
        self.particles.draw_light(light)
        self.notes.draw(top, self.particles.clock)
        self.particles.draw_scores(top)
        self.paint(screen, under, over, light, top)

    def _machines(self, over: Batch, light: Batch, state: Factory) -> None:
        rules = state.rules
        for machine in state.machines:
            x, y = LEFT + machine.x, TOP + machine.y
            if machine.reserved:
                put(over, crates.busy(state.pallets[machine.reserved - 1].team, machine.kind), x, y)
            if machine.pallet:
                part = round(crates.COUNTS * (1.0 - machine.left / rules.process))
                put(light, crates.progress(HALF if machine.kind == A else DONE, part), x, y)

    def _crates(self, over: Batch, light: Batch, top: Batch, state: Factory) -> None:
        """Draw the crates in slots; carried ones are drawn with their carrier."""
        for p in range(PALLETS):
            pallet = state.pallets[p]
            if pallet.exists and pallet.place == IN_SLOT:
                x, y = spot(state, p)
                self._crate(over, light, top, state, p, LEFT + x, TOP + y)

    def _crate(self, over: Batch, light: Batch, top: Batch, state: Factory, p: int, x: float, y: float) -> None:
        """Draw pallet p at (x, y), canvas px."""
        pallet = state.pallets[p]
        put(over, contest.crate(pallet, self.pops.tenths(p, self.particles.clock)), x, y)
        contest.mark_rush(light, top, state, pallet, x, y)

    def _people(self, over: Batch, light: Batch, top: Batch, state: Factory, blend: float) -> None:
        for old, new, worker in zip(self.people_before, self.people, state.workers, strict=True):
            x, y = LEFT + old[0] + (new[0] - old[0]) * blend, TOP + old[1] + (new[1] - old[1]) * blend
            working = worker.task == WORKING
            moving = worker.walking or working
            stride = int(self.particles.clock * 7) % crates.STRIDE if moving else 0
            put(over, crates.person(step(worker.heading, crates.PERSON_TURNS), stride, working), x, y)
            if worker.pallet:
                p, c, s = worker.pallet - 1, math.cos(worker.heading), math.sin(worker.heading)
                self._crate(over, light, top, state, p, x + HANDS * c, y + HANDS * s)
            if any(t and load.frozen for t, load in zip(worker.touched, state.loads, strict=True)):
                put(top, crates.exclaim(), x + 26, y - 56)

    def _robot(
        self, under: Batch, over: Batch, light: Batch, top: Batch, state: Factory, seat: int, pose: Pose
    ) -> None:
        x, y, heading = pose
        robot, load, fine = state.robots[seat], state.loads[seat], step(heading, HEADINGS)
        refused = 0 < load.refused <= SHOWN_REFUSED
        if refused and self.options.shake:
            x += 4 * (-1) ** (load.refused // 2)
        self.light_up(under, seat, (x, y, heading), bool(robot.boosting))
        put(over, crates.forks(robot.team, fine, self.scale), x, y)
        put(over, self.body(seat, fine), x, y)
        ahead = state.rules.fork if seat not in self.real else BEFORE
        fork_x, fork_y = x + ahead * math.cos(heading), y + ahead * math.sin(heading)
        if load.pallet:
            self._crate(over, light, top, state, load.pallet - 1, fork_x, fork_y)
        if refused:
            put(top, crates.cross(), fork_x, fork_y)
        if load.frozen:
            part = -(-crates.COUNTS * load.frozen // state.rules.freeze)
            put(light, crates.frozen(part, self.reach(seat, crates.FROZEN)), x, y)
            put(top, crates.digit(-(-load.frozen // HZ)), x, y + (BESIDE if y < TOP + BESIDE else -BESIDE))

    def _counts(self, light: Batch, state: Factory) -> None:
        """Draw the numbers of waiting and delivered pallets, and the time until the next one."""
        for side in range(TEAMS):
            entry, out = state.slots[side * 2 * SHELVES], state.slots[side * 2 * SHELVES + SHELVES]
            waiting = sum(p.exists and p.place == WAITING and p.at == side for p in state.pallets)
            shipped = sum(p.place == SHIPPED and p.at == side for p in state.pallets)
            if waiting:
                put(light, crates.count(waiting, entry.team), _beside(entry), TOP + entry.y - 14)
            if shipped:
                put(light, crates.count(shipped, out.team), _beside(out), TOP + out.y - 14)
            damaged = [
                pallet
                for p, pallet in enumerate(state.pallets)
                if pallet.exists and pallet.state == DAMAGED and side_of(state, p) == side
            ]
            for i, pallet in enumerate(damaged):
                seconds = -(-(state.rules.replace - pallet.waited) // HZ)
                put(light, crates.awaited(seconds), _beside(entry), TOP + entry.y + 3 * 88 - 60 * i)


def _beside(slot: Slot) -> float:
    """Canvas x in the margin beside a warehouse's slot."""
    return LEFT + slot.x + (-150.0 if slot.x < WIDTH / 2 else 150.0)


def _people(state: Factory) -> list[tuple[float, float]]:
    return [(worker.x, worker.y) for worker in state.workers]
