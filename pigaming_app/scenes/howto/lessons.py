"""The moving pictures of "how to play": each paints itself round a point for a moment of time, and repeats for ever.

They are made of the very sprites that the games show. A picture may answer the key of a word to put under it.
"""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.howto import factory, pitanks, race

LessonPicture = Callable[[pygame.Surface, float, float, float], str | None]

LESSONS: dict[str, dict[str, LessonPicture]] = {  # by game; the names are those of the texts below the pictures
    "pitanks": {
        "drive": pitanks.drive,
        "shoot": pitanks.shoot,
        "walls": pitanks.walls,
        "pickups": pitanks.pickups,
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
