"""The networks of this computer, and the one that devices use."""

import ipaddress
from dataclasses import dataclass

WIRELESS = ("wl", "wi-fi", "wifi", "wireless", "wlan", "airport")  # in the names of wireless interfaces


class ServerUnavailable(Exception):
    """No device can reach this computer. `key`, in the table `phones` of the texts, and `values` make the sentence."""

    def __init__(self, key: str, **values: object) -> None:
        super().__init__(key)
        self.key, self.values = key, values


@dataclass(frozen=True)
class NetworkInterface:
    """An interface of this computer with its IPv4 address."""

    name: str
    address: str

    @property
    def wireless(self) -> bool:
        return any(word in self.name.lower() for word in WIRELESS)


def networks() -> list[NetworkInterface]:
    """The networks on which a phone may be: wireless ones first. Raises ServerUnavailable without ifaddr."""
    try:
        import ifaddr
    except ImportError:
        raise ServerUnavailable("missing") from None
    found = [
        NetworkInterface(adapter.nice_name, ip.ip)
        for adapter in ifaddr.get_adapters()
        for ip in adapter.ips
        if isinstance(ip.ip, str) and _reachable(ip.ip)
    ]
    return sorted(found, key=lambda network: (not network.wireless, not _private(network.address), network.name))


def chosen(name: str, found: list[NetworkInterface]) -> NetworkInterface:
    """The network with this name or address; empty: the first one. Raises ServerUnavailable if it is not there.

    The loopback address may be chosen, too, for tests on this computer.
    """
    if name and _loopback(name):
        return NetworkInterface("loopback", name)
    for network in found:
        if name in ("", network.name, network.address):
            return network
    raise ServerUnavailable("network_gone", name=name) if name else ServerUnavailable("no_network")


def _reachable(address: str) -> bool:
    ip = ipaddress.IPv4Address(address)
    return not (ip.is_loopback or ip.is_link_local or ip.is_unspecified or ip.is_multicast)


def _private(address: str) -> bool:
    return ipaddress.IPv4Address(address).is_private


def _loopback(name: str) -> bool:
    try:
        return ipaddress.IPv4Address(name).is_loopback
    except ValueError:
        return False
