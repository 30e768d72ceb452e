"""A scripted open day: the arcade under its supervisor, visitors with pads and phones, an operator, and kills.

`plan` is the schedule; `stage`, `visit` and `event_visit` are the visitors, `hands` and `handsets` their devices;
`clock` is the simulated time. `watch` notes in the `ledger` what the screens show; `audit` compares it with the files.
"""
