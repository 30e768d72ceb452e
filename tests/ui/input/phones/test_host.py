"""Phones switched on and off; what is said when they cannot join."""

import importlib.util
import os
import socket
import time
from pathlib import Path
from typing import Any

import pytest
from aiohttp import ClientSession

from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.phone_messages import Wish, WishKind, pack_wish
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones import host as hosts
from pigaming_app.ui.input.phones import memory
from pigaming_app.ui.input.phones.host import CHECK_SECONDS, PhoneHost
from pigaming_app.ui.web import network
from pigaming_app.ui.web.network import NetworkInterface, ServerUnavailable, chosen, networks
from tests.ui.input.phones.client import phone, play, until

pytestmark = pytest.mark.usefixtures("_no_threads_stay")
CABLE, WIFI = NetworkInterface("eth0", "203.0.113.5"), NetworkInterface("wlan0", "192.168.1.20")


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def host(clock: Clock) -> Any:
    host = PhoneHost(Phones(), clock)
    yield host
    host.close()


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def test_the_chosen_network_is_found_by_name_or_address() -> None:
    assert chosen("", [WIFI, CABLE]) == WIFI
    assert chosen("eth0", [WIFI, CABLE]) == CABLE
    assert chosen("203.0.113.5", [WIFI, CABLE]) == CABLE
    assert chosen("127.0.0.1", []).address == "127.0.0.1"


@pytest.mark.parametrize(("name", "key"), [("", "no_network"), ("eth9", "network_gone"), ("10.0.0.1", "network_gone")])
def test_no_other_network_replaces_the_chosen_one(name: str, key: str) -> None:
    with pytest.raises(ServerUnavailable) as trouble:
        chosen(name, [] if not name else [WIFI])
    assert trouble.value.key == key


def test_wireless_networks_come_first_and_loopback_never(monkeypatch: pytest.MonkeyPatch) -> None:
    import ifaddr

    def adapter(name: str, *addresses: str) -> Any:
        return ifaddr.Adapter(name, name, [ifaddr.IP(address, 24, name) for address in addresses])

    adapters = [adapter("lo", "127.0.0.1"), adapter("eth0", "203.0.113.5"), adapter("zt0", "169.254.7.7")]
    monkeypatch.setattr(ifaddr, "get_adapters", lambda: [*adapters, adapter("wlan0", "192.168.1.20")])
    assert networks() == [WIFI, CABLE]


def test_a_restart_keeps_the_address_and_switching_off_or_renewing_ends_it(tmp_path: Path, clock: Clock) -> None:
    """A new process finds what the old one kept, also when that was killed: `close` is never called on the first."""
    port = free_port()

    def arcade() -> PhoneHost:
        host = PhoneHost(Phones(), clock, lambda: tmp_path)
        host.switch(True, "127.0.0.1", port, {})
        return host

    killed = arcade()
    first = killed.url

    async def join(session: ClientSession) -> str:
        assert killed.server
        one = await phone(session, killed.server)
        await one.socket.send_bytes(pack_wish(Wish(WishKind.NAME, text="Ana")))
        await until(lambda: "Ana" in (tmp_path / memory.FILE).read_text())
        return one.resume

    resume = play(join)
    assert resume not in (tmp_path / memory.FILE).read_text()
    assert killed.server
    kept = (tmp_path / memory.FILE).read_bytes()
    killed.server.stop()
    (tmp_path / memory.FILE).write_bytes(kept)
    again = arcade()
    assert again.url == first

    async def back(session: ClientSession) -> None:
        assert again.server
        await phone(session, again.server, resume)
        await until(lambda: [guest.name for guest in again.roster.guests()] == ["Ana"])

    play(back)
    again.renew()
    assert again.url not in ("", first)
    assert again.roster.guests() == []
    second = again.url
    again.close()
    last = arcade()
    assert last.url == second
    last.switch(False, "127.0.0.1", port, {})
    assert not (tmp_path / memory.FILE).exists(), "switched off, nothing is kept"
    last.switch(True, "127.0.0.1", port, {})
    assert last.url not in (first, second)
    last.close()


@pytest.mark.parametrize("damage", ["", "{", "[]", '{"page": "../../"}', '{"phones": [{"number": -1, "token": "x"}]}'])
def test_a_damaged_file_is_a_new_hall(tmp_path: Path, damage: str) -> None:
    (tmp_path / memory.FILE).write_text(damage)
    assert memory.load(tmp_path) == memory.Hall()


def test_half_an_hour_later_only_the_address_is_left(tmp_path: Path) -> None:
    known = memory.KnownPhone(3, "0" * 32, "Ana")
    memory.save(tmp_path, memory.Hall("abcdefghjk", (known,)))
    assert memory.load(tmp_path).phones == (known,)
    old = time.time() - memory.FORGET_SECONDS - 1.0
    os.utime(tmp_path / memory.FILE, (old, old))
    assert memory.load(tmp_path) == memory.Hall("abcdefghjk")


def test_each_switching_on_has_a_new_code_and_nothing_changes_without_a_change(host: PhoneHost, clock: Clock) -> None:
    port = free_port()
    assert not host.on
    assert host.url == ""
    host.switch(True, "127.0.0.1", port, {})
    first = host.url
    assert first.startswith(f"http://127.0.0.1:{port}/")
    clock.now = CHECK_SECONDS + 1.0
    host.switch(True, "127.0.0.1", port, {"page_old": "x"})
    assert host.url == first
    assert host.server is not None
    assert host.server.texts == {"page_old": "x"}
    host.switch(False, "127.0.0.1", port, {})
    assert (host.url, host.on, host.trouble) == ("", False, None)
    host.switch(True, "127.0.0.1", port, {})
    assert host.url not in ("", first)


def test_a_missing_library_is_one_sentence(host: PhoneHost, monkeypatch: pytest.MonkeyPatch) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(hosts, "find_spec", lambda name: None if name == "aiohttp" else found(name))
    host.switch(True, "127.0.0.1", 8787, {})
    assert host.trouble is not None
    assert host.trouble.key == "missing"
    assert host.on


def test_a_network_that_goes_and_comes_is_noticed(
    host: PhoneHost, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    there: list[NetworkInterface] = []
    monkeypatch.setattr(hosts, "networks", lambda: there)
    host.switch(True, "", 0 or free_port(), {})
    asked = host._asked
    assert asked is not None
    assert host.trouble is not None
    assert host.trouble.key == "no_network"
    there.append(NetworkInterface("wlan0", "127.0.0.1"))
    clock.now += CHECK_SECONDS + 0.1
    host.switch(True, *asked, {})
    assert host.trouble is None
    first = host.url
    assert "127.0.0.1" in first
    there[:] = []
    clock.now += CHECK_SECONDS + 0.1
    host.switch(True, *asked, {})
    assert host.url == ""
    there[:] = [NetworkInterface("wlan0", "127.0.0.2")]
    clock.now += CHECK_SECONDS + 0.1
    host.switch(True, *asked, {})
    assert "127.0.0.2" in host.url, "another address, another code"


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_trouble_has_its_sentence(language: str) -> None:
    words = Words(language)
    for key in ("missing", "no_network", "network_gone", "port_taken", "port_forbidden"):
        sentence = words(f"phones.{key}", port=8787, name="wlan0")
        assert sentence.endswith(".")
        assert sentence.count(".") <= 3, "main.py has one, too"
    assert network.WIRELESS


def test_a_port_in_use_is_tried_again(host: PhoneHost, clock: Clock) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        host.switch(True, "127.0.0.1", port, {})
        assert host.trouble is not None
        assert (host.trouble.key, host.trouble.values) == ("port_taken", {"port": port})
    clock.now += CHECK_SECONDS + 0.1
    host.switch(True, "127.0.0.1", port, {})
    assert host.url
