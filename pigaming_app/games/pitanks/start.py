"""PiTanks: initial state of a match, its variants, and its statistics."""

from collections.abc import Mapping

from pigaming_app.games.game import Setup, Variant
from pigaming_app.games.pitanks.state import PiTanks, PiTanksRules
from pigaming_app.games.simple import seat_robots
from pigaming_app.games.starts import dealt, in_order
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HZ

MINUTES, DEFAULT_MINUTES = (1, 2, 3, 5), 2
KNOCKOUT, PARTY_PROTECTION = round(0.8 * HZ), 2 * HZ
OVERTIME = 30.0  # s, at most
VARIANTS = Variant.by_name(
    Variant("party", MINUTES, DEFAULT_MINUTES, overtime=OVERTIME),
    Variant("pickups", MINUTES, DEFAULT_MINUTES),
    *(Variant(name, MINUTES, DEFAULT_MINUTES) for name in ("original", "plain", "classic")),
)


def start(match: PiTanks, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match: walls, robots on their starts, rules, random seed.

    The starts are dealt by the seed, but in `classic`, which is frozen.
    """
    seat_robots(match, arena, setup, in_order if setup.variant == "classic" else dealt)
    set_rules(match.rules, setup)
    match.next_pickup = match.rules.pickup_every // 2


def rules_of(setup: Setup) -> PiTanksRules:
    """The rules of a match."""
    rules = PiTanksRules()
    set_rules(rules, setup)
    return rules


def set_rules(rules: PiTanksRules, setup: Setup) -> None:
    """Adapt fresh rules to a setup."""
    rules.ticks = round(setup.minutes * 60 * HZ)
    if setup.variant in ("original", "plain", "classic"):
        rules.pickups = 0
    if setup.variant in ("original", "classic"):
        rules.protection = 0
    if setup.variant == "classic":
        rules.turbo = 0
    if setup.variant in ("party", "pickups"):
        rules.camping = 4 * HZ
        rules.magazine = 5
    if setup.variant == "pickups":
        rules.power_life = 5 * HZ
    if setup.variant == "party":
        rules.penalty = 0
        rules.knockout, rules.protection = KNOCKOUT, PARTY_PROTECTION
        rules.bounty_lead = 4
        rules.finale = 20 * HZ
        rules.overtime = round(OVERTIME * HZ)


def stats(match: PiTanks, seat: int) -> Mapping[str, float]:
    """Statistics of a seat: hits made, hits taken, share of its bullets that scored."""
    tank = match.tanks[seat]
    return {"hits": tank.hits, "taken": tank.taken, "aim": tank.landed / tank.shots if tank.shots else 0.0}
