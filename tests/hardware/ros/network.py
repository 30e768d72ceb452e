"""A ROS network of its own for one test: roscore, programs that join it, and topics watched by rostopic."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import IO, cast

import pytest

from pigaming_app.hardware.ros.node import SYSTEM

ROOT = Path(__file__).resolve().parents[3]
JOB = (sys.executable, "-X", "pigaming", "main.py")
PACKAGES = ("rospy", "geometry_msgs", "sensor_msgs", "std_msgs")
NEEDS_ROSCORE = pytest.mark.skipif(
    shutil.which("roscore") is None or not all(Path(SYSTEM, name).exists() for name in PACKAGES),
    reason="no roscore: apt-get install ros-core python3-rospy python3-geometry-msgs python3-sensor-msgs",
)
WITH_SIGINT = ("env", "--default-signal=INT")  # a shell starts its background jobs with SIGINT ignored, inherited here


class Watched:
    """`rostopic echo -p` of a topic, line by line with the time of its arrival."""

    def __init__(self, topic, environment):
        command = ["rostopic", "echo", "-p", topic]
        self.process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self._output = cast(IO[bytes], self.process.stdout)
        os.set_blocking(self._output.fileno(), False)
        self.lines, self._rest = [], b""

    def read(self):
        while chunk := self._output.read():
            *whole, self._rest = (self._rest + chunk).split(b"\n")
            self.lines += [(time.monotonic(), line.decode()) for line in whole if line[:1].isdigit()]
        return self.lines


def until(condition, timeout=90.0):
    end = time.monotonic() + timeout
    while not (found := condition()):
        assert time.monotonic() < end, "nothing came"
        time.sleep(0.01)
    return found


class Network:
    """A roscore; `start` runs a program in its network, `watch` follows a topic."""

    def __init__(self, folder):
        with socket.socket() as free:
            free.bind(("localhost", 0))
            port = free.getsockname()[1]
        self.environment = {
            **os.environ,
            "ROS_MASTER_URI": f"http://localhost:{port}",
            "ROS_HOME": str(folder / "ros"),
            "PIGAMING_HOME": str(folder / "home"),
            "SDL_VIDEODRIVER": "dummy",
            "SDL_AUDIODRIVER": "dummy",
            "PYTHONUNBUFFERED": "1",
            "PYTHONWARNINGS": "ignore",
        }
        self.running = []
        self.start("roscore", "-p", str(port))
        until(lambda: self.topics() is not None)

    def start(self, *command):
        self.running.append(
            subprocess.Popen((*WITH_SIGINT, *command), env=self.environment, cwd=ROOT, stdout=subprocess.DEVNULL)
        )
        return self.running[-1]

    def watch(self, topic):
        watched = Watched(topic, self.environment)
        self.running.append(watched.process)
        return watched

    def topics(self):
        """Names of all topics; None without a roscore."""
        listed = subprocess.run(["rostopic", "list"], env=self.environment, capture_output=True)
        return listed.stdout.decode().split() if listed.returncode == 0 else None

    def close(self):
        for process in reversed(self.running):
            process.send_signal(signal.SIGCONT)
            process.terminate()
        for process in self.running:
            process.wait(10)
            if process.stdout:
                process.stdout.close()


@contextmanager
def network(folder):
    joined = Network(folder)
    try:
        yield joined
    finally:
        joined.close()
