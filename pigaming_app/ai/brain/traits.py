"""What people differ in, for brains that stand for people when opponents are measured and tuned."""

from dataclasses import dataclass, fields, replace
from typing import Self


@dataclass(frozen=True)
class Traits:
    """A kind of person. Sources of the numbers: docs/people.md."""

    reaction: float  # s, mean choice reaction time, by which others are perceived late
    spread: float  # standard deviation, from one person to another, of the logarithm of what makes one slow and coarse
    decisions: float  # per second
    timing: float  # s, standard deviation with which a press or release meets its moment
    aim: float  # rad, standard deviation of an estimated direction
    prediction: float  # share of the motion of others that aiming allows for
    lapses: float  # of attention, per minute
    lapse: float  # s, mean length of one
    stick: float  # rad, standard deviation of a stick's direction; 0: keys, with eight directions
    tactics: float  # knowledge of the game, 0..1
    turbo: bool  # uses it, and what else needs a second button or a rule that nobody explains

    def slower(self, factor: float) -> Self:
        """Somebody of the same kind who is slower and coarser by a factor."""
        return replace(
            self,
            reaction=factor * self.reaction,
            decisions=self.decisions / factor,
            timing=factor * self.timing,
            aim=factor * self.aim,
            lapses=factor * self.lapses,
            stick=factor * self.stick,
        )

    def scaled(self, field: str, factor: float) -> Self:
        """The same person with one number changed; shares stay within 1."""
        value = factor * getattr(self, field)
        return replace(self, **{field: min(1.0, value) if field in ("prediction", "tactics") else value})


NUMBERS = tuple(field.name for field in fields(Traits) if field.name != "turbo")
