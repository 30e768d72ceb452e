"""How each game looks while it is played."""

from pigaming_app.scenes.views.pitanks import PiTanksView

VIEWS: dict[str, type[PiTanksView]] = {"pitanks": PiTanksView}
