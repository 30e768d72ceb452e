"""The arcade without an operator at hand."""

JOBS = {
    "report": "figures of a day of the arcade: matches, crashes, batteries",
    "kiosk": "the operator's PIN: kiosk pin",
    "autostart": "start of a kiosk with the session: on, off, show",
}
