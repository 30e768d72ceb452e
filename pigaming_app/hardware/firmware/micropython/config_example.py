# config.py of a robot. `main.py robots --wifi-config 2 --out config.py` writes it for robot 2 of your arena.
NETWORK = "name of the network"
PASSWORD = "its password"
ROBOT = 1  # 1 to 4, as on its marker
NAME = "Robot 1"  # at most 16 letters
ARENA = 0  # id of the arena, 1 to 16383; with 0 the motors never run
KEY = "00000000000000000000000000000000"  # of the arena; keep it secret
RADIO = "wifi"  # or serial_radio: an XBee
HOST = "255.255.255.255"  # who is told of this robot: all; or the arcade's address, where broadcasts are blocked
PORT = 47474
