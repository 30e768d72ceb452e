"""The animated lessons of "how to play": each draws one moment of a loop, centred on a point.

They use the sprites of the games. A picture may return the text key of a word to show under it. A game's lessons are
shown in pages of four; PAGES names the rule set of each page, if a game has more than one.
"""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.howto import factory, factory_party, factory_together, pitanks, pitanks_party, race, race_party

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
        "rush": factory_party.rush,
        "loose": factory_party.loose,
        "claim": factory_party.claim,
        "fast": factory_party.fast,
        "allies": factory_together.allies,
        "stars": factory_together.stars,
        "tasks": factory_together.tasks,
        "clear": factory_together.clear,
    },
    "race": {
        "laps": race.laps,
        "lines": race.lines,
        "finish": race.finish,
        "mud": race.mud,
        "draft": race_party.draft,
        "pads": race_party.pads,
        "items": race_party.items,
        "recover": race_party.recover,
    },
}
PAGE = 4  # lessons on a page
PAGES: dict[str, tuple[str, ...]] = {
    "pitanks": ("plain", "party"),
    "factory": ("standard", "party", "together"),
    "race": ("standard", "party"),
}
