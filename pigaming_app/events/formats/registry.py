"""All formats."""

from collections.abc import Mapping

from pigaming_app.events.formats import challenge, grand_prix, groups, knockout, round_robin, swiss, tries
from pigaming_app.events.formats.field import FormatKind
from pigaming_app.events.spec import Format

KINDS: Mapping[Format, FormatKind] = {
    Format.KNOCKOUT: knockout.KIND,
    Format.ROUND_ROBIN: round_robin.KIND,
    Format.SWISS: swiss.KIND,
    Format.GRAND_PRIX: grand_prix.KIND,
    Format.GROUPS: groups.KIND,
    Format.CHALLENGE: challenge.KIND,
    Format.TIME_TRIAL: tries.TIME_TRIAL,
    Format.HIGH_SCORE: tries.HIGH_SCORE,
}
