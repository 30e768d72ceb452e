"""Lower bounds of the makespan of Robot Factory: the time in which one team, alone on the floor, delivers everything.

`bound` holds for every way to play the rules of the variant standard, without rivals. It is the shortest schedule of a
relaxed problem, found by branch and bound. Each relaxation only removes constraints:

1. *Ways.* A robot uses a slot with its fork at most REACH px from it. The fork is FORK px ahead of the centre, so it
   moves at up to sqrt(v² + (FORK w)²), v = 1.3 x 260 px/s with turbo, w = 3 rad/s. Between the uses of slots D px apart
   the fork covers D - 2 REACH, and the centre at least 2 FORK less, at up to v. So the time is at least

       way(D) = max((D - 2 REACH) / sqrt(v² + (FORK w)²), (D - 2 REACH - 2 FORK) / v).

   Walls, other robots, turning, motor lag and the turbo meter are left out.
2. *Robots.* Only the first way of each pallet, from the entry to a machine A, needs a robot that is there: the k-th
   lift of a raw pallet is not before the k-th in order of all robots' lifts, if each robot does nothing but fetch raw
   pallets by the shortest ways. All other ways begin as soon as the pallet is ready, as if there were a robot for each.
3. *Machines.* A machine processes one pallet at a time, for PROCESS. Slots are always free.
4. *Workers.* A machine needs a worker at its spot from the start to the end of processing. They walk at 130 px/s and
   count as arrived at most ARRIVED_NEAR_ROBOT px from the spot. So a worker who has been at spot p begins at spot q at
   least (|p - q| - 2 x 70 px) / 130 px/s later. A worker who has not worked yet rests at home until the first pallet is
   put into a machine, for workers are sent to work only; so its first work begins at least (|home - q| - 70 px) / 130
   px/s after the earliest time at which any robot could put a pallet anywhere.

Every match obeys 1 to 4: replace each processing of a match by the same machine, worker and time, and all constraints
hold. So the shortest relaxed schedule is no longer than the match. It is found exactly: in some shortest schedule every
processing begins as early as its pallet, machine and worker allow, given those that begin before it (shift it to the
left). So it is enough to try all orders of pallets, machines and workers in which processings begin one after another,
and to cut those that cannot end sooner than the best one known.
"""

from itertools import product
from math import hypot, sqrt
from typing import Any

from pigaming_app.games.arenas import load
from pigaming_app.games.factory.pedestrians import ARRIVED_NEAR_ROBOT
from pigaming_app.games.factory.state import ENTRY, EXIT, INPUT, OUTPUT, A, FactoryRules
from pigaming_app.sim.world import DT

Point = tuple[float, float]


class Floor:
    """Shortest times on a floor for one team, s."""

    def __init__(self, floor: str, team: int, robots: int, pallets: int) -> None:
        arena, self.rules = load("factory", floor), FactoryRules()
        plan, self.pallets = arena.plan, pallets
        entry, leave = ([(s.x, s.y) for s in plan.slots if s.team == team and s.kind == kind] for kind in (ENTRY, EXIT))
        of = {(s.machine, s.kind): (s.x, s.y) for s in plan.slots if s.machine >= 0}
        kinds = [machine.kind for machine in plan.machines]
        self.first = [m for m, kind in enumerate(kinds) if kind == A]
        self.second = [m for m, kind in enumerate(kinds) if kind != A]
        spots = [(machine.spot_x, machine.spot_y) for machine in plan.machines]
        self.process = self.rules.process * DT
        self.bring = {m: self.way([of[m, INPUT]], entry) for m in self.first}
        self.carry = {(a, b): self.way([of[a, OUTPUT]], [of[b, INPUT]]) for a in self.first for b in self.second}
        self.deliver = {m: self.way([of[m, OUTPUT]], leave) for m in self.second}
        self.walk = {(p, q): self.walking(spots[p], spots[q], 2) for p, q in product(range(len(spots)), repeat=2)}
        self.call = [{m: self.walking(home, spots[m], 1) for m in range(len(spots))} for home in plan.homes]
        starts = [(start.x, start.y) for start in arena.starts[team::2]][:robots]
        self.lifts = self.lift_times(starts, entry)
        self.put = self.lifts[0] + min(self.bring.values())

    def way(self, some: list[Point], others: list[Point]) -> float:
        """Least time between the uses of two slots."""
        return self.fork_time(nearest(some, others), 2, 2.0 * self.rules.fork)

    def fork_time(self, distance: float, ends: int, swing: float) -> float:
        """Least time in which a fork that may end REACH px short, at `ends` ends, covers a distance."""
        speed, covered = self.rules.speed * self.rules.turbo_factor, distance - ends * self.rules.reach
        fork = sqrt(speed * speed + (self.rules.fork * self.rules.turn_rate) ** 2)
        return max(0.0, covered / fork, (covered - swing) / speed)

    def walking(self, a: Point, b: Point, ends: int) -> float:
        """Least time of a worker's walk from one place to another."""
        return max(0.0, hypot(a[0] - b[0], a[1] - b[1]) - ends * ARRIVED_NEAR_ROBOT) / self.rules.walk

    def lift_times(self, starts: list[Point], entry: list[Point]) -> list[float]:
        """Earliest times of the first, second, ... lift of a raw pallet."""
        around = 2.0 * min(self.bring.values())
        times = []
        for start in starts:  # the fork is FORK px from the start, so the way is that much shorter at most
            first = self.fork_time(nearest([start], entry) - self.rules.fork, 1, self.rules.fork)
            times += [first + k * around for k in range(self.pallets)]
        return sorted(times)[: self.pallets]


def nearest(some: list[Point], others: list[Point]) -> float:
    """Least distance between two groups of points, px."""
    return min(hypot(x - u, y - v) for (x, y), (u, v) in product(some, others))


class Search:
    """Branch and bound over schedules. A pallet is (machine A, time of its end); a worker (place, free from)."""

    def __init__(self, floor: Floor) -> None:
        self.floor, self.best = floor, float("inf")
        self.least_tail = min(
            floor.carry[a, b] + floor.process + floor.deliver[b] for a in floor.first for b in floor.second
        )
        self.seen: dict[Any, list[tuple[float, ...]]] = {}

    def shortest(self) -> float:
        """The shortest makespan of the relaxed problem, s."""
        machines = tuple(0.0 for _ in range(len(self.floor.first) + len(self.floor.second)))
        workers = tuple((-1 - w, 0.0) for w in range(len(self.floor.call)))
        self.extend(0.0, 0, (), machines, workers, 0.0)
        return self.best

    def extend(
        self,
        now: float,
        begun: int,
        half: tuple[tuple[int, float], ...],
        machines: tuple[float, ...],
        workers: tuple[tuple[int, float], ...],
        end: float,
    ) -> None:
        """Try every processing that could begin next, not before `now`; `begun`: pallets that have left the entry."""
        floor = self.floor
        raw = floor.pallets - begun
        if not raw and not half:
            self.best = min(self.best, end)
            return
        if self.hopeless(now, raw, half, machines, end) or self.dominated(now, begun, half, machines, workers, end):
            return
        options = []
        for m in floor.first if raw else ():
            release = max(floor.lifts[begun] + min(floor.bring.values()), floor.lifts[0] + floor.bring[m])
            options += [(start, m, -1, w) for w, start in self.starts(max(now, release, machines[m]), m, workers)]
        for p, (a, ready) in enumerate(half):
            if p and half[p - 1] == half[p]:
                continue
            for m in floor.second:
                release = ready + floor.carry[a, m]
                options += [(start, m, p, w) for w, start in self.starts(max(now, release, machines[m]), m, workers)]
        for start, m, p, w in sorted(options):
            stop = start + floor.process
            others = tuple(sorted((*workers[:w], (m, stop), *workers[w + 1 :])))
            busy = (*machines[:m], stop, *machines[m + 1 :])
            if p < 0:
                self.extend(start, begun + 1, tuple(sorted((*half, (m, stop)))), busy, others, end)
            else:
                self.extend(start, begun, half[:p] + half[p + 1 :], busy, others, max(end, stop + floor.deliver[m]))

    def starts(self, earliest: float, m: int, workers: tuple[tuple[int, float], ...]) -> list[tuple[int, float]]:
        """When each worker could begin at machine m."""
        found = []
        for w, (place, free) in enumerate(workers):
            there = free + self.floor.walk[place, m] if place >= 0 else self.floor.put + self.floor.call[-1 - place][m]
            found.append((w, max(earliest, there)))
        return found

    def hopeless(
        self, now: float, raw: int, half: tuple[tuple[int, float], ...], machines: tuple[float, ...], end: float
    ) -> bool:
        """True if no schedule from here can be shorter than the best one known."""
        floor = self.floor
        least = end
        for a, ready in half:
            tails = (
                max(now, ready + floor.carry[a, b], machines[b]) + floor.process + floor.deliver[b]
                for b in floor.second
            )
            least = max(least, min(tails))
        if raw:
            free = [max(now, machines[m]) for m in floor.first]
            for _ in range(raw):  # machines A one pallet after another, then the shortest way out
                soonest = free.index(min(free))
                free[soonest] += floor.process
                last = free[soonest]
            least = max(least, last + self.least_tail)
        left = [max(now, machines[b]) for b in floor.second]
        for _ in range(raw + len(half)):
            soonest = left.index(min(left))
            left[soonest] += floor.process
            least = max(least, left[soonest] + min(floor.deliver.values()))
        return least >= self.best - 1e-9

    def dominated(
        self,
        now: float,
        begun: int,
        half: tuple[tuple[int, float], ...],
        machines: tuple[float, ...],
        workers: tuple[tuple[int, float], ...],
        end: float,
    ) -> bool:
        """True if a state with the same pallets and places was tried in which nothing was later."""
        key = begun, tuple(a for a, _ in half), tuple(place for place, _ in workers)
        times = (now, end, *(ready for _, ready in half), *machines, *(free for _, free in workers))
        known = self.seen.setdefault(key, [])
        if any(all(x <= y + 1e-9 for x, y in zip(other, times, strict=True)) for other in known):
            return True
        known.append(times)
        return False


def bound(floor: str, robots: int, pallets: int, team: int = 0) -> float:
    """The lower bound of the makespan for a number of robots and pallets of a team, s."""
    return Search(Floor(floor, team, robots, pallets)).shortest()
