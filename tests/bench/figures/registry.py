"""All blocks by name."""

from tests.bench.figures import (
    Derived,
    Measured,
    derived,
    duels,
    exploits,
    fairness,
    networks,
    people,
    robots,
    seeds,
    speed,
)

OPPONENTS, NETWORKS, HARDWARE = "docs/opponents.md", "docs/networks.md", "docs/hardware.md"
FOOTBALL, THESIS, PEOPLE = "docs/football.md", "docs/thesis.md", "docs/people.md"
MAIN, BENCH = "python3 main.py", ".venv/bin/python -m tests.bench."
FAIR, SEEDS = f"{BENCH}fairness", f"{BENCH}reproduce_table --seeds {seeds.FIRST} {seeds.LAST}"
FIVE = "level1 level2 level3 level4 level5"
LEVEL3, LEVEL5 = ",".join(["level3"] * 4), ",".join(["level5"] * 4)
DERIVED = {
    "links": Derived("README.md", derived.where_to_get_it),
    "bundles": Derived("docs/bundle.md", derived.bundles),
    "sizes": Derived(HARDWARE, derived.sizes),
    "games": Derived(THESIS, derived.games_in_numbers),
    "bound": Derived(OPPONENTS, derived.makespan_bound),
    "traits": Derived(PEOPLE, people.traits),
    "tricks": Derived(OPPONENTS, exploits.tricks),
    "baselines": Derived("docs/benchmark.md", derived.baselines),
    "curves": Derived("docs/benchmark.md", derived.curves),
}
MEASURED = {
    "speed": Measured("README.md", f"{MAIN} bench pitanks", speed.table, 3),
    "steps": Measured(OPPONENTS, f"{MAIN} league GAME {FIVE} --variant V --matches N --seed S", duels.steps, 25),
    "against hand2": Measured(
        OPPONENTS, f"{MAIN} duel pitanks NAME hand2 --matches 200 --variant V", duels.against_hand2, 4
    ),
    "pairs": Measured(OPPONENTS, f"{MAIN} duel pitanks LEFT RIGHT --matches 400 --variant V", duels.pairs, 3),
    "ties": Measured(
        OPPONENTS, f"{MAIN} duel pitanks LEFT RIGHT --matches 200 --arena A --variant pickups", duels.ties, 5
    ),
    "fair tanks": Measured(OPPONENTS, f"{FAIR} pitanks --variant V --brains {LEVEL3}", fairness.pitanks, 5),
    "factory": Measured(OPPONENTS, f"{MAIN} league factory random hand1 hand2 hand3 --matches 40", duels.factory, 2),
    "fair factory": Measured(
        OPPONENTS, f"{FAIR} factory --variant V --matches 900 --brains B,B,B,B", fairness.factory, 10
    ),
    "fair race": Measured(OPPONENTS, f"{FAIR} race --variant V --matches N --brains B,B,B,B", fairness.race, 5),
    "football": Measured(
        FOOTBALL, f"{MAIN} league football {FIVE} net --variant party --matches 200 --seed 60001", duels.football, 6
    ),
    "football network": Measured(FOOTBALL, f"{BENCH}network_football net --matches 60", networks.football, 4),
    "fair football": Measured(
        FOOTBALL, f"{FAIR} football --variant V --matches 960 --brains {LEVEL5}", fairness.football, 4
    ),
    "people": Measured(PEOPLE, f"{MAIN} people GAME --seed 0", people.wins, 20),
    "auto": Measured(PEOPLE, f"{MAIN} people GAME --auto --matches 800", people.auto, 20),
    "seats": Measured(PEOPLE, f"{MAIN} fairness GAME --seats LEVEL --matches 800", people.seats, 25),
    "sensitivity": Measured(
        PEOPLE, f"{MAIN} people pitanks level1 --people beginner --scale reaction=0.7 --seed 0", people.sensitivity, 10
    ),
    **{
        f"{name} sensitivity": Measured(
            PEOPLE,
            f"{MAIN} people GAME {level} --people {name} --scale reaction=0.7 --seed 0",
            people.sensitivity_elsewhere(name),
            15,
        )
        for name, level in people.LEANT.items()
    },
    "auto sensitivity": Measured(
        PEOPLE, f"{MAIN} people GAME --auto --matches 800 --scale decisions=0.7", people.auto_leant, 20
    ),
    "exploits": Measured(OPPONENTS, f"{MAIN} exploits GAME --hands HANDS --matches 200", exploits.wins, 30),
    "network": Measured(
        NETWORKS, f"{BENCH}network_wins {networks.GUNNER} --matches {networks.EACH}", networks.wins, 10
    ),
    "racer": Measured(NETWORKS, f"{BENCH}network_races {networks.RACER}", networks.races, 4),
    "seeds": Measured("docs/qlearning.md", SEEDS, seeds.table, 13),
    "verdict": Measured(THESIS, f"{SEEDS} [--set in_sight=0 --set exposure=0]", seeds.verdict, 13),
    "shipped": Measured(THESIS, SEEDS, seeds.shipped, 1),
    "detection": Measured(HARDWARE, "python3 -X pigaming -m tests.bench.detection", robots.detected, 2),
    "markers": Measured(HARDWARE, "python3 -X pigaming -m tests.bench.marker_ids", robots.markers, 2),
    "robots": Measured(HARDWARE, f"{MAIN} bench robots", robots.proof, 20),
    "showings": Measured(HARDWARE, f"{MAIN} bench robots", robots.showings, 20),
    "drivers": Measured(HARDWARE, f"{MAIN} bench robots", robots.drivers, 20),
}
