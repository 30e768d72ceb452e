"""A kiosk: the operator's PIN."""

from pigaming_app.jobs.kiosk import pin

WORDS = {"pin": pin}
