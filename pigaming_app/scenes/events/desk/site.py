"""The public page as a folder of files, for a school's web site or a stick; it needs nothing from elsewhere."""

from datetime import datetime

from pigaming_app.events.event import Event
from pigaming_app.scenes.events.desk.document import contents, languages
from pigaming_app.scenes.events.desk.public_page import public_page
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.web.markup import tag

LOOKS = 15.0  # s between two looks of a page that a web server has; one on a disk stays as it is


def site(event: Event, language: str, at: datetime) -> dict[str, bytes]:
    """The files by name: a page in each language, `index.html` in this one, and what they need."""
    pages = {}
    for code in LANGUAGES:
        words = Words(code)
        when = tag("p", words("desk.as_of", time=words.moment(at)), class_="small")
        foot = [when, languages(words, "{language}.html")]
        pages[f"{code}.html"] = public_page(words, event, (), foot, LOOKS).encode()
    return {"index.html": pages[f"{language}.html"], **pages, **contents()}
