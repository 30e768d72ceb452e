"""Certificates of an event, a sheet for each entrant: name, place or participation, and what they did."""

from collections.abc import Iterator
from datetime import date
from pathlib import Path

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Standing
from pigaming_app.scenes.events.overview import figure_of
from pigaming_app.scenes.events.paper.sheet import INK, MARGIN, MEDALS, RULE, SOFT, H, PaperSheet, PrintJob, W
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.ui.draw import FOCUS, ICE, MIST, PLAYERS, STEEL, Color, GlowCanvas, badge, cut_box, dim, icon, mix
from pigaming_app.ui.i18n import Words

HONOURED = 3  # places that are named
PANEL = pygame.Rect(MARGIN, MARGIN, W - 2 * MARGIN, 1060)  # px
TITLE_Y, NAME_Y, TEAM_Y, PLACE_Y, FIGURE_Y, EVENT_Y, GAMES_Y, SIGNED_Y = 1410, 1750, 2010, 2270, 2450, 2760, 2890, 3250
ROOM = W - 2 * MARGIN - 160  # px, of a name
SCALE = 2.2  # of the picture, which is drawn as on the screen
FLOOR = 205  # px, of the picture
STEPS = ((-290, 170, 1), (-90, 230, 0), (110, 120, 2))  # px: left edge and height of a step, and its place from 0


def print_certificates(event: Event, path: Path, words: Words) -> PrintJob:
    """The job that saves the certificates of everybody beside the file of an event: NAME-certificates.pdf."""
    return PrintJob(certificates(event, words), [path.with_name(f"{path.stem}-certificates.pdf")])


def certificates(event: Event, words: Words, most: int = 0) -> Iterator[PaperSheet | None]:
    """Draw a sheet for everybody who has played, best first, a part at each step: a sheet that is complete, or None.

    `most`: places up to which there is one; 0: for all. Needs no display.
    """
    pygame.font.init()
    teams = {entrant.name: entrant.team for entrant in event.entrants}
    blanks: dict[int, PaperSheet] = {}  # by place
    for row in event.standings:
        if not row.played or (most and row.place > most):
            continue
        place = row.place if row.place <= HONOURED else 0
        if place not in blanks:
            blanks[place] = _blank(place)
            yield None
        yield _written(PaperSheet(blanks[place].picture), row, teams[row.entrant], event, words)


def _blank(place: int) -> PaperSheet:
    """What is the same for all of a place: frame and picture. 0: for those who have taken part."""
    sheet, color = PaperSheet(), MEDALS[place - 1] if place else SOFT
    edge = MARGIN - 40
    pygame.draw.polygon(sheet.picture, color, cut_box(edge, edge, W - 2 * edge, H - 2 * edge, 90), 14)
    pygame.draw.polygon(sheet.picture, INK, cut_box(PANEL.x, PANEL.y, PANEL.w, PANEL.h, 70))
    ink = GlowCanvas(PANEL.w, PANEL.h, 1).set_transform(PANEL.w / 2, PANEL.h / 2, scale=SCALE)
    _podium(ink, place) if place else _line_up(ink)
    picture = ink.lit(1.0)
    sheet.picture.blit(picture, PANEL.topleft, special_flags=pygame.BLEND_RGB_ADD)
    for x in (MARGIN + 120, W - MARGIN - 1020):
        pygame.draw.line(sheet.picture, RULE, (x, SIGNED_Y), (x + 900, SIGNED_Y), 4)
    return sheet


def _podium(ink: GlowCanvas, place: int) -> None:
    """The podium between streamers; on the step of this place a robot, the first one under a crown."""
    for x, high, at in STEPS:
        own = at == place - 1
        box = cut_box(x, FLOOR - high, 180, high, 14)
        ink.line(box, FOCUS if own else STEEL, 9 if own else 4, True)
        ink.text(str(at + 1), 72, x + 90, FLOOR - high / 2, FOCUS if own else dim(MIST, 0.6), "hero", "c")
        if own:
            robot(ink, x + 90, FLOOR - high - 62, PLAYERS[at], 52)
            if place == 1:
                icon(ink, "crown", x + 90, FLOOR - high - 150, 34, FOCUS, 6)
    for side in (-1, 1):
        for k in range(5):
            y, reach = -150 + 72 * k, 60 - 8 * k
            ink.line([(side * 420, y), (side * (420 - reach), y + 26)], mix(PLAYERS[k % 4], ICE, 0.2), 5)
        ink.line([(side * 440, -190), (side * 440, FLOOR)], STEEL, 4)


def _line_up(ink: GlowCanvas) -> None:
    """Four robots in a row, face to face with whoever reads."""
    for i, color in enumerate(PLAYERS):
        x = -300 + 200 * i
        robot(ink, x, -10, color, 74)
        badge(ink, i, x, 150, 30)
    ink.line([(-420, 90), (420, 90)], STEEL, 4)


def robot(ink: GlowCanvas, x: float, y: float, color: Color, r: float) -> None:
    """A robot from above: a disc between two wheels, with eyes."""
    for side in (-1, 1):
        ink.line(cut_box(x + side * r * 1.08 - r * 0.12, y - r * 0.5, r * 0.24, r, r * 0.08), MIST, 4, True)
    ink.ring(x, y, r, color, 7)
    ink.ring(x, y, r * 0.62, dim(color, 0.5), 3)
    for side in (-1, 1):
        ink.disc(x + side * r * 0.26, y - r * 0.22, r * 0.12, ICE)
    ink.line([(x - r * 0.26, y + r * 0.24), (x, y + r * 0.36), (x + r * 0.26, y + r * 0.24)], ICE, 5)


def _written(sheet: PaperSheet, row: Standing, team: str, event: Event, words: Words) -> PaperSheet:
    place = row.place if row.place <= HONOURED else 0
    color = MEDALS[place - 1] if place else INK
    middle = W / 2
    sheet.write(words("events.certificate"), 150, (middle, TITLE_Y), SOFT, "c", ROOM)
    sheet.write(row.entrant, 290, (middle, NAME_Y), INK, "c", ROOM)
    if team:
        sheet.write(team, 96, (middle, TEAM_Y), SOFT, "c", ROOM)
    line = words(f"events.place_{place}") if place else words("events.took_part")
    sheet.write(line, 190, (middle, PLACE_Y), color, "c", ROOM)
    sheet.write(_figures(row, event, words), 90, (middle, FIGURE_Y), SOFT, "c", ROOM)
    sheet.write(event.spec.title, 130, (middle, EVENT_Y), INK, "c", ROOM)
    games = "  ·  ".join(game_title(words, game) for game in event.spec.games)
    sheet.write(f"PiGaming  ·  {games}", 64, (middle, GAMES_Y), SOFT, "c", ROOM)
    sheet.write(words.day(date.today()), 64, (MARGIN + 570, SIGNED_Y - 60), SOFT, "c")
    sheet.write(words("events.date"), 44, (MARGIN + 570, SIGNED_Y + 50), SOFT, "c")
    sheet.write(words("events.signature"), 44, (W - MARGIN - 570, SIGNED_Y + 50), SOFT, "c")
    return sheet


def _figures(row: Standing, event: Event, words: Words) -> str:
    """What an entrant did: the best try, or wins and matches."""
    figures = event.progress.kind.figures
    if figures[0] == "best":
        return words("events.best_of", best=figure_of(words, row, "best"), tries=row.played)
    if row.wins:
        return words("events.won", wins=row.wins, matches=row.played)
    return words.counted("events.has_played", row.played, matches=row.played)
