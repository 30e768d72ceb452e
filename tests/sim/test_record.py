"""Records: the plain object and the NumPy record of a state have the same bytes."""

from typing import Annotated, Any

import numpy as np
import pytest

from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.record import LATE, copy, digest, dtype, numbers, packed, record, to_bytes, unpack
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import World


@record
class Wheel:
    speed: float
    turns: int


@record
class Cart:
    wheels: Annotated[list[Wheel], 2]
    marks: Annotated[list[int], 4, "h"]
    load: float


def filled(kind, seed=1):
    """A record with a different number in every field."""
    state = kind()

    class Source:
        random = seeded(seed)

    def fill(state):
        for field in state._fields:
            if not field.code:
                for element in field.elements(state):
                    fill(element)
                continue
            top = 30_000 if field.code == "h" else 1_000_000_000
            drawn = [uniform(Source) * top for _ in range(field.count or 1)]
            drawn = [value if field.code == "d" else int(value) for value in drawn]
            setattr(state, field.name, drawn[0] if field.count is None else drawn)

    fill(state)
    return state


def test_a_cart_has_the_size_counted_by_hand():
    assert dtype(Cart).itemsize == 2 * (8 + 8) + 4 * 2 + 8
    cart = Cart()
    cart.wheels[1].turns, cart.marks[3], cart.load = 1, 2, 0.0
    raw = to_bytes(cart)
    assert raw[24] == 1
    assert raw[38] == 2
    assert sum(raw) == 3


def test_a_default_is_a_fresh_records_number_and_a_bare_list_has_none():
    @record
    class Motor:
        turns: int
        gain: float = 0.5
        wheels: Annotated[list[Wheel], 2]

    @record
    class Geared(Motor):
        teeth: int = 12

    motor = Geared()
    assert (motor.turns, motor.gain, motor.teeth, motor.wheels[1].speed) == (0, 0.5, 12, 0.0)
    assert list(numbers(motor)) == [0, 0.5, 0.0, 0, 0.0, 0, 12]

    class Wrong:
        marks: Annotated[list[int], 4] = 3  # type: ignore[assignment]  # no list: refused

    with pytest.raises(TypeError, match="only a single number has a default"):
        record(Wrong)


@pytest.mark.parametrize("kind", [Cart, World, PiTanks])
def test_both_bodies_hold_the_same_bytes(kind):
    state = filled(kind)
    row = packed([kind(), state])[1]
    assert row.tobytes() == to_bytes(state)
    assert digest(row) == digest(state)
    assert list(numbers(unpack(kind, row))) == list(numbers(state))


def test_numpy_finds_each_number_under_its_name():
    cart = filled(Cart)
    row = packed([cart])[0]
    assert row["load"] == cart.load
    assert row["wheels"][1]["turns"] == cart.wheels[1].turns
    assert row["marks"].tolist() == cart.marks
    assert row["wheels"].dtype["speed"] == np.dtype("<f8")


def test_the_digest_changes_with_any_single_number():
    state = filled(Cart)
    seen = {digest(state)}
    for i in range(len(list(numbers(state)))):
        row = packed([state])[0]
        flat = unpack(Cart, row)
        places: list[Any] = [(wheel, name) for wheel in flat.wheels for name in ("speed", "turns")]
        places += [*[(flat.marks, k) for k in range(4)], (flat, "load")]
        owner, name = places[i]
        if isinstance(name, int):
            owner[name] += 1
        else:
            setattr(owner, name, getattr(owner, name) + 1)
        seen.add(digest(flat))
    assert len(seen) == 1 + 9


@pytest.mark.parametrize("kind", [Cart, World, PiTanks])
def test_a_copy_shares_nothing(kind):
    state = filled(kind)
    before = digest(state)
    twin = copy(state)
    assert digest(twin) == before

    def shared(one, other):
        for field in one._fields:
            a, b = getattr(one, field.name), getattr(other, field.name)
            if field.code and field.count is None:
                continue
            assert a is not b
            if not field.code:
                for x, y in zip(field.elements(one), field.elements(other), strict=True):
                    assert x is not y
                    shared(x, y)

    shared(state, twin)


def test_a_packed_record_is_its_own_and_writable():
    state = Cart()
    rows = packed([state, state])
    rows[0]["load"] = 5.0
    assert state.load == 0.0
    assert rows[1]["load"] == 0.0


def test_fields_that_are_not_numbers_are_refused():
    with pytest.raises(TypeError, match=r"name: .* is not float, int or a record"):

        @record
        class Named:
            name: str


def test_narrow_numbers_must_fill_whole_words():
    @record
    class Odd:
        marks: Annotated[list[int], 3, "h"]

    with pytest.raises(TypeError, match="Odd: 6 bytes"):
        dtype(Odd)


def test_a_misspelt_field_is_an_error():
    with pytest.raises(AttributeError):
        Cart().laod = 1.0  # type: ignore[attr-defined]  # misspelt


def test_a_late_number_counts_in_digests_only_where_it_differs_from_its_default():
    @record
    class Before:
        x: float
        n: int

    @record
    class After(Before):
        wide: Annotated[float, LATE] = 36.0

    before, after = Before(), After()
    before.x = after.x = 1.5
    assert digest(after) == digest(before) == digest(packed([after])[0])
    after.wide = 40.0
    assert digest(after) == digest(packed([after])[0]) != digest(before)
    assert unpack(After, packed([after])[0]).wide == 40.0
