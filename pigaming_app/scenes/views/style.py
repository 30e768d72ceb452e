"""Colours and line widths of the arcade in one value, for plug-ins."""

from dataclasses import dataclass

from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.ui.draw import ALARM, FOCUS, HAIR, ICE, LINE, MIST, PLAYERS, STEEL, THIN, WHITE, Color


@dataclass(frozen=True)
class Style:
    """Colours, red, green and blue from 0 to 255, and widths of lines, px, as all screens have them."""

    white: Color = WHITE
    ice: Color = ICE  # bright: what matters
    mist: Color = MIST  # dimmer
    steel: Color = STEEL  # dim: what is there
    focus: Color = FOCUS  # gold: what people go for
    alarm: Color = ALARM  # red: danger
    players: tuple[Color, ...] = PLAYERS  # of the seats
    teams: tuple[Color, ...] = TEAMS  # of teams 0 and 1
    line: int = LINE
    thin: int = THIN
    hair: int = HAIR


STYLE = Style()  # of all screens
