"""The public page of every format, in every state: everybody is on it, groups have tables of their own."""

from datetime import datetime

import pytest

from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.desk.site import site
from pigaming_app.ui.i18n import Words
from tests.scenes.events.drawn import an_event, played


@pytest.mark.parametrize("matches", [0, 3, 99])
@pytest.mark.parametrize("form", list(Format))
def test_everybody_is_on_the_page(form: Format, matches: int) -> None:
    event = played(an_event(form, 8), matches)
    pages = {
        name: content.decode()
        for name, content in site(event, "de", datetime(2026, 11, 29)).items()
        if name.endswith("html")
    }
    for page in pages.values():
        assert all(f">{entrant.name}<" in page for entrant in event.entrants)
    for language in ("de", "en"):
        heads = [f">{Words(language)('events.group')} {letter}<" for letter in event.part_standings]
        assert all(head in pages[f"{language}.html"] for head in heads)
        assert len(heads) == (2 if form is Format.GROUPS else 0)
