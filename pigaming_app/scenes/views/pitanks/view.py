"""View of PiTanks: walls, robots, bullets, items on the floor, and effects."""

import math

from pigaming_app.games.pitanks.scoring import is_finale
from pigaming_app.games.pitanks.state import OWN_BULLETS, OWN_MINES, POWERS, SHIELD, SPEED, PiTanks
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.pitanks.effects import ABOVE, react
from pigaming_app.scenes.views.pitanks.events import PiTanksEventDetector
from pigaming_app.scenes.views.pitanks.hud import PiTanksHud
from pigaming_app.scenes.views.pitanks.prewarm import jobs
from pigaming_app.scenes.views.rumble import BLOCKED, GIVEN, PICKED, TAKEN, rumbles
from pigaming_app.scenes.views.simple import SimpleView
from pigaming_app.scenes.views.sprites import effects, party
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.view import REAL_WIDER, Pose, SoundCue, ViewOptions
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT, HEIGHT, HZ, WIDTH
from pigaming_app.ui.draw import FOCUS, THIN
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step
from pigaming_app.ui.i18n import Words

FLASH = 0.06  # s
BLINK = 9  # ticks for which an ending shield is away, then there: less than three blinks a second
ENDING = 2 * HZ  # remaining ticks from which a shield blinks
BOUNTY = 84  # px from a robot to its bounty
MUZZLE = 70.0  # px from a robot to the centre of its muzzle flash

RUMBLES = {"hit": TAKEN, "scored": GIVEN, "shielded": BLOCKED, "pickup": PICKED}  # by kind of event


class PiTanksView(SimpleView):
    """The view of one match of PiTanks."""

    def __init__(
        self, arena: Arena, state: PiTanks, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        super().__init__(arena, state, players, options, words)
        self.detector = PiTanksEventDetector(state)
        self.flashed = [-1.0] * len(state.robots)
        self.shots = [(bullet.x, bullet.y) for bullet in state.bullets]
        self.flying = [0] * len(state.bullets)
        self.add_prewarm_jobs(jobs(state, len(arena.walls), self.seats))
        self.marked = [slot.seat for event in self.hud.sums for slot in event.mates]
        self.first_team = self.hud.sums[0].team if self.hud.sums else 0

    def make_hud(self, state: PiTanks) -> PiTanksHud:
        return PiTanksHud(self.background, state, self.players, self.words)

    def watch(self, state: PiTanks) -> list[SoundCue]:
        self.record_poses(state)
        for i, bullet in enumerate(state.bullets):
            was = self.detector.shots[i]
            fresh = not was.alive
            self.shots[i] = (bullet.x - bullet.vx * DT, bullet.y - bullet.vy * DT) if fresh else (was.x, was.y)
            self.flying[i] = bullet.alive
        events = self.detector.detect(state)
        for event in events:
            if event.kind == "fire" and event.player is not None:
                self.flashed[event.player] = self.particles.clock
        self.rumbles = rumbles(RUMBLES, ((event.kind, event.player) for event in events))
        above = ABOVE + REAL_WIDER if self.real else ABOVE
        return react(events, state, self.particles, self.options, above)

    def marks(self, under: Batch, over: Batch, state: PiTanks, blend: float) -> None:
        """Pickups, mines, and the lights on robots that stay."""
        rules = state.rules
        for pickup in state.pickups:
            if pickup.alive:
                put(over, things.pickup(POWERS[pickup.kind]), LEFT + pickup.x, TOP + pickup.y)
        for i, mine in enumerate(state.mines):
            if mine.alive:
                armed = mine.age >= rules.mine_arming and mine.age // 12 % 2 == 0
                put(over, things.mine(i // OWN_MINES, armed), LEFT + mine.x, TOP + mine.y)
        for seat in self.seats:
            held = state.tanks[seat]
            if held.lit or (rules.camping and held.camped > rules.camping - HZ):
                put(under, party.spotlight() if held.lit else party.stage(), LEFT + held.camp_x, TOP + held.camp_y)

    def draw_robot(self, under: Batch, over: Batch, light: Batch, state: PiTanks, seat: int, pose: Pose) -> None:
        x, y, heading = pose
        now, driven, held = self.particles.clock, state.robots[seat], state.tanks[seat]
        out = held.knocked_out / state.rules.knockout if held.knocked_out else 0.0
        spin = math.tau * out * out if seat not in self.real else 0.0
        coarse, fine = step(heading, effects.TURNS), step(heading + spin, HEADINGS)
        self.light_up(under, seat, pose, bool(driven.boosting or (held.powers[SPEED] and abs(driven.linear) > 40.0)))
        if seat in self.marked:
            put(under, tank.team_mark(int(driven.team != self.first_team), coarse, self.scale), x, y)
        blinks = held.protected and not held.knocked_out and self.options.flashes != "off"
        here = not blinks or held.protected // 4 % 2 == 0
        put(over, self.body(seat, fine) if here else tank.ghost(seat, self.scale), x, y)
        self._powers(light, state, seat, x, y)
        if held.knocked_out:
            turn = int(now * 40) % party.STAR_TURNS
            put(light, party.stars(turn, self.reach(seat, party.STAR_R)), x, y)
        elif size := state.rules.magazine:
            left = size + -held.spent // state.rules.loading
            put(light, effects.magazine(seat, left, size, self.reach(seat, effects.MAGAZINE_R)), x, y)
        if now - self.flashed[seat] < FLASH and self.options.flashes != "off":
            flash = effects.flash(seat, coarse)
            muzzle = MUZZLE * self.scale
            put(light, flash, x + muzzle * math.cos(heading), y + muzzle * math.sin(heading))

    def above(self, light: Batch, top: Batch, state: PiTanks, blend: float) -> None:
        """Bullets, the time that pickups stay, and bounties."""
        for pickup in state.pickups:
            if pickup.alive:
                left = -(-48 * pickup.alive // max(1, state.rules.pickup_life))
                put(light, effects.timer_ring(FOCUS, left, 56), LEFT + pickup.x, TOP + pickup.y)
        self._bullets(light, state, blend)
        for seat in self.seats:
            if bounty := state.tanks[seat].bounty:
                x, y, heading = self.pose(seat, blend)
                below = self.reach(seat, BOUNTY)  # popups rise above
                trailed = seat in self.real and math.sin(heading) < 0.0  # by its badge
                points = (1 + bounty) * (2 if is_finale(state) else 1)
                x = min(max(x, LEFT + 84), LEFT + WIDTH - 84)
                put(top, party.bounty(points), x, y - below if trailed or y + below > TOP + HEIGHT - 44 else y + below)

    def _powers(self, light: Batch, state: PiTanks, seat: int, x: float, y: float) -> None:
        """Draw a timer ring for the power that ends first (the HUD names it). A shield is drawn itself, and blinks at
        the end.
        """
        powers = state.tanks[seat].powers
        ends = min((left for left in powers if left), default=0)
        if ends:
            put(
                light,
                effects.timer_ring(FOCUS, -(-48 * ends // max(1, state.rules.power_life)), self.reach(seat, 52), THIN),
                x,
                y,
            )
        left = powers[SHIELD]
        if left > ENDING or left // BLINK % 2:
            put(light, effects.shield(seat, int(self.particles.clock * 24) % 24, self.reach(seat, 72)), x, y)

    def _bullets(self, light: Batch, state: PiTanks, blend: float) -> None:
        for i, flying in enumerate(self.flying):
            if flying:
                bullet, (x, y) = state.bullets[i], self.shots[i]
                sprite = effects.bullet(i // OWN_BULLETS, step(math.atan2(bullet.vy, bullet.vx), HEADINGS))
                put(light, sprite, LEFT + x + (bullet.x - x) * blend, TOP + y + (bullet.y - y) * blend)
