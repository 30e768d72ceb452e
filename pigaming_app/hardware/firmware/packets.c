/* SPDX-License-Identifier: MIT */
#include "packets.h"

#define DRIVE_HEAD 0xD0
#define REPORT_HEAD 0xD4
#define DRIVE_LENGTH (3 + 2 * ROBOTS + 1)

/* CRC-8 with polynomial 07 and initial value 0, truncated to 7 bits. */
static uint8_t check(const uint8_t *bytes, uint8_t count)
{
    uint8_t crc = 0;
    while (count--) {
        crc ^= *bytes++;
        for (uint8_t bit = 0; bit < 8; bit++)
            crc = crc & 0x80 ? (uint8_t)(crc << 1) ^ 0x07 : (uint8_t)(crc << 1);
    }
    return crc & 0x7F;
}

bool packet_byte(uint8_t byte, struct drive *drive)
{
    static uint8_t packet[DRIVE_LENGTH];
    static uint8_t count; /* bytes received; 0: waiting for the head */

    if (byte & 0x80)
        count = 0;
    if (byte == DRIVE_HEAD || count)
        packet[count++] = byte;
    if (count < DRIVE_LENGTH)
        return false;
    count = 0;
    if (check(packet, DRIVE_LENGTH - 1) != packet[DRIVE_LENGTH - 1])
        return false;
    drive->seq = packet[1];
    drive->enabled = packet[2];
    for (uint8_t i = 0; i < 2 * ROBOTS; i++)
        drive->speeds[i] = packet[3 + i] > 2 * STOP ? STOP : packet[3 + i]; /* 127 is not a speed */
    return true;
}

void report_packet(uint8_t packet[REPORT_LENGTH], uint8_t address, uint8_t seq, uint8_t flags, uint16_t millivolts)
{
    packet[0] = REPORT_HEAD;
    packet[1] = address;
    packet[2] = seq;
    packet[3] = flags;
    packet[4] = millivolts & 0x7F;
    packet[5] = millivolts >> 7 & 0x7F;
    packet[6] = check(packet, REPORT_LENGTH - 1);
}
