"""What is noted in the ledger: matches, high scores and events as the screens show them, between two frames."""

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict

from pigaming_app.games.rounds import Rounds
from pigaming_app.jobs.bench.memory import resident_mb
from pigaming_app.scenes.app import App
from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.events.next_page import EventMatch
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.kiosk.operator.group_limit import FAREWELL
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.initials import Initials
from pigaming_app.scenes.title.scene import Title
from tests.bench.open_day.audit import table_key
from tests.bench.open_day.ledger import LedgerFile
from tests.bench.open_day.plan import Day, Group
from tests.scenes.arcade import service_of

LONGEST_STAY = 1.0  # s that a group may stay beyond its limit and the farewell


class Watch:
    """Call `look` between two frames. `life`: number of this run of the arcade."""

    def __init__(self, app: App, day: Day, ledger: LedgerFile, life: int) -> None:
        self.app, self.day, self.ledger, self.life = app, day, ledger, life
        self.numbers = Counter[str]()
        self.games: set[str] = set()  # that were played in this run
        self.match: MatchScene | None = None  # on the stack
        self.name = ""  # of that match in the ledger
        self.over = False
        self.entry: Initials | None = None
        self.entry_name = ""
        self.before: object = None  # the top scene of the last frame
        self.farewell = False
        self.played = Counter[int]()  # matches by group, of this run
        self.seated: set[int] = set()  # visitors who have played, by number
        ledger.note("life", life=life)

    def look(self, seconds: float, group: Group | None, visitors: Callable[[MatchScene], list[int]]) -> None:
        """Note what has happened. `seconds`: since the opening; `group`: on the stage; `visitors`: of a match."""
        scenes = self.app.stack.scenes
        top = scenes[-1] if scenes else None
        self._matches(group, visitors)
        self._entries(top)
        if isinstance(top, Attract) and not isinstance(self.before, Attract):
            self.count("attract")
        if isinstance(top, Title) and isinstance(self.before, Title):
            self._quiet(seconds, top)
        self._limit()
        self.before = top

    @property
    def pending(self) -> bool:
        """True while a match or the entry of initials is on the stack."""
        return self.match is not None or self.entry is not None

    def count(self, name: str) -> None:
        """Count something that happened."""
        self.ledger.note("count", name=name)

    def trouble(self, text: str) -> None:
        """Note what must not happen."""
        self.ledger.note("trouble", text=text)

    def memory(self, seconds: float) -> None:
        """Note the resident memory."""
        self.ledger.note("memory", life=self.life, at=round(seconds), mb=resident_mb(), games=len(self.games))

    # ---- inside

    def _next(self, what: str) -> str:
        self.numbers[what] += 1
        return f"{self.life}.{self.numbers[what]}"

    def _matches(self, group: Group | None, visitors: Callable[[MatchScene], list[int]]) -> None:
        here = next((scene for scene in self.app.stack.scenes if isinstance(scene, MatchScene)), None)
        if self.match is not None and here is not self.match:
            self._gone(self.match)
            self.match = None
        if here is not None and self.match is None and here.match.state.tick > 0:
            self.match, self.name, self.over = here, self._next("match"), False
            self.games.add(here.setup.game)
            self.ledger.note("playing", match=self.name)
        if self.match is not None and self.match.match.over and not self.over:
            self.over = True
            if decides(self.match):
                self._ended(self.match, group, visitors(self.match))

    def _gone(self, match: MatchScene) -> None:
        """The page of a match is gone: its result is counted by now."""
        if not match.match.over:
            self.ledger.note("left", match=self.name)
        else:
            self.ledger.note("settled" if decided(match) else "round", match=self.name)

    def _ended(self, scene: MatchScene, group: Group | None, visitors: list[int]) -> None:
        """Note a result, before the arcade has counted it. The fixture is an argument of the page that follows."""
        state, event = scene.match.state, {}
        if isinstance(scene.after, EventMatch):
            running, fixture = scene.after.running, scene.after.fixture
            scores = {name: float(state.robots[seat].score) for seat, name in enumerate(fixture.entrants)}
            visitors = [one.number for one in group.visitors if one.initials in fixture.entrants] if group else []
            event = {"event": str(running.path), "fixture": fixture.number, "extra": fixture.extra, "scores": scores}
        earlier = scene.rounds.outcomes if scene.rounds else []
        people = len(scene.drivers.people)
        if group:
            self.played[group.number] += 1
            self.seated.update(visitors)
            self.count(f"matches in {self.app.context.words.language}")
        self.ledger.note(
            "over",
            match=self.name,
            game=scene.setup.game,
            began=scene.sequel.began.isoformat(timespec="seconds"),
            seconds=round(sum(outcome.seconds for outcome in earlier) + scene.match.seconds, 2),
            people=people,
            ais=sum(robot.present for robot in state.robots) - people,
            group=group.number if group else -1,
            visitors=visitors,
            **{"event": "", "fixture": 0, "extra": 0, "scores": {}, **event},
        )

    def _entries(self, top: object) -> None:
        if self.entry is not None and top is not self.entry:
            signed = [
                (table_key(asdict(table)), value, initials)
                for claim in self.entry.claims
                if (initials := self.entry.spellings[claim.device].taken)
                for table, value in claim.achievements
            ]
            self.ledger.note("entered", entry=self.entry_name, rows=signed)
            self.entry = None
        if isinstance(top, Initials) and self.entry is None:
            self.entry, self.entry_name = top, self._next("entry")
            rows = [(table_key(asdict(table)), value) for claim in top.claims for table, value in claim.achievements]
            self.ledger.note("asked", entry=self.entry_name, rows=rows)

    def _quiet(self, seconds: float, title: Title) -> None:
        now = self.day.times.wall(seconds)
        quiet = self.day.quiet(now)
        if title.music != (not quiet) and quiet == self.day.quiet(self.day.times.wall(seconds - 1.0)):
            self.trouble(f"{now}: music {title.music} on the title")
        if quiet and not isinstance(self.before, Title):
            self.count("titles in quiet hours")

    def _limit(self) -> None:
        limit = service_of(self.app, OperatorDesk).limit
        if self.farewell and limit.farewell is None and len(self.app.stack.scenes) == 1:
            self.count("groups at their limit")
        self.farewell = limit.farewell is not None
        if limit.farewell is not None and not -LONGEST_STAY <= limit.farewell <= FAREWELL:
            self.trouble(f"a group stays {-limit.farewell:.0f} s after its farewell")


def decides(scene: MatchScene) -> bool:
    """True for the last round of a match that is over, before this round has been added to the others."""
    if scene.rounds is None:
        return True
    if scene.ending.begun:
        return scene.rounds.done
    after = Rounds(scene.rounds.best_of)
    after.outcomes = [*scene.rounds.outcomes, scene.match.outcome()]
    return after.done


def decided(scene: MatchScene) -> bool:
    """True for the last round of a match that is over."""
    return scene.rounds is None or scene.rounds.done
