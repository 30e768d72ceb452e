"""Robot Factory: machines and the workers who operate them.

A resting worker is sent to a machine that has work: a suitable pallet in the input while the output is free, or a
processed pallet that its owner has not collected in time, which the worker carries to the owner's entry. A worker
without progress gives up: another resting worker is sent, and other machines take precedence.
"""

from pigaming_app.games.factory.pallets import first_slot, free_shelf, move, side_of
from pigaming_app.games.factory.pedestrians import send, turn_towards, walk
from pigaming_app.games.factory.state import (
    BY_WORKER,
    CARRYING,
    DONE,
    ENTRY,
    FETCHING,
    GOING,
    HALF,
    IN_MACHINE,
    IN_SLOT,
    MACHINE_SLOTS,
    MACHINES,
    RAW,
    RESTING,
    WAITING,
    WORKERS,
    WORKING,
    A,
    Factory,
    Machine,
    Slot,
    Worker,
)
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import WIDTH

BESIDE = 96.0  # px from a slot at which a worker stands to pick up or put down


@kernel
def fits(kind: int, state: int) -> bool:
    """True if a machine of this kind can process a pallet in this state."""
    return bool(state == (RAW if kind == A else HALF))


@kernel
def run_machines_and_workers(match: Factory) -> None:
    """One tick of all machines and workers."""
    for m in range(MACHINES):
        run_machine(match, m)
    call_worker(match)
    for w in range(WORKERS):
        run_worker(match, w)


@kernel
def run_machine(match: Factory, m: int) -> None:
    """One tick of processing; a finished pallet moves to the output, which was reserved for it."""
    machine = match.machines[m]
    if not machine.pallet and match.slots[MACHINE_SLOTS + 2 * m].pallet and has_work(match, m):
        machine.stalled += 1
    elif machine.stalled:
        machine.stalled -= 1
    if machine.fast and has_work(match, m):
        process(match, m)
    if not machine.pallet:
        if not match.slots[MACHINE_SLOTS + 2 * m + 1].pallet:
            machine.reserved = 0
        return
    machine.left -= 1
    if machine.left > 0:
        return
    p = machine.pallet - 1
    pallet = match.pallets[p]
    pallet.state = HALF if machine.kind == A else DONE
    pallet.steps += 1
    match.loads[pallet.fed - 1].steps += 1
    move(match, p, IN_SLOT, MACHINE_SLOTS + 2 * m + 1)


@kernel
def has_work(match: Factory, m: int) -> bool:
    """True if a machine can start processing the pallet in its input."""
    machine = match.machines[m]
    p, output = match.slots[MACHINE_SLOTS + 2 * m].pallet, match.slots[MACHINE_SLOTS + 2 * m + 1].pallet
    return bool(p and not output and not machine.pallet and fits(machine.kind, match.pallets[p - 1].state))


@kernel
def is_overdue(match: Factory, m: int) -> bool:
    """True if a processed pallet has waited too long in a machine's output."""
    p = match.slots[MACHINE_SLOTS + 2 * m + 1].pallet
    return bool(p and match.pallets[p - 1].waited >= match.rules.collect)


@kernel
def jams_in(match: Factory, m: int) -> int:
    """Ticks until a machine jams: until the pallet in process blocks the fitting one in the input; -1: it does not.

    0 while it is jammed: work waits in the input, and the output is full.
    """
    machine, p = match.machines[m], match.slots[MACHINE_SLOTS + 2 * m].pallet - 1
    if p < 0 or not fits(machine.kind, match.pallets[p].state):
        return -1
    if machine.pallet:
        return int(machine.left)
    return 0 if match.slots[MACHINE_SLOTS + 2 * m + 1].pallet else -1


@kernel
def clears_in(match: Factory, m: int) -> int:
    """Ticks until a worker is to fetch the pallet of a machine's output, 0 from then on; -1: the output is empty."""
    p = match.slots[MACHINE_SLOTS + 2 * m + 1].pallet - 1
    if p < 0:
        return -1
    return int(max(0, match.rules.collect - match.pallets[p].waited))


@kernel
def call_worker(match: Factory) -> None:
    """Send a resting worker to the machine at which a pallet has waited longest; at most one a tick."""
    m, longest = -1, -1
    for i in range(MACHINES):
        machine = match.machines[i]
        if not machine.worker and (has_work(match, i) or is_overdue(match, i)):
            slot = MACHINE_SLOTS + 2 * i + (0 if has_work(match, i) else 1)
            waited = match.pallets[match.slots[slot].pallet - 1].waited
            if machine.failed_worker:
                waited = min(waited, match.tick - machine.failed_at)
            if waited > longest:
                m, longest = i, waited
    if m < 0:
        return
    w = nearest_resting(match, match.machines[m])
    if w < 0:
        return
    worker, machine = match.workers[w], match.machines[m]
    worker.task, worker.machine, machine.worker = GOING, m, w + 1
    if has_work(match, m):
        send(worker, machine.spot_x, machine.spot_y)
    else:
        worker.task = FETCHING
        send_next_to(worker, match.slots[MACHINE_SLOTS + 2 * m + 1], machine)


@kernel
def nearest_resting(match: Factory, machine: Machine) -> int:
    """The resting worker nearest to a machine, preferably not one who failed to reach it; -1: none is resting."""
    best, nearest2 = -1, 1e18
    for w in range(WORKERS):
        worker = match.workers[w]
        dx, dy = worker.x - machine.spot_x, worker.y - machine.spot_y
        distance2 = dx * dx + dy * dy + (1e12 if machine.failed_worker == w + 1 else 0.0)
        if worker.task == RESTING and distance2 < nearest2:
            best, nearest2 = w, distance2
    return best


@kernel
def send_next_to(worker: Worker, slot: Slot, machine: Machine) -> None:
    """Send a worker next to a machine's slot, on the side of the machine's spot."""
    dx, dy = machine.spot_x - machine.x, machine.spot_y - machine.y
    side = BESIDE / 114.0
    send(worker, slot.x + side * dx, slot.y + side * dy)


@kernel
def run_worker(match: Factory, w: int) -> None:
    """One tick of a worker."""
    worker, rules = match.workers[w], match.rules
    if worker.task == WORKING:
        work(match, w)
        return
    arrived = walk(match, worker, rules.walk, rules.worker_radius)
    if worker.machine >= 0 and worker.stuck_ticks >= rules.patience:
        give_up(match, w)
    elif worker.task == GOING:
        if not has_work(match, worker.machine):
            go_home(match, worker)
        elif arrived:
            begin(match, w)
    elif worker.task == FETCHING:
        fetch(match, w, arrived)
    elif worker.task == CARRYING and arrived:
        put_down(match, w)


@kernel
def give_up(match: Factory, w: int) -> None:
    """Mark a worker's machine as refused, and go home."""
    machine = match.machines[match.workers[w].machine]
    machine.failed_worker, machine.failed_at = w + 1, match.tick
    go_home(match, match.workers[w])


@kernel
def begin(match: Factory, w: int) -> None:
    """Start processing, at the machine of worker w."""
    worker = match.workers[w]
    process(match, worker.machine)
    worker.task, worker.walking = WORKING, 0


@kernel
def process(match: Factory, m: int) -> None:
    """Move the pallet from the input into the machine and start processing."""
    machine, p, rules = match.machines[m], match.slots[MACHINE_SLOTS + 2 * m].pallet - 1, match.rules
    move(match, p, IN_MACHINE, m)
    machine.quick, machine.reserved = machine.fast, p + 1
    machine.left = rules.fast_process if machine.fast else rules.process
    machine.stalled, machine.failed_worker = 0, 0


@kernel
def work(match: Factory, w: int) -> None:
    """Face the machine, and go home when it is done."""
    worker = match.workers[w]
    machine = match.machines[worker.machine]
    turn_towards(worker, machine.x - worker.x, machine.y - worker.y)
    if not machine.pallet:
        go_home(match, worker)


@kernel
def fetch(match: Factory, w: int, arrived: int) -> None:
    """Take an overdue pallet out of the output on arrival; go home if it is no longer overdue."""
    worker = match.workers[w]
    m = worker.machine
    if not is_overdue(match, m):
        go_home(match, worker)
        return
    if not arrived:
        return
    p = match.slots[MACHINE_SLOTS + 2 * m + 1].pallet - 1
    side = side_of(match, p)
    shelf = free_shelf(match, side, ENTRY)
    worker.shelf = shelf if shelf >= 0 else first_slot(side, ENTRY)
    move(match, p, BY_WORKER, w)
    match.machines[m].worker, match.machines[m].failed_worker = 0, 0
    worker.machine, worker.task = -1, CARRYING
    send_to_shelf(match, worker)


@kernel
def put_down(match: Factory, w: int) -> None:
    """Put a worker's pallet into its slot; if that is taken, add it to the waiting ones."""
    worker = match.workers[w]
    p = worker.pallet - 1
    if match.slots[worker.shelf].pallet:
        move(match, p, WAITING, side_of(match, p))
    else:
        move(match, p, IN_SLOT, worker.shelf)
    go_home(match, worker)


@kernel
def send_to_shelf(match: Factory, worker: Worker) -> None:
    """Send a worker to the front of the slot to which it carries a pallet."""
    slot = match.slots[worker.shelf]
    send(worker, slot.x + (BESIDE if slot.x < 0.5 * WIDTH else -BESIDE), slot.y)


@kernel
def go_home(match: Factory, worker: Worker) -> None:
    """Send a worker to its resting place and release its machine."""
    if worker.machine >= 0:
        match.machines[worker.machine].worker = 0
    worker.machine, worker.task = -1, RESTING
    send(worker, worker.home_x, worker.home_y)
