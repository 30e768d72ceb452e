/* Radio packets: drive `D0 seq enable L1 R1 .. L4 R4 check` and report `D4 address seq flags low7 high7 check`.
 * Every byte but the first holds 7 bits, so a byte from 80 (hex) up always starts a packet.
 * SPDX-License-Identifier: MIT */
#ifndef PACKETS_H
#define PACKETS_H

#include <stdbool.h>
#include <stdint.h>

#include "board.h"

#define STOP 63 /* of the speeds 0 to 126 */

struct drive {
    uint8_t seq;
    uint8_t enabled; /* bit 0 is robot 1 */
    uint8_t speeds[2 * ROBOTS]; /* left and right of robot 1, 2, ... */
};

#define REPORT_LENGTH 7

/* Process one received byte; true if it completes a valid drive packet, which is then in *drive. */
bool packet_byte(uint8_t byte, struct drive *drive);

/* Write the report of a robot. */
void report_packet(uint8_t packet[REPORT_LENGTH], uint8_t address, uint8_t seq, uint8_t flags, uint16_t millivolts);

#endif
