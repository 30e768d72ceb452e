"""The animated lessons of "how to play": each draws one moment of a loop, centred on a point.

They use the sprites of the games. A picture may return the text key of a word to show under it. A game's lessons are
shown in pages of four; PAGES names the rule set of each page, if a game has more than one.
"""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.howto import factory, pitanks, pitanks_party, race

LessonPicture = Callable[[pygame.Surface, float, float, float], str | None]

LESSONS: dict[str, dict[str, LessonPicture]] = {  # by game; the inner keys are text keys of the captions
    "pitanks": {
        "drive": pitanks.drive,
        "shoot": pitanks.shoot,
        "walls": pitanks.walls,
        "pickups": pitanks.pickups,
        "knockout": pitanks_party.knockout,
        "light": pitanks_party.light,
        "bounty": pitanks_party.bounty,
        "finale": pitanks_party.finale,
    },
    "factory": {
        "lift": factory.lift,
        "work": factory.work,
        "deliver": factory.deliver,
        "people": factory.people,
    },
    "race": {
        "laps": race.laps,
        "lines": race.lines,
        "finish": race.finish,
        "mud": race.mud,
    },
}
PAGE = 4  # lessons on a page
PAGES: dict[str, tuple[str, ...]] = {"pitanks": ("plain", "party")}
