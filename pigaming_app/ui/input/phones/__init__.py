"""Phones as pads: a page in the phone's browser, a server for it, and the phones as input devices."""
