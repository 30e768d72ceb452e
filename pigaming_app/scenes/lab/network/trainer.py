"""Training of a network for the Lab, used by the page like the table's `Trainer`.

The network learns in a process of its own, from many matches at once. The page shows one more match, which the present
network plays here against the hand-made robot.
"""

import logging
from collections.abc import Mapping
from dataclasses import asdict
from math import ceil, inf
from time import monotonic
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.ai.learning.training import ARENA, GAME, Checkpoint
from pigaming_app.ai.networks.files import TrainedNetwork, TrainingCurve
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.networks.policy import Policy, network_brain
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.ppo.lab.messages import PATIENCE, UNTRAINED, Begin, Habit, Report, State, TrainingOrder, Weights
from pigaming_app.ai.ppo.lab.task import NetworkRecipe
from pigaming_app.ai.reward_quantities import WEIGHTED
from pigaming_app.scenes.brain.rose import PETALS
from pigaming_app.scenes.lab.learning_curve import Measure
from pigaming_app.scenes.lab.network.exhibition import Exhibition
from pigaming_app.scenes.lab.network.process import COMMAND, TrainingProcess
from pigaming_app.scenes.lab.progress import CHECKPOINTS, TrainingState
from pigaming_app.scenes.lab.rewarded import Rewarded
from pigaming_app.scenes.lab.saved_robots import save_network_as
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

PACES = (1.0, 10.0, inf)  # of the training, times real time, by speed
SHOWN = (1, 10, 10)  # of the match that is shown, times real time
MAX_BACKLOG = 4  # frames of ticks to catch up at most; the rest is dropped
FIRST_POINT = 10.0  # s after the start of the process in which it has measured a fresh network
HEARTBEAT = PATIENCE / 4  # s between two orders at most
MISSING = "lab.no_network"  # text key
DEATHS = 3  # ends of the process without a report in between, after which it is not started again

log = logging.getLogger("pigaming")


class NetworkProgress:
    """Progress of one training."""

    def __init__(self, state: State, match: Any, measures: tuple[Measure, ...] = ()) -> None:
        self.measures: list[Measure] = list(measures)
        self.plan: list[Habit | None] = [None] * PETALS
        self.checkpoints: dict[int, Checkpoint] = {}
        self.snapshot = TrainingState(match, 0, int(state.matches), 0.0)
        self._due = [n for n in CHECKPOINTS if n >= state.matches]  # matches of the next checkpoints

    def add(self, report: Report) -> None:
        """Take over a report."""
        self.plan = list(report.habits)
        self.snapshot.matches, self.snapshot.knowing = int(report.state.matches), report.knowing
        if report.share is not None:
            self.measures = [*self.measures, Measure(report.state.matches, report.share)]
        if self._due and report.state.matches >= self._due[0]:
            while self._due and report.state.matches >= self._due[0]:
                self._due.pop(0)
            matches = int(report.state.matches)
            self.checkpoints[matches] = checkpoint(report.state, str(matches))

    def show(self, match: Any) -> None:
        """Publish another state of the match that is shown."""
        now = self.snapshot
        self.snapshot = TrainingState(match, now.number + 1, now.matches, now.knowing)


class NetworkTrainer(Rewarded[NetworkRecipe]):
    """Runs one training. `recipe` and `speed` may be set at any time."""

    arena, fast = ARENA, False  # comparisons here are plain

    def __init__(self, seed: int, compiler: Compiler, command: tuple[str, ...] = COMMAND) -> None:
        """`compiler`: it compiles the loop of the process, which starts afterwards."""
        self._compiler, self._process = compiler, TrainingProcess(command)
        self.recipe, self.speed = NetworkRecipe(), 0
        self.refusal = "" if can_compile() else MISSING  # text key of why no network can learn here
        self.compiling = False  # nothing is learned yet
        self.trouble = ""  # text key of what has happened to the process; the page clears it
        self._deaths = 0
        self._started = 0.0  # when the process was
        self._number = -1  # of the training
        self._sent: tuple[TrainingOrder, float] = TrainingOrder(), 0.0
        self._backlog = 0.0  # ticks
        self._begin(seed, UNTRAINED, ())

    @property
    def snapshot(self) -> TrainingState:
        """The latest snapshot."""
        return self.progress.snapshot

    @property
    def available(self) -> bool:
        """True if networks can learn here."""
        return not self.refusal

    @property
    def fetchable(self) -> bool:
        """True if only what can be fetched is missing."""
        return self.refusal == MISSING

    def enable(self) -> None:
        """Go on with what was fetched meanwhile."""
        if self.fetchable and can_compile():
            self.refusal = ""

    def feed(self, seconds: float) -> None:
        """Called every frame, `seconds` after the last call: keep the training running, and play on."""
        self._backlog = min(self._backlog + seconds * HZ * SHOWN[self.speed], MAX_BACKLOG * SHOWN[self.speed])
        self._exhibition.play(int(self._backlog))
        self._backlog %= 1.0
        self.progress.show(self._exhibition.match)
        if self.available and self._is_running():
            self._take_reports()
            self._order(TrainingOrder(self.recipe, PACES[self.speed]))

    def close(self) -> None:
        """Pause until the next `feed`."""
        self._order(TrainingOrder(self.recipe, 0.0))

    def end(self) -> None:
        """End the process; the next `feed` starts it again where it was."""
        self._process.end()

    def checkpoint(self, name: str) -> Checkpoint:
        """The present network as a named checkpoint."""
        return checkpoint(self._state, name)

    def checkpoints(self) -> dict[int, Checkpoint]:
        """Checkpoints after some numbers of matches, as far as reached."""
        return dict(self.progress.checkpoints)

    @property
    def first_point(self) -> int | None:
        """s until the first point of the win curve, about; None if it is there, or if nobody can tell."""
        if self.progress.measures or not self._process.running:
            return None
        left = FIRST_POINT - (monotonic() - self._started)
        return ceil(left) if left > 0 else None

    def begin(self, seed: int) -> None:
        """Start again with a fresh network."""
        self._begin(seed, UNTRAINED, ())

    def reset(self, seed: int) -> None:
        """Start again as for the first visitor; the process starts anew when it is needed."""
        self.recipe, self.speed = NetworkRecipe(), 0
        self.begin(seed)
        self.end()

    def save(self, name: str) -> None:
        """Save the present network. Raises RobotFileError."""
        save_network_as(self.trained(name), name)

    def trained(self, name: str) -> TrainedNetwork:
        """The present network with the parameters of its training, ready for a file."""
        state = self._state
        rows = tuple((measure.matches, measure.share) for measure in self.progress.measures)
        return TrainedNetwork(
            name=name,
            game=GAME,
            matrices=state.weights.matrices,
            biases=state.weights.biases,
            recipe={**asdict(self.recipe), "matches": state.matches},
            seed=self._seed,
            updates=state.updates,
            decisions=state.decisions,
            curve=TrainingCurve(("matches", "share"), rows),
        )

    def open(self, trained: TrainedNetwork) -> None:
        """Continue with a saved network."""
        known: Mapping[str, Any] = trained.recipe
        weights = {name: float(known.get(name, 0.0)) for name in WEIGHTED}
        self.recipe = NetworkRecipe(**weights, rest=str(known.get("rest", "")))
        matches = float(known.get("matches", 0.0))
        measures = tuple(Measure(*row) for row in trained.curve.rows if len(row) == 2)
        layers = Weights(tuple(trained.matrices), tuple(trained.biases))
        self._begin(trained.seed, State(layers, trained.updates, trained.decisions, matches), measures)

    # ---- inside

    def _begin(self, seed: int, state: State, measures: tuple[Measure, ...]) -> None:
        self._number += 1
        self._seed, self._state = seed, state
        self._exhibition = Exhibition(self.checkpoint("network").kind, seed)
        self.progress = NetworkProgress(state, self._exhibition.match, measures)
        self._send_begin()

    def _send_begin(self) -> None:
        """Have the process continue from the present network."""
        self._process.send(Begin(self._number, self._seed, self._state if self._state.updates else None))
        self._sent = TrainingOrder(), 0.0

    def _is_running(self) -> bool:
        """True if the process runs; starts it, as soon as its loop is compiled."""
        if self._process.running:
            return True
        self.compiling = True
        if self._process.code is not None:
            if self._process.code:
                log.warning("the training of the network ended with exit code %d", self._process.code)
                self._deaths += 1
                self.trouble = "lab.interrupted"
        elif self._compiler.code is None:
            self._compiler.start()
            return False
        elif self._compiler.code:
            self._deaths = DEATHS
        if self._deaths >= DEATHS:
            self._give_up()
            return False
        self._started = monotonic()
        try:
            self._process.start()
        except OSError:
            self._give_up()
            return False
        self._send_begin()
        return True

    def _give_up(self) -> None:
        self.compiling = False
        self.refusal = self.trouble = "lab.failed"

    def _take_reports(self) -> None:
        reports = [report for report in self._process.reports() if report.number == self._number]
        for report in reports:
            self.progress.add(report)
        if reports:
            self.compiling, self._deaths = False, 0
            self._state = reports[-1].state
            self._exhibition.replace_brain(self.checkpoint("network").kind)

    def _order(self, order: TrainingOrder) -> None:
        """Send an order if it is another one, or if the last one will soon be void."""
        last, at = self._sent
        if order != last or (order.pace and monotonic() - at > HEARTBEAT):
            self._process.send(order)
            self._sent = order, monotonic()


def checkpoint(state: State, name: str) -> Checkpoint:
    """A network as a named checkpoint."""
    kind: BrainKind = network_brain(name, ENCODINGS[GAME], Policy(Layers(*state.weights)))
    return Checkpoint(kind, int(state.matches), state.decisions)
