"""Matches of Robot Factory at their start."""

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.factory.start import VARIANTS
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match


def begun(brains, floor="hall", seed=1, pallets=4, minutes=5.0, variant="standard"):
    """A match of four brains; nobody sits where one is off."""
    one, two, three, four = map(Seat, brains, VARIANTS[variant].teams)
    match = Match(Setup("factory", floor, (one, two, three, four), minutes, seed, variant, pallets))
    for seat, brain in enumerate(brains):
        if brain != "off":
            match.sit(seat, make_brain("factory", brain, seed * 4 + seat))
    return match
