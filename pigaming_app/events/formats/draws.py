"""The draw of every format."""

from collections.abc import Callable, Mapping

from pigaming_app.events.formats import grand_prix, knockout, round_robin, swiss
from pigaming_app.events.formats.field import Draw, EntrantField
from pigaming_app.events.spec import Format

SCHEDULES: Mapping[Format, Callable[[EntrantField], list[Draw]]] = {  # all rounds are known from the beginning
    Format.ROUND_ROBIN: round_robin.rounds,
    Format.GRAND_PRIX: grand_prix.rounds,
}
NEXT: Mapping[Format, Callable[[EntrantField], Draw | None]] = {  # the next round, after a complete one; None: the end
    Format.KNOCKOUT: knockout.next_round,
    Format.SWISS: swiss.next_round,
}
