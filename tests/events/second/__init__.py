"""A second implementation of the formats of events, plain and slow, from docs/events.md alone.

It shares the data types of `pigaming_app.events.spec` and `journal` with the first one, and no rule. `board` keeps what
happened; the other modules, one a format, check who meets whom, and make the table.
"""
