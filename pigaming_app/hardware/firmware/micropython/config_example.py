"""Copy of this file on the robot: `config.py`. `main.py robots --wifi-config 2` prints it with the values of your arena."""

NETWORK, PASSWORD = "name of the network", "its password"
ROBOT = 1  # 1 to 4, as on the marker
NAME = "robot 1"  # at most 16 letters
ARENA = 0  # 1 to 16383, that of the arcade; 0: the motors never run
KEY = "00000000000000000000000000000000"  # that of the arcade
BOARD = "board_esp32"  # or board_pico_w, board_pololu_2040
RADIO = "wifi"  # or serial_radio
HOST, PORT = "255.255.255.255", 47474  # to the whole network; with the arcade's address if broadcasts are blocked
