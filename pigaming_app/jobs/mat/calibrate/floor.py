"""Arenas on paper: which ones are printed, and the file."""

from math import ceil
from pathlib import Path

from pigaming_app.games.arenas import arenas, has_room, load, on_mat, widest
from pigaming_app.games.registry import games
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.control.rig import in_play
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.hardware.robot_kinds import widest_radius
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.mat.paper.floor_sheet import PAPERS, add_poster, add_tiles, tiles
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.arena import Arena
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.pdf import PdfFile

ROUNDING = 0.05  # px, of radii in arena files
Chosen = tuple[str, Arena]  # a game and an arena of it


def chosen_arenas(wanted: str | None) -> list[Chosen]:
    """The arenas of this name, or GAME/NAME; None: those of all games, the user's own included. Raises Refusal."""
    every = [(game, name) for game in games() for name in arenas(game)]
    found = [(game, name) for game, name in every if wanted in (None, name, f"{game}/{name}")]
    if not found:
        raise Refusal(f"no arena {quote(wanted)}; there are {', '.join(f'{game}/{name}' for game, name in every)}")
    if wanted and len(found) > 1:
        raise Refusal(f"several games have an arena {wanted}: {', '.join(f'{game}/{name}' for game, name in found)}")
    return [(game, load(game, name)) for game, name in found]


def with_room(chosen: list[Chosen], surface: FloorSurface, settings: Settings) -> tuple[list[Chosen], list[Chosen]]:
    """The arenas in which the robots of these settings can play on a surface, and the others.

    Raises Refusal if there are only others.
    """
    radius = widest_radius(settings.kinds, RealSession(settings).usual)
    wide = radius / surface.mm - ROUNDING
    found, narrow = list[Chosen](), list[Chosen]()
    for game, arena in chosen:
        (found if has_room(game, arena.source, wide, SPARE) else narrow).append((game, arena))
    if not found:
        least = FloorSurface.smallest(radius, max(widest(game, arena.source, SPARE) for game, arena in chosen))
        wide, high = (ceil(side / 10.0) / 100.0 for side in (least.width, least.height))
        size = f"{surface.width / 1000.0:g}x{surface.height / 1000.0:g}"
        raise Refusal(f"{size} m is too small for robots of {2.0 * radius:g} mm: the smallest is {wide:g}x{high:g}")
    return [(game, on_mat(game, arena, (), in_play(wide))) for game, arena in found], narrow


def write(target: Path, surface: FloorSurface, chosen: list[Chosen], paper: str, language: str) -> str:
    """Write the pages of these arenas, on one of PAPERS or each as large as the surface; a sentence about them.

    Raises Refusal, NotSaved, OpenCVMissing.
    """
    if paper in PAPERS and len(chosen) > 1:
        raise Refusal(f"on {paper} one arena is printed: add --arena NAME; there are {names(chosen)}")
    pdf, words = PdfFile(), Words(language)
    for game, arena in chosen:
        title = f"{words(f'games.{game}')}: {arena.title.get(language, arena.title[LANGUAGES[0]])}"
        if paper in PAPERS:
            add_tiles(pdf, surface, SCREENS[game], arena, title, words, paper)
        else:
            add_poster(pdf, surface, SCREENS[game], arena, title, words)
    write_atomic(target, pdf.packed())
    field = "{:.0f} x {:.0f} mm".format(*surface.field)
    if paper in PAPERS:
        return f"{target}: {len(tiles(surface, paper)[1])} pages of {paper} after the first, the field {field}"
    return f"{target}: {len(chosen)} pages of {surface.width:.0f} x {surface.height:.0f} mm, the field {field}"


def names(chosen: list[Chosen]) -> str:
    """These arenas as `--arena` names them."""
    return ", ".join(f"{game}/{arena.name}" for game, arena in chosen)
