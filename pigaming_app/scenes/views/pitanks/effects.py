"""Particles and sounds for the events of PiTanks."""

from collections.abc import Iterable

from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.particles import Particles
from pigaming_app.scenes.views.pitanks.events import PiTanksEvent
from pigaming_app.scenes.views.view import SoundCue, ViewOptions
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, PLAYERS, WALL
from pigaming_app.ui.i18n import signed

BESIDE, ABOVE = 46.0, 66.0  # px from a robot to its score popup


SOUNDS = {
    "fire": "fire",
    "stopped": "wall",
    "bounced": "wall",
    "crumbled": "crumble",
    "hit": "hit",
    "shielded": "crumble",
    "pickup": "pickup",
    "power_end": "power_end",
    "mine_laid": "power_end",
    "mine_blown": "mine",
    "lit": "missed",
    "finale": "last_lap",
    "overtime": "go",
}


def react(
    events: Iterable[PiTanksEvent], state: PiTanks, particles: Particles, options: ViewOptions, above: float = ABOVE
) -> list[SoundCue]:
    """Add particles for the events; returns their sounds. `above`: px from a robot up to its popups."""
    cues: list[SoundCue] = []
    for event in events:
        _show(event, state, particles, options, above)
        if event.kind in SOUNDS:
            cues.append((SOUNDS[event.kind], event.player, event.x))
    return cues


def _show(event: PiTanksEvent, state: PiTanks, particles: Particles, options: ViewOptions, above: float) -> None:
    x, y, player = LEFT + event.x, TOP + event.y, event.player
    color = ICE if player is None else PLAYERS[player]
    match event.kind:
        case "hit":
            particles.burst(x, y, color, 30, 46, 120)
            _blast(x, y, color, particles, options)
            if state.rules.penalty:
                particles.score(_clamp_x(x) + BESIDE, y - above, signed(-event.number), player or 0)
        case "scored":
            at = _clamp_x(x) - BESIDE if state.rules.penalty else x
            particles.score(at, y - above, signed(event.number), player or 0)
        case "shielded":
            particles.burst(x, y, color, 26, 66, 90)
            particles.burst(x, y, FOCUS, 10, 66, 70)
            if options.flashes != "off":
                particles.shock(x, y, color)
        case "stopped" | "bounced":
            particles.burst(x, y, color, 7 if event.kind == "stopped" else 4, 8, 60, (event.angle, 1.1))
        case "cracked" | "crumbled":
            _break(event, state, particles)
        case "pickup":
            particles.burst(x, y, FOCUS, 16, 46, 60)
        case "mine_blown":
            particles.burst(x, y, ALARM, 24, 16, 130)
            _blast(x, y, color, particles, options)


def _blast(x: float, y: float, color: tuple[int, int, int], particles: Particles, options: ViewOptions) -> None:
    if options.flashes != "off":
        particles.shock(x, y, color)
    if options.flashes == "full":
        particles.glow(x, y, color)
        if options.shake:
            particles.shake()


def _break(event: PiTanksEvent, state: PiTanks, particles: Particles) -> None:
    """Splinters of a wall: a few for a lost cell, many for a collapse."""
    wall = state.walls[event.number]
    ends = LEFT + wall.ax, TOP + wall.ay, LEFT + wall.bx, TOP + wall.by
    particles.debris(*ends, 5 if event.kind == "cracked" else 26)
    if event.kind == "crumbled":
        for i in range(5):
            t = (i + 0.5) / 5
            x, y = ends[0] + (ends[2] - ends[0]) * t, ends[1] + (ends[3] - ends[1]) * t
            particles.burst(x, y, WALL, 5, 10, 70)


def _clamp_x(x: float) -> float:
    """Clamp x so that two score popups fit side by side."""
    return min(max(x, LEFT + 60 + BESIDE), LEFT + WIDTH - 60 - BESIDE)
