"""The arcade's own drivers, by their name in the settings: XBees, a micro:bits, Wi-Fi, Thymios, a cable, ROS."""

from functools import partial
from typing import TYPE_CHECKING

from pigaming_app.hardware.drivers.driver import LinkSite, RobotDriver
from pigaming_app.hardware.robot_kinds import robot_kind

if TYPE_CHECKING:
    from pigaming_app.hardware.radio.link import CommandLink, Link
    from pigaming_app.hardware.radio.protocol import RadioProtocol

RELAY_BAUD, THYMIO_BAUD = 57600, 115200


def _serial(site: LinkSite, protocol: "RadioProtocol", baud: int) -> "Link":
    from pigaming_app.hardware.radio.link import Link

    assert site.open_port is not None
    return Link(site.open_port(baud), site.clock, protocol, site.port)


def _our_firmware(site: LinkSite, mode: str, baud: int = 0) -> "CommandLink":
    from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol

    return _serial(site, XBeeProtocol(site.arena, XBeeMode(mode)), baud or site.baud)


def _wifi(site: LinkSite) -> "CommandLink":
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.radio.wifi import WifiProtocol

    assert site.network is not None
    network = site.network()
    link = Link(network.open, site.clock, WifiProtocol(network), f"UDP port {network.bound}")
    link.network = network
    return link


def _factory_firmware(site: LinkSite) -> "CommandLink":
    from pigaming_app.hardware.radio.stock_protocol import BAUD, StockProtocol

    return _serial(site, StockProtocol(0), BAUD)


def _thymio(site: LinkSite) -> "CommandLink":
    from pigaming_app.hardware.radio.aseba import AsebaProtocol

    return _serial(site, AsebaProtocol(site.arena), THYMIO_BAUD)


def _ros(site: LinkSite) -> "CommandLink":
    from pigaming_app.hardware.ros.robots import RosLink

    assert site.poses is not None
    return RosLink(site.poses)


def _xbee(mode: str) -> RobotDriver:
    return RobotDriver(
        name=mode,
        open=partial(_our_firmware, mode=mode),
        silence=0.25,
        stopped_by="a timer of the robot's firmware",
    )


RELAY, UDP, THYMIO = "relay", "udp", "thymio"
OURS = {
    driver.name: driver
    for driver in (
        _xbee("api2"),
        _xbee("api1"),
        _xbee("transparent"),
        RobotDriver(
            name=RELAY,
            open=partial(_our_firmware, mode="transparent", baud=RELAY_BAUD),
            silence=0.2,
            stopped_by="a scheduled function of the robot's program",
            dead_time=0.02,
            kind=robot_kind("microbit"),
        ),
        RobotDriver(
            name=UDP,
            open=_wifi,
            silence=0.2,
            stopped_by="a hardware timer of the robot's board",
            serial=False,
            kind=robot_kind("esp32"),
        ),
        RobotDriver(
            name=THYMIO,
            open=_thymio,
            silence=0.16,
            stopped_by="a timer of our program on the robot",
            dead_time=0.1,
            kind=robot_kind("thymio"),
        ),
        RobotDriver(name="stock", open=_factory_firmware, silence=None, stopped_by="nothing"),
    )
}
ROS = RobotDriver(name="ros", open=_ros, silence=0.2, stopped_by="the node that drives the robot", serial=False)
