"""Robot Race as a feature: the arcade, its events and climbs go on without this game."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature(
    "race",
    rooms=(
        *("games.race", "jobs.race", "ai.race", "ai.networks.race"),
        *("scenes.views.race", "scenes.views.games.race"),
    ),
)
