"""The ceremony, first view of the results: places, names, and an award for everybody."""

from collections.abc import Mapping, Sequence
from math import isfinite

from pigaming_app.games.game import Row
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.match_words import brain_name
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.results.awards.award import Award, Player, awarded, own_awards, places, praises
from pigaming_app.scenes.results.awards.feats import Feats
from pigaming_app.scenes.results.headline import EndedMatch, is_allied
from pigaming_app.scenes.results.page_head import RevealedPage, RevealedPart, row_starts
from pigaming_app.scenes.views.hud.ai_sign import name_of
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.sprites.stars import STARS, draw_star
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps
from pigaming_app.ui.draw.icons import ICONS
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size
from pigaming_app.ui.i18n import Words

TOP, HEIGHT, GAP, MOST = 204, 624, 16, 190  # px: of all rows, the gap between two, the height of one at most
PLACE_X, BADGE_X, NAME_X = 76, 190, 264  # px from the left edge: middle of place and badge, left edge of the name
STAR_PITCH, STAR_R = 96, 0.42  # px between two stars at most, and their radius in relation to that
AI_X = 64  # px, icon of an AI before its name
ICON_X, AWARD_X = 836, 912  # px from the left edge: middle of the award's icon, left edge of its name
W = RIGHT - LEFT
OTHER = "medal"  # icon in place of an unknown one


class Ceremony(RevealedPage):
    """A page of `Results`. `feats`: of each seat, if they were recorded; `rounds`: those that led to the outcome."""

    def __init__(
        self,
        context: Context,
        ended: EndedMatch,
        finished: bool,
        feats: Mapping[int, Feats],
        rounds: Rounds | None = None,
    ) -> None:
        super().__init__(context, ended, finished)
        self.places, self.awards = places(ended.outcome), awards_of(ended, feats, rounds)
        self.praises = praises(context.words, ended, self.awards, feats)

    def _render_parts(self) -> Steps[None]:
        """Render one widget per step."""
        yield from super()._render_parts()
        count = len(self.ended.outcome.rows)
        high = min(MOST, (HEIGHT - GAP * (count - 1)) // count)
        y = TOP + (HEIGHT - high * count - GAP * (count - 1)) // 2
        for i, team in enumerate(self.teams):
            panel = yield from self._team(team, y, high)
            self.parts.append(RevealedPart(panel, row_starts(i, len(self.teams))))
            y += (high + GAP) * len(team)
            yield

    def _team(self, rows: Sequence[Row], y: int, high: int) -> Steps[LitImage]:
        """Panel with the place and the row of one robot, or of all robots of a team."""
        whole = (high + GAP) * len(rows) - GAP
        wins = rows[0].seat in self.head.winners
        layer = Layer(LEFT, y, W, whole)
        edge = kit.FOCUS if self.head.stars else kit.PLAYERS[min(row.seat for row in rows)]
        kit.panel(layer.glow, LEFT, y, W, whole, edge if wins else kit.STEEL, kit.LINE if wins else kit.THIN)
        self._place(layer, rows[0].seat, y + whole / 2, min(STAR_PITCH, whole // 3 - 4))
        for i, row in enumerate(rows):
            self._row(layer, row, y + high / 2 + (high + GAP) * i)
            yield
        return (yield from layer.render_steps())

    def _place(self, layer: Layer, seat: int, y: float, pitch: int) -> None:
        """The place of a robot or a team; of allies their stars, `pitch` px apart."""
        if not is_allied(self.ended.setup):
            layer.canvas.text(str(self.places[seat]), kit.TITLE, LEFT + PLACE_X, y, kit.ICE, "head", "c")
        elif self.finished:
            for i in range(STARS):
                draw_star(layer.glow, i < self.head.stars, round(STAR_R * pitch), LEFT + PLACE_X, y + pitch * (1 - i))

    def _row(self, layer: Layer, row: Row, y: float) -> None:
        """One robot: badge, name, award, and in the last place a kind word."""
        kit.badge(layer.glow, row.seat, LEFT + BADGE_X, y, 46)
        self._name(layer, row.seat, y)
        words, award = self.context.words, self.awards[row.seat]
        said = self.praises.get(row.seat, "")
        title, room, x = award_text(words, self.ended.setup.game, award), W - AWARD_X - 40, LEFT + AWARD_X
        kit.icon(layer.glow, award.icon if award.icon in ICONS else OTHER, LEFT + ICON_X, y, 42, kit.FOCUS, kit.LINE)
        color = kit.mix(kit.PLAYERS[row.seat], kit.WHITE, 0.3)
        layer.canvas.text(title, fit_size(title, kit.SUB, room), x, y - (28 if said else 0), color)
        if said:
            layer.canvas.body(said, x, y + 37, kit.ICE, "l", fit_size(said, kit.BODY, room, "body"))

    def _name(self, layer: Layer, seat: int, y: float) -> None:
        """The name of a seat; an icon marks an AI."""
        brain = self.ended.brain(seat)
        x = LEFT + NAME_X + (AI_X if brain else 0)
        if brain:
            kit.icon(layer.glow, "ai", LEFT + NAME_X + 22, y, 26, kit.MIST, kit.THIN)
        name = seat_name(self.context.words, self.ended, seat)
        size = fit_size(name, kit.LABEL, LEFT + ICON_X - 80 - x, "body")
        layer.canvas.body(name, x, y, kit.ICE, "l", size)


def awards_of(ended: EndedMatch, feats: Mapping[int, Feats], rounds: Rounds | None = None) -> dict[int, Award]:
    """The award of each seat of a match, or of all its rounds."""
    place = places(ended.outcome)
    played = [outcome.rows for outcome in rounds.outcomes] if rounds else [ended.outcome.rows]
    rows = {seat: [row for table in played for row in table if row.seat == seat] for seat in sorted(place)}
    players = [
        Player(seat, seat in ended.humans, place[seat], {**figures(own), **feats.get(seat, {})})
        for seat, own in rows.items()
    ]
    return awarded(players, own_awards(SCREENS[ended.setup.game].awards), ended.setup.seed)


def figures(rows: Sequence[Row]) -> dict[str, float]:
    """The statistics of a seat, added over its rounds; of its stages the fastest, s, and how far they spread."""
    found: dict[str, float] = {}
    for row in rows:
        for name, value in row.stats.items():
            if isfinite(value):
                found[name] = found.get(name, 0.0) + value
    times = [time for row in rows for time in row.times]
    found |= {"fastest": min(times)} if times else {}
    return found | ({"spread": max(times) - min(times)} if len(times) > 1 else {})


def award_text(words: Words, game: str, award: Award) -> str:
    """The name of an award; a game may have its own."""
    own = f"awards.{award.key}_{game}"
    return words(own if own in words else f"awards.{award.key}")


def seat_name(words: Words, ended: EndedMatch, seat: int) -> str:
    """The name of an entrant or a phone, of an AI, or of a player."""
    if name := name_of(ended.names, seat):
        return name
    if seat in ended.humans:
        return words("match.player", player=seat + 1)
    return brain_name(words, ended.setup.game, ended.brain(seat))
