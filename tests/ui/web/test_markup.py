"""HTML by a parser of its own: every text comes out as it went in, and never as an element."""

from html.parser import HTMLParser

from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.ui.web.markup import Markup, tag

HOSTILE = (
    "<script>alert(1)</script>", "</li></ol><img src=x onerror=alert(1)>", "\" onmouseover=alert(1) x=\"", "'",
    "&lt;b&gt;", "&#x3c;script&#x3e;", "<!--", "]]>", "javascript:alert(1)", "{{7*7}}", "${7*7}",
    "\u202eevil", "</title>", "a\x00b",
)  # fmt: skip


class Reader(HTMLParser):
    """The elements and texts of a page."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


@given(st.text() | st.sampled_from(HOSTILE), st.text() | st.sampled_from(HOSTILE))
def test_texts_and_attributes_come_out_as_they_went_in(content: str, value: str) -> None:
    read = Reader(tag("p", content, title=value))
    assert [name for name, _ in read.elements] == ["p"]
    assert read.elements[0][1] == {"title": value}
    assert read.text == content


def test_only_elements_stay_as_they_are() -> None:
    assert tag("b", tag("i", "<"), None, 3) == "<b><i>&lt;</i>3</b>"
    assert tag("input", required=True, value=None, hidden=False, class_="a", data_x=1) == (
        '<input required class="a" data-x="1">'
    )
    assert isinstance(tag("b"), Markup)
