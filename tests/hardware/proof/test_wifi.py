"""Wi-Fi robots that run their own program in MicroPython, over a network that loses 5 %; skipped without Node.js."""

import pytest

from pigaming_app.games.registry import games
from pigaming_app.hardware.proof.emergencies import wifi_faults
from pigaming_app.jobs.bench import robots_arcade
from pigaming_app.jobs.bench.robots import TARGETS
from pigaming_app.jobs.bench.wifi import play
from pigaming_app.storage.plugins.parts import plugins
from tests.cases import repeated

pytestmark = [pytest.mark.long(first=True), pytest.mark.usefixtures("micropython")]
LONGEST = TARGETS["wifi_worst_stop_ms"] / 1e3  # s
ADDED = [plugin.name for plugin in plugins()]


@pytest.mark.again  # pairing: before the match; faults: bench robots
def test_every_fault_stops_the_motors_of_boards_that_were_paired():
    stops = wifi_faults(1)
    assert len(stops) == 7
    assert max(stops.values()) <= LONGEST


@pytest.mark.parametrize("game", repeated(game for game in games() if game not in ADDED))
def test_robots_are_paired_and_a_whole_match_is_played_to_its_end(game):
    run = play(game, 3, 0.2, paired=game == "pitanks")
    assert run.seconds - run.paused >= 12.0
    assert run.deepest_mm < TARGETS["wall_entry_mm"]
    assert not run.alarms


@pytest.mark.again  # also in bench robots
@pytest.mark.alone
def test_boards_stop_when_the_whole_arcade_is_stopped_or_killed():
    stops = robots_arcade.by_wifi(print)
    assert stops.keys() == {"Wi-Fi, SIGSTOP", "Wi-Fi, kill -9"}
    assert min(stops.values()) > 0.1, "they ran on until their own timers stopped them"
    assert max(stops.values()) <= LONGEST
