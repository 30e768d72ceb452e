"""The weeks of a challenge ladder, which the calendar closes."""

from datetime import date

from pigaming_app.events.event import Event


def due(event: Event, today: date) -> bool:
    """True if a week has passed that is not closed."""
    start, progress = event.spec.start, event.progress
    return bool(start) and progress.running and progress.closed < (today - date.fromisoformat(start)).days // 7


def up_to(event: Event, today: date) -> Event:
    """The event with every week closed that has passed."""
    while due(event, today):
        event = event.close()
    return event
