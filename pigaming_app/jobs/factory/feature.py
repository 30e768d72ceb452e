"""Robot Factory as a feature: the arcade, its events and climbs go on without this game."""

from pigaming_app.scenes.features.feature import Feature

FEATURE = Feature(
    "factory",
    rooms=(
        *("games.factory", "jobs.factory", "ai.factory", "ai.networks.factory", "ai.networks.factory_targets"),
        "ai.networks.factory_progress",
        *("scenes.views.factory", "scenes.views.games.factory"),
        *("scenes.views.sprites.factory", "scenes.views.sprites.factory_signs"),
    ),
)
