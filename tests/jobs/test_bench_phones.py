"""The bench of phones, for a moment."""

import pytest


@pytest.mark.usefixtures("controls", "_no_threads_stay")
def test_every_move_of_four_phones_is_measured() -> None:
    from pigaming_app.jobs.bench.phones import measure

    figures = measure(0.8)
    assert figures["phones"] == 4
    assert figures["moves"] >= 4
    assert (
        0.0 < figures["stick_to_tick_ms_median"] <= figures["stick_to_tick_ms_99"] <= figures["stick_to_tick_ms_worst"]
    )
    assert figures["messages_per_second_a_phone"] <= 65.0
