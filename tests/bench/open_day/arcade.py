"""The arcade of a day with its visitors in it: `python -m tests.bench.open_day.arcade FOLDER`, under a supervisor.

Simulated time runs as fast as the machine permits; only every DRAWN-th frame of a scene is drawn, and its first one.
"""

import json
import os
import sys
import traceback
from dataclasses import replace
from pathlib import Path
from time import sleep
from typing import Any

from tests.bench.open_day import clock as day_clock

STEP = 0.08  # s of a frame: as many ticks as the arcade plays in one
IDLE_STEP = 0.32  # s of a frame while nobody is there: attract mode then shows a quarter of its ticks
DRAWN = 25
SLICE = 0.2  # s of the processor
RESTART = 15.0  # s of the day that a kill and a restart take
PHONE_PAUSE = 0.004  # s of real time a frame with phones on the stage: they live in real time
PORT = "PIGAMING_TEST_PHONES"  # variable of the environment


def main(folder: Path) -> int:
    """Run the arcade until the day is over. Returns its exit code."""
    clock, wishes = day_clock.DayClock(folder / "clock"), json.loads((folder / "day.json").read_text(encoding="utf-8"))
    day_clock.install(clock, day_clock.Times(**wishes["times"]))

    from pigaming_app.jobs.terminal import supervised as child
    from pigaming_app.scenes.app import App
    from pigaming_app.scenes.events.next_page import NextMatch
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.phones.feature import PhoneService
    from pigaming_app.scenes.play.scene import MatchScene
    from pigaming_app.scenes.results.awards.moment import AwardsMoment
    from pigaming_app.scenes.results.initials import Initials
    from pigaming_app.scenes.results.scene import Results
    from pigaming_app.scenes.results.winner import WinnersMoment
    from pigaming_app.scenes.start import opened
    from pigaming_app.scenes.title.scene import Title
    from tests.bench.open_day import ledger as ledgers
    from tests.bench.open_day.event_visit import EventVisit
    from tests.bench.open_day.hands import PhoneHands
    from tests.bench.open_day.stage import Stage
    from tests.bench.open_day.visit import Visit
    from tests.bench.open_day.watch import Watch
    from tests.bench.open_day.week import days_of
    from tests.scenes.arcade import service_of

    day = days_of(**wishes["days"])[wishes["day"]]
    day = day.second if wishes["second"] and day.second else day
    seen = ledgers.read(folder / "ledger")
    begin = clock.seconds + (RESTART if seen.lives else 0.0)
    clock.write(begin, os.getpid(), "other", 0)
    crew: list[tuple[App, Watch, Stage]] = []
    frames, now = 0, begin

    def place(top: Any) -> str:
        if isinstance(top, MatchScene):
            if top.match.over:
                return "ending" if top.after else "results"
            return "other" if not top.match.state.tick else "event" if top.after else "match"
        following = top
        while isinstance(following, WinnersMoment | AwardsMoment):
            following = following.then
        if following is not top and isinstance(following, NextMatch):
            return "ending"
        return "results" if isinstance(top, Initials | Results) else "title" if isinstance(top, Title) else "other"

    def over() -> bool:
        try:
            return after_frame()
        except Exception:  # of the script, which would count as a failure of the screen
            crew[0][1].trouble(traceback.format_exc())
            raise SystemExit(0) from None

    def after_frame() -> bool:
        nonlocal frames, now
        frames += 1
        app, watch, stage = crew[0]
        now += app.options.step or 0.0
        watch.look(now, stage.group, stage.visitors)
        clock.write(now, os.getpid(), place(app.stack.scenes[-1] if app.stack.scenes else None), frames)
        stage.play(now)
        if stage.school_class or any(isinstance(player.hands, PhoneHands) for player in stage.players):
            sleep(PHONE_PAUSE)
        app.options = replace(app.options, step=STEP if stage.busy else IDLE_STEP)
        return now >= day.seconds and not stage.busy and not watch.pending

    phones = {"pin_asked": True, "phones": True, "phones_network": "127.0.0.1", "phones_port": int(os.environ[PORT])}
    options = Options(
        headless=True,
        kiosk=True,
        step=STEP,
        should_close=over,
        heartbeat=child.heartbeat(),
        changed_settings=phones,  # in each run, as a supervisor starts the same command again
    )
    with opened(options) as app:
        link = service_of(app, PhoneService).link
        link.host.roster.clock = link._clock = lambda: clock.seconds
        draw_rarely(app)
        preload(app.context.preloader)
        file = ledgers.LedgerFile(folder / "ledger")
        watch = Watch(app, day, file, seen.lives + 1)
        stage = Stage(app, day, seen, watch, begin, folder)
        Visit(stage)
        EventVisit(stage)
        crew.append((app, watch, stage))
        try:
            return app.loop()
        finally:
            stage.close()
            file.close()


def preload(preloader: Any) -> None:
    """Load what the title loads in the background in real time only. The compilers of the Lab are not needed."""
    preloader.on_done = lambda: None
    preloader.start()
    while preloader.busy:
        sleep(0.01)


def draw_rarely(app: Any) -> None:
    """Draw the first frame of each scene, and then every DRAWN-th; the others count as unfinished pictures.

    A first picture takes up to 3 s of the processor in one go, as time is simulated; the supervisor gets its signs of
    life meanwhile, as from pictures in slices.
    """
    from pigaming_app.ui.draw.frame_budget import Unfinished, budget
    from pigaming_app.ui.draw.frame_budget import clock as processor_time

    paint, last, since = app._paint, None, 0

    def finished() -> bool:
        try:
            with budget.until(processor_time() + SLICE):
                app.stack.top.draw(app.context.canvas.screen)
        except Unfinished:
            app.context.canvas.screen.set_clip(None)
            app.pulse.beat(app.context.canvas.screen)
            return False
        return True

    def paint_rarely(cpu_start: float) -> bool:
        nonlocal last, since
        since += 1
        if app.stack.top is last and since < DRAWN:
            return False
        while app.pulse and app.stack.top is not last and not finished():
            pass
        last, since = app.stack.top, 0
        return bool(paint(cpu_start))

    app._paint = paint_rarely


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
