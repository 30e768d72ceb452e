"""Modules that the preloader imports while the title is shown, in the order in which they may be needed."""

MODULES = (
    "numpy",
    "pigaming_app.scenes.lobby.scene",
    "pigaming_app.scenes.play.scene",
    "pigaming_app.scenes.views.race.mud",
    "pigaming_app.scenes.robots.start_match",
    "pigaming_app.scenes.options.page",
    "pigaming_app.scenes.options.controls_test",
    "pigaming_app.scenes.title.attract",
    "pigaming_app.scenes.replays.page",
    "pigaming_app.scenes.lab.scene",
    "pigaming_app.scenes.lab.menu",
    "pigaming_app.scenes.lab.name_page",
    "pigaming_app.scenes.lab.open_page",
    "pigaming_app.scenes.lab.compare_page",
    "pigaming_app.scenes.lab.challenge",
    "pigaming_app.scenes.robots.menu",
    "pigaming_app.scenes.calibration.drift_page",
    "pigaming_app.scenes.calibration.setup_page",
    "pigaming_app.scenes.calibration.corner_pin_page",
    "pigaming_app.scenes.robots.fleet_page",
)
