"""View of Robot Factory: robots with forks, crates, running machines, people."""

import math
from functools import partial
from typing import Any

import pygame

from pigaming_app.games.factory.state import (
    DAMAGED,
    DONE,
    FORK,
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
)
from pigaming_app.scenes.views.background import LEFT, TOP, Background
from pigaming_app.scenes.views.factory.background import bare
from pigaming_app.scenes.views.factory.effects import CratePops, react
from pigaming_app.scenes.views.factory.events import FactoryEventDetector, spot
from pigaming_app.scenes.views.factory.hud import FactoryHud, pulse
from pigaming_app.scenes.views.factory.hud import X as PANELS
from pigaming_app.scenes.views.factory.hud import Y as TOP_OF_PANELS
from pigaming_app.scenes.views.factory.next_step import NextStepGuide
from pigaming_app.scenes.views.factory.prewarm import jobs
from pigaming_app.scenes.views.rumble import rumbles
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.view import MatchView, Pose, SoundCue, ViewOptions
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step
from pigaming_app.ui.i18n import Words

SHOWN_REFUSED = 14  # ticks for which a cross marks a refused action
HANDS = 40.0  # px from a worker to its load
BEFORE = 124.0  # px from a real robot, in its wide disc, to its load
BESIDE = 102.0  # px from a robot to its countdown


class FactoryView(MatchView):
    """The view of one match of Robot Factory."""

    def __init__(
        self, arena: Arena, state: Factory, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        super().__init__(state, players, options, words, Background(partial(bare, arena.plan)))
        self.hud = FactoryHud(self.background, players)
        self.detector = FactoryEventDetector(state)
        self.guide = NextStepGuide(players)
        self.pops = CratePops()
        self.people = self.people_before = _people(state)
        self.add_prewarm_jobs(self.hud.jobs())
        self.add_prewarm_jobs(jobs(self.seats))

    def watch(self, state: Factory) -> list[SoundCue]:
        self.record_poses(state)
        self.people_before, self.people = self.people, _people(state)
        self.guide.update(state)
        events = self.detector.detect(state)
        self.rumbles = rumbles("factory", ((event.kind, event.player) for event in events))
        return react(events, state, self.particles, self.pops, self.options)

    def draw(self, screen: pygame.Surface, state: Factory, blend: float, seconds: float) -> None:
        self.particles.advance(seconds)
        for team in self.hud.show(state):
            if self.options.flashes != "off":
                self.particles.bloom(PANELS[team], TOP_OF_PANELS, 0.4, pulse(team))
        under: Batch = []
        over: Batch = []
        light: Batch = []
        top: Batch = []
        poses = {seat: self.pose(seat, blend) for seat in self.seats}
        self._machines(over, light, state)
        self._crates(over, state)
        self._people(over, top, state, blend)
        for seat, pose in poses.items():
            self._robot(under, over, light, top, state, seat, pose)
            self.guide.draw(light, state, seat, pose, self.particles.clock)
        self._counts(light, state)
        self.particles.draw_light(light)
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

    def _crates(self, over: Batch, state: Factory) -> None:
        """Draw the crates in slots; carried ones are drawn with their carrier."""
        for p in range(PALLETS):
            pallet = state.pallets[p]
            if pallet.exists and pallet.place == IN_SLOT:
                x, y = spot(state, p)
                put(over, self._crate(p, pallet), LEFT + x, TOP + y)

    def _crate(self, p: int, pallet: Any) -> Any:
        return crates.crate(pallet.team, pallet.state, self.pops.tenths(p, self.particles.clock))

    def _people(self, over: Batch, top: Batch, state: Factory, blend: float) -> None:
        for old, new, worker in zip(self.people_before, self.people, state.workers, strict=True):
            x, y = LEFT + old[0] + (new[0] - old[0]) * blend, TOP + old[1] + (new[1] - old[1]) * blend
            working = worker.task == WORKING
            moving = worker.walking or working
            stride = int(self.particles.clock * 7) % crates.STRIDE if moving else 0
            put(over, crates.person(step(worker.heading, crates.PERSON_TURNS), stride, working), x, y)
            if worker.pallet:
                p, c, s = worker.pallet - 1, math.cos(worker.heading), math.sin(worker.heading)
                put(over, self._crate(p, state.pallets[p]), x + HANDS * c, y + HANDS * s)
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
        put(over, crates.forks(robot.team, fine), x, y)
        put(over, tank.tank(seat, fine), x, y)
        ahead = FORK if seat not in self.real else BEFORE
        fork_x, fork_y = x + ahead * math.cos(heading), y + ahead * math.sin(heading)
        if load.pallet:
            put(over, self._crate(load.pallet - 1, state.pallets[load.pallet - 1]), fork_x, fork_y)
        if refused:
            put(top, crates.cross(), fork_x, fork_y)
        if load.frozen:
            part = -(-crates.COUNTS * load.frozen // state.rules.freeze)
            put(light, crates.frozen(part, self.reach(seat, 54)), x, y)
            put(top, crates.digit(-(-load.frozen // HZ)), x, y + (BESIDE if y < TOP + BESIDE else -BESIDE))

    def _counts(self, light: Batch, state: Factory) -> None:
        """Draw the numbers of waiting and delivered pallets, and the time until the next one."""
        for team in range(TEAMS):
            entry = state.slots[team * 2 * SHELVES]
            left = entry.x < 800
            waiting = sum(pallet.place == WAITING and pallet.team == team and pallet.exists for pallet in state.pallets)
            shipped = sum(pallet.place == SHIPPED and pallet.team == team for pallet in state.pallets)
            gate = LEFT + entry.x + (-150 if left else 150)
            if waiting:
                put(light, crates.count(waiting, team), gate, TOP + entry.y - 14)
            if shipped:
                out = state.slots[team * 2 * SHELVES + SHELVES]
                put(light, crates.count(shipped, team), LEFT + out.x + (-150 if out.x < 800 else 150), TOP + out.y - 14)
            damaged = [
                pallet for pallet in state.pallets if pallet.exists and pallet.team == team and pallet.state == DAMAGED
            ]
            for i, pallet in enumerate(damaged):
                seconds = -(-(state.rules.replace - pallet.waited) // HZ)
                put(light, crates.awaited(seconds), gate, TOP + entry.y + 3 * 88 - 60 * i)


def _people(state: Factory) -> list[tuple[float, float]]:
    return [(worker.x, worker.y) for worker in state.workers]
