"""The order of the phones: searched at random against a model that is a plain list, and told in single stories."""

import random
import tracemalloc
from collections import Counter

import pytest

from pigaming_app.ui.input.phone_messages import BITS, SeatView, Touches, Wish, WishKind
from pigaming_app.ui.input.phone_pads import MAX_PHONES, Phones
from pigaming_app.ui.input.phones import roster as rosters
from pigaming_app.ui.input.phones.guest import CHEER_SECONDS, Stage
from pigaming_app.ui.input.phones.memory import FORGET_SECONDS, Hall
from pigaming_app.ui.input.phones.roster import (
    AWAY_SECONDS,
    MAX_CONNECTED,
    MAX_NEW,
    MAX_OF_ADDRESS,
    NEW_SECONDS,
    TURN_SECONDS,
    UNTOUCHED_SECONDS,
    Roster,
)

PRESS = Touches(buttons=sum(BITS.values()))


class Hallway:
    """A roster with its clock, and people who press what they should. Phones are known by their numbers."""

    def __init__(self) -> None:
        self.now = 0.0
        self.phones = Phones(lambda: self.now)
        self.roster = Roster(self.phones, lambda: self.now)
        self.tokens: dict[int, str] = {}
        self.expelled: list[tuple[int, str]] = []
        self.roster.expel = lambda number, why: self.expelled.append((number, why))

    def arrive(self, address: str = "10.0.0.1") -> int:
        admitted = self.roster.admit("", address)
        assert not isinstance(admitted, str), admitted
        self.tokens[admitted[0]] = admitted[1]
        return admitted[0]

    def unlock(self, number: int, address: str = "10.0.0.1") -> int:
        admitted = self.roster.admit(self.tokens[number], address)
        assert not isinstance(admitted, str), admitted
        self.tokens[admitted[0]] = admitted[1]
        return admitted[0]

    def wait(self, seconds: float, seated: list[int] | None = None, match: bool = False, places: int = 4) -> None:
        """Let time pass on a scene with these seats."""
        for _ in range(int(seconds)):
            self.now += 1.0
            self.roster.update(places, seated or [], match, seat_free=True)

    def touch(self, number: int) -> None:
        self.roster.receive(number, PRESS)
        self.roster.receive(number, Touches())

    @property
    def acting(self) -> list[int]:
        """The phones that are devices now."""
        return sorted(self.phones._connected)

    def stage(self, number: int) -> Stage:
        guest = self.roster.guest(number)
        assert guest
        return guest.stage


@pytest.fixture
def hall() -> Hallway:
    return Hallway()


# ---- the model


class FairModel:
    """Who may act, from a list of everybody in the order in which they came or last played. It knows no times."""

    def __init__(self) -> None:
        self.order: list[int] = []
        self.there: set[int] = set()
        self.acting: set[int] = set()  # with a place, present or not
        self.match: set[int] = set()
        self.places = MAX_PHONES
        self.played: Counter[int] = Counter()

    def call(self) -> None:
        """Free places go to the first who are there; too many places are taken from the last who do not play."""
        idle = [one for one in reversed(self.order) if one in self.acting - self.match]
        for one in idle[: max(0, len(self.acting) - self.places)]:
            self.acting.remove(one)
        for one in self.order:
            if len(self.acting) < self.places and one in self.there:
                self.acting.add(one)

    def lock(self, one: int) -> None:
        self.there.remove(one)
        if one not in self.match:
            self.acting.discard(one)

    def end(self, staying: set[int]) -> None:
        """Who played is last, those with fewer matches first."""
        for one in self.match:
            self.played[one] += 1
        ended = sorted(self.match, key=lambda one: (self.played[one], one))
        self.order = [one for one in self.order if one not in self.match] + ended
        self.acting -= self.match - (staying & self.there)
        self.match = set()


@pytest.mark.parametrize("seed", range(30))
def test_at_random_it_calls_whom_a_plain_list_calls(hall: Hallway, seed: int) -> None:
    rng, model, matches = random.Random(f"{seed} {random.random()}"), FairModel(), 0
    for _ in range(400):
        hall.now += 0.2 * rng.random()  # all of it is shorter than a phone may be away
        away = [one for one in model.order if one not in model.there]
        match rng.choice(["arrive", "lock", "unlock", "begin", "end", "places", "lock", "unlock"]):
            case "arrive" if len(model.order) < 20:
                one = hall.arrive()
                model.order.append(one)
                model.there.add(one)
            case "lock" if model.there:
                one = rng.choice(sorted(model.there))
                hall.roster.leave(one)
                model.lock(one)
            case "unlock" if away:
                one = rng.choice(away)
                assert hall.unlock(one) == one
                model.there.add(one)
            case "begin" if not model.match and model.acting & model.there:
                able = sorted(model.acting & model.there)
                model.match = set(rng.sample(able, rng.randint(1, len(able))))
                matches += 1
            case "end" if model.match:
                staying = set(rng.sample(sorted(model.match), rng.randint(0, 1)))
                hall.roster.update(model.places, sorted(model.match), True, False)
                hall.roster.rotate(staying)
                model.end(staying)
            case "places":
                model.places = rng.randint(len(model.match), MAX_PHONES)
            case _:
                continue
        hall.roster.update(model.places, sorted(model.match), bool(model.match), False)
        model.call()
        assert hall.acting == sorted(model.acting & model.there)
        waiting = [one for one in model.order if one in model.there and one not in model.acting]
        assert [guest.number for guest in hall.roster.queue()] == waiting
    assert matches > 10


@pytest.mark.parametrize("people", [4, 5, 9, 30, 32])
def test_nobody_plays_twice_before_everybody_has_played_once(hall: Hallway, people: int) -> None:
    """What visitors call fair: after any number of matches, none has played two more than another."""
    numbers = [hall.arrive(f"10.0.0.{i}") for i in range(people)]
    played: Counter[int] = Counter(dict.fromkeys(numbers, 0))
    for match in range(40):
        players = hall.acting
        assert len(players) == MAX_PHONES
        hall.wait(30, players, match=True)
        played.update(players)
        hall.roster.rotate()
        for one in numbers:
            hall.touch(one)
        assert max(played.values()) - min(played.values()) <= 1, match
        assert min(played.values()) >= (match + 1) * 4 // people


# ---- stories


def test_connected_is_not_playing(hall: Hallway) -> None:
    six = [hall.arrive() for _ in range(6)]
    assert hall.acting == six[:4]
    assert [guest.number for guest in hall.roster.queue()] == six[4:]
    hall.roster.receive(six[4], PRESS)
    hall.roster.receive(six[0], PRESS)
    presses = {number for number, _ in hall.phones.changes()}
    assert presses == {*six[:4]}, "who waits presses nothing"
    hall.roster.leave(six[1])
    assert hall.acting == [six[0], *six[2:5]]


def test_a_phone_keeps_its_place_while_its_match_runs_locked_or_not(hall: Hallway) -> None:
    six = [hall.arrive() for _ in range(6)]
    hall.wait(5, six[:4], match=True)
    hall.roster.leave(six[2])
    hall.wait(200, [six[0], six[1], six[3]], match=True)  # an AI has driven for it since
    assert hall.acting == [six[0], six[1], six[3]], "no bystander gets its place"
    assert hall.unlock(six[2]) == six[2]
    assert hall.acting == six[:4]
    hall.roster.leave(six[2])
    hall.roster.rotate()
    assert hall.acting == sorted([six[4], six[5], six[0], six[1]]), "the match is over: it is not there"


def test_a_turn_that_is_not_taken_passes_and_the_second_time_the_phone_leaves_the_queue(hall: Hallway) -> None:
    five = [hall.arrive() for _ in range(5)]
    playing = five[:3]
    for _ in range(2):
        slow, next_one = five[3], five[4]
        assert hall.acting == sorted([*playing, slow])
        hall.wait(TURN_SECONDS - 1, playing)
        assert hall.acting == sorted([*playing, slow])
        hall.touch(slow)
        hall.wait(1, playing)
        assert hall.acting == sorted([*playing, next_one]), "touching is not sitting down"
        five[3:] = [next_one, slow]
        hall.touch(slow)
    late = five[3]
    assert hall.stage(late) is Stage.TURN
    hall.wait(TURN_SECONDS, playing)
    assert hall.stage(late) is Stage.IDLE
    hall.touch(late)
    assert [guest.number for guest in hall.roster.queue()] == [late], "a press queues again"


def test_no_turn_passes_while_there_is_no_seat_to_take_or_nobody_waits(hall: Hallway) -> None:
    four = [hall.arrive() for _ in range(4)]
    hall.wait(500, four[:3])
    assert hall.acting == four
    hall.arrive()
    for _ in range(500):
        hall.now += 1.0
        hall.roster.update(4, four[:3], False, seat_free=False)
        hall.touch(four[0])
    assert hall.acting == four


def test_who_is_not_touched_leaves_the_queue_and_makes_room_when_the_hall_is_full(hall: Hallway) -> None:
    for i in range(MAX_CONNECTED):
        hall.arrive(f"10.0.1.{i}")
    assert hall.roster.admit("", "10.0.2.1") == "full"
    players = hall.acting
    for second in range(int(UNTOUCHED_SECONDS) + 2):
        hall.wait(1, players, match=True)
        for number in range(MAX_CONNECTED):
            hall.roster.receive(number, Touches())  # its page is open, and that is all
        if second % 60 == 0:
            hall.touch(20)
    assert hall.stage(20) is Stage.WAITING
    assert [guest.number for guest in hall.roster.queue()] == [20]
    newcomer = hall.arrive("10.0.2.1")
    assert [why for _, why in hall.expelled] == ["full"]
    assert hall.expelled[0][0] not in (20, *players)
    assert [guest.number for guest in hall.roster.queue()] == [20, newcomer]


def test_a_school_behind_one_address_comes_in_and_one_device_never_fills_the_hall(hall: Hallway) -> None:
    for _ in range(MAX_OF_ADDRESS):
        hall.arrive("192.168.0.7")
    assert MAX_OF_ADDRESS > 30
    assert hall.roster.admit("", "192.168.0.7") == "full"
    assert isinstance(hall.roster.admit("", "192.168.0.8"), tuple), "another address still has room"


def test_a_device_that_comes_as_new_phones_again_and_again_is_stopped(hall: Hallway) -> None:
    for _ in range(MAX_NEW):
        hall.roster.leave(hall.arrive("10.9.9.9"))
    assert hall.roster.admit("", "10.9.9.9") == "full"
    hall.arrive("10.9.9.8")
    hall.unlock(3, "10.9.9.9")
    hall.now += NEW_SECONDS
    hall.arrive("10.9.9.9")


def test_away_for_a_while_a_phone_keeps_its_place_in_the_queue_and_for_long_it_is_forgotten(hall: Hallway) -> None:
    seven = [hall.arrive() for _ in range(7)]
    hall.roster.leave(seven[4])
    hall.wait(AWAY_SECONDS - 1, seven[:4])
    hall.unlock(seven[4])
    assert [guest.number for guest in hall.roster.queue()] == seven[4:]
    hall.roster.leave(seven[4])
    hall.wait(AWAY_SECONDS + 1, seven[:4])
    hall.unlock(seven[4])
    assert [guest.number for guest in hall.roster.queue()] == [seven[5], seven[6], seven[4]]
    hall.roster.wish(seven[4], Wish(WishKind.NAME, text="Ana"))
    assert hall.phones.names[seven[4]] == "Ana"
    hall.roster.leave(seven[4])
    hall.wait(FORGET_SECONDS + 2, seven[:4])
    assert hall.roster.guest(seven[4]) is None
    assert seven[4] not in hall.phones.names
    assert hall.unlock(seven[4]) not in seven, "a new phone"


def test_pads_take_places_from_those_called_last(hall: Hallway) -> None:
    five = [hall.arrive() for _ in range(5)]
    hall.wait(1, five[:1], places=2)
    assert hall.acting == five[:2]
    assert [guest.number for guest in hall.roster.queue()] == five[2:]
    hall.wait(1, five[:1], places=4)
    assert hall.acting == five[:4]


def test_the_winner_stays(hall: Hallway) -> None:
    eight = [hall.arrive() for _ in range(8)]
    hall.wait(30, eight[:4], match=True)
    hall.roster.rotate(staying=[eight[1]])
    assert hall.acting == sorted([eight[1], *eight[4:7]])


def test_a_removed_phone_may_queue_again_and_a_banned_one_not(hall: Hallway) -> None:
    one, two, three = hall.arrive("10.0.0.1"), hall.arrive("10.0.0.1"), hall.arrive("10.0.0.3")
    hall.roster.remove(one)
    assert hall.expelled == [(one, "removed")]
    assert hall.unlock(one) not in (one, two, three)
    hall.roster.remove(two, ban=True)
    assert hall.roster.admit(hall.tokens[two], "10.0.0.1") == "removed"
    assert isinstance(hall.roster.admit("", "10.0.0.1"), tuple), "others have the address of the banned one"
    hall.roster.remove(three, ban=True)
    assert hall.roster.admit("", "10.0.0.3") == "removed", "nobody else does"
    kept = hall.roster.hall("abcdefghjk")
    again = Hallway()
    again.roster.restore(kept)
    assert again.roster.admit(hall.tokens[two], "10.0.0.1") == "removed"
    assert again.roster.admit("", "10.0.0.3") == "removed"


def test_after_a_restart_everybody_is_where_they_were(hall: Hallway) -> None:
    seven = [hall.arrive() for _ in range(7)]
    hall.roster.wish(seven[6], Wish(WishKind.NAME, text="Zoë"))
    hall.roster.wish(seven[6], Wish(WishKind.COLOUR, 5))
    hall.wait(30, seven[:4], match=True)
    hall.roster.rotate()
    order = [*hall.acting, *(guest.number for guest in hall.roster.queue())]
    kept = hall.roster.hall("abcdefghjk")
    assert not any(token in repr(kept) for token in hall.tokens.values()), "hashes only"
    again = Hallway()
    again.tokens = hall.tokens
    again.roster.restore(kept)
    for number in reversed(order):  # whoever's browser is first
        assert again.unlock(number) == number
    assert again.acting[:1] == [seven[0]] or set(again.acting) <= set(order)
    again.wait(1)
    guest = again.roster.guest(seven[6])
    assert guest
    assert (guest.name, guest.colour, again.phones.names[seven[6]]) == ("Zoë", 5, "Zoë")
    assert again.arrive() not in seven
    assert kept == Hall(kept.page, kept.phones, kept.banned)


def test_cheers_are_rationed_and_pile_up_to_a_limit(hall: Hallway) -> None:
    one = hall.arrive()
    for _ in range(100):
        hall.roster.wish(one, Wish(WishKind.CHEER, 1))
    assert len(hall.roster.wishes()) == 1
    hall.now += CHEER_SECONDS
    hall.roster.wish(one, Wish(WishKind.CHEER, 1))
    for i in range(1000):
        hall.roster.wish(one, Wish(WishKind.GAME, i % 200))
    assert len(hall.roster.wishes()) == rosters.MAX_WISHES
    assert hall.roster.wishes() == []


def test_a_day_of_phones_leaves_nothing_behind(hall: Hallway) -> None:
    """Thirty-two at a time, each with a name and a view of its own; those who have gone need no memory."""

    def crowd(first: int) -> None:
        hall.tokens.clear()
        for i in range(MAX_CONNECTED):
            number = hall.arrive(f"10.{first // 200}.{first % 200}.{i}")
            hall.roster.wish(number, Wish(WishKind.NAME, text=f"Ana {i}"))
        list(hall.phones.changes())
        for one in hall.roster.guests():
            hall.phones.show(one.number, SeatView(line=f"{first} : {one.number}"))
            hall.phones.translate(one.number, {"page_fire": str(first)})
            hall.roster.leave(one.number)
        list(hall.phones.changes())
        hall.wait(2)

    tracemalloc.start()
    try:
        for first in range(20):
            crowd(first)
        before = tracemalloc.get_traced_memory()[0]
        for first in range(20, 60):
            crowd(first)
        assert tracemalloc.get_traced_memory()[0] - before < 100_000
    finally:
        tracemalloc.stop()
    kept = (hall.roster._guests, hall.phones._shown, hall.phones._texts, hall.phones.names)
    assert all(len(table) <= rosters.MAX_KNOWN for table in kept)
