/* Radio packets, version 2: drive `D1 arena-low arena-high seq enable L1 R1 .. L4 R4 crc` and report
 * `D5 arena-low arena-high address version seq flags low high crc`. Every byte but the first holds 7 bits, so a byte from
 * 80 (hex) up always starts a packet. crc: the CRC-32 (IEEE) of all bytes before it, in five bytes, low first.
 * SPDX-License-Identifier: MIT */
#ifndef PACKETS_H
#define PACKETS_H

#include <stdbool.h>
#include <stdint.h>

#include "board.h"

#define STOP 63 /* of the speeds 0 to 126 */

struct drive {
    uint16_t arena;
    uint8_t seq;
    uint8_t enabled; /* bit 0 is robot 1 */
    uint8_t speeds[2 * ROBOTS]; /* left and right of robot 1, 2, ... */
};

struct report {
    uint16_t arena; /* NO_ARENA: without one */
    uint8_t address;
    uint8_t seq; /* of the last packet obeyed */
    uint8_t flags;
    uint16_t millivolts;
};

#define REPORT_LENGTH 14

/* Process one received byte; true if it completes a valid drive packet, which is then in *drive. */
bool packet_byte(uint8_t byte, struct drive *drive);

/* Encode the report of a robot. */
void report_packet(uint8_t packet[REPORT_LENGTH], const struct report *report);

#endif
