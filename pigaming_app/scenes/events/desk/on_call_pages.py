"""The operator's pages of a format on call: who plays next, and the end of a week or a day."""

from collections.abc import Mapping, Sequence

from pigaming_app.events.event import Event
from pigaming_app.events.formats import challenge
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.desk.desk_pages import DeskView
from pigaming_app.scenes.events.running import progress_line
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.web.markup import Markup, tag


def buttons(words: Words, event: Event) -> Sequence[Markup]:
    """The ways to these pages, while matches can be arranged."""
    if not event.progress.running:
        return ()
    arrange = tag("a", words(f"desk.{_kind(event)}"), href="/desk/arrange", class_="button")
    close = tag("a", words(f"desk.close_{_period(event)}"), href="/desk/close", class_="button")
    return (arrange, close) if free(event) else (close,)


def free(event: Event) -> list[str]:
    """Who can challenge, or try, now: by the table."""
    on_call, field = event.progress.kind.on_call, event.progress.as_field()
    names = [row.entrant for row in event.standings if row.entrant not in event.withdrawn]
    if event.spec.format is Format.CHALLENGE:
        return [name for name in names if challenge.in_reach(field, name)]
    found = []
    for name in names:
        try:
            if on_call:
                on_call.check(field, (name,))
                found.append(name)
        except Refused:
            continue
    return found


def arrange_page(view: DeskView, given: Mapping[str, str]) -> Markup:
    """The form for a match of those who want to play; `given`: what was refused."""
    words, event = view.words, view.event
    title, names = words(f"desk.{_kind(event)}"), free(event)
    if event.spec.format is Format.CHALLENGE:
        ladder, field = challenge.ladder(event.progress.as_field()), event.progress.as_field()
        lower = {other for name in names for other in challenge.in_reach(field, name)}
        rows = [
            (words("desk.challenger"), names),
            (words("desk.challenged", reach=event.spec.reach), [name for name in ladder if name in lower]),
        ]
    else:
        rows = [(words("events.pad", number=seat + 1), names) for seat in range(event.spec.seats)]
    places = {row.entrant: row.place for row in event.standings}
    optional = event.spec.format is not Format.CHALLENGE
    fields = (
        tag(
            "label",
            label,
            tag(
                "select",
                tag("option", value=""),
                *(
                    tag("option", f"{places[name]}. {name}", value=name, selected=name == given.get(f"name{i}"))
                    for name in choice
                ),
                name=f"name{i}",
                required=i == 0 or not optional,
            ),
        )
        for i, (label, choice) in enumerate(rows)
    )
    form = view.form("/desk/arrange", *fields, tag("button", words("desk.arrange")))
    return view.page(title, tag("h1", title), tag("p", progress_line(words, event)), form)


def close_page(view: DeskView) -> Markup:
    """The form that ends a week or a day."""
    words, event = view.words, view.event
    title = words(f"desk.close_{_period(event)}")
    line = tag("p", words(f"desk.close_{_period(event)}_line"))
    form = view.form("/desk/close", tag("button", title, class_="grave"))
    return view.page(title, tag("h1", title), tag("p", progress_line(words, event)), line, form)


def _kind(event: Event) -> str:
    return "challenge" if event.spec.format is Format.CHALLENGE else "try"


def _period(event: Event) -> str:
    on_call = event.progress.kind.on_call
    return "week" if on_call and on_call.periods(event.spec) > 1 else "day"
