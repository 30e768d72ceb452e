"""A network between an arcade and a desk that breaks off where it likes."""

import contextlib
import socket
import struct
import threading
from random import Random

RESET = struct.pack("ii", 1, 0)  # close with a reset, as a cable that is pulled out


class Proxy:
    """Passes connections on to a port of this computer. `share`: of those that are cut at a random byte."""

    def __init__(self, port: int, share: float = 0.0, seed: int = 1) -> None:
        self.target, self.share, self.cut = port, share, False
        self.broken = 0
        self._random = Random(seed)
        self._open: set[socket.socket] = set()
        while True:  # a number of as many digits, as the addresses in requests are exchanged
            self._listener = socket.create_server(("127.0.0.1", 0))
            self.port = self._listener.getsockname()[1]
            if len(str(self.port)) == len(str(port)):
                break
            self._listener.close()
        threading.Thread(target=self._listen, daemon=True).start()

    def pull(self) -> None:
        """Pull out the cable: every connection ends, and none begins until `plug`."""
        self.cut = True
        for one in list(self._open):
            self._reset(one)

    def plug(self) -> None:
        """Plug it in."""
        self.cut = False

    def close(self) -> None:
        self.pull()
        self._listener.close()

    def _listen(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                threading.Thread(target=self._pass, args=(near,), daemon=True).start()

    def _pass(self, near: socket.socket) -> None:
        try:
            if self.cut:
                raise OSError
            far = socket.create_connection(("127.0.0.1", self.target), 5.0)
        except OSError:
            self._reset(near)
            near.close()
            return
        self._open |= {near, far}
        breaks = self._random.random() < self.share
        self.broken += breaks
        limits: list[int | None] = [None, None]  # of the request, and of the answer
        if breaks:
            way = self._random.randrange(2)
            limits[way] = self._random.randrange((1500, 3000)[way])
        up, down = limits
        back = threading.Thread(target=self._pump, args=(far, near, down), daemon=True)
        back.start()
        self._pump(near, far, up)
        back.join()
        for one in (near, far):
            self._open -= {one}
            one.close()

    def _pump(self, source: socket.socket, sink: socket.socket, most: int | None) -> None:
        """Pass bytes on, at most so many before both ends are reset."""
        passed = 0
        with contextlib.suppress(OSError):
            while part := source.recv(4096):
                part = part.replace(f"127.0.0.1:{self.port}".encode(), f"127.0.0.1:{self.target}".encode())
                if most is not None and passed + len(part) > most:
                    sink.sendall(part[: most - passed])
                    self._reset(source)
                    self._reset(sink)
                    return
                passed += len(part)
                sink.sendall(part)
            sink.shutdown(socket.SHUT_WR)

    def _reset(self, one: socket.socket) -> None:
        with contextlib.suppress(OSError):
            one.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
            one.shutdown(socket.SHUT_RDWR)
