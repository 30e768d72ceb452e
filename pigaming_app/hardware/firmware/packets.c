/* SPDX-License-Identifier: MIT */
#include "packets.h"

#define DRIVE_HEAD 0xD1
#define REPORT_HEAD 0xD5
#define CRC_LENGTH 5
#define DRIVE_LENGTH (5 + 2 * ROBOTS + CRC_LENGTH)

/* CRC-32 (IEEE): polynomial 04C11DB7, reflected, initial and final value FFFFFFFF. */
static uint32_t crc32(const uint8_t *bytes, uint8_t count)
{
    uint32_t crc = 0xFFFFFFFF;
    while (count--) {
        crc ^= *bytes++;
        for (uint8_t bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ 0xEDB88320 : crc >> 1;
    }
    return ~crc;
}

static uint16_t number(const uint8_t *low)
{
    return low[0] | (uint16_t)low[1] << 7;
}

static void put_number(uint8_t *low, uint16_t value)
{
    low[0] = value & 0x7F;
    low[1] = value >> 7 & 0x7F;
}

static bool is_valid(const uint8_t *packet, uint8_t length)
{
    uint32_t crc = crc32(packet, length - CRC_LENGTH);
    for (uint8_t i = length - CRC_LENGTH; i < length; i++, crc >>= 7)
        if (packet[i] != (crc & 0x7F))
            return false;
    return true;
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
    if (!is_valid(packet, DRIVE_LENGTH))
        return false;
    drive->arena = number(packet + 1);
    drive->seq = packet[3];
    drive->enabled = packet[4];
    for (uint8_t i = 0; i < 2 * ROBOTS; i++)
        drive->speeds[i] = packet[5 + i] > 2 * STOP ? STOP : packet[5 + i]; /* 127 is not a speed */
    return true;
}

void report_packet(uint8_t packet[REPORT_LENGTH], const struct report *report)
{
    packet[0] = REPORT_HEAD;
    put_number(packet + 1, report->arena);
    packet[3] = report->address;
    packet[4] = VERSION;
    packet[5] = report->seq;
    packet[6] = report->flags;
    put_number(packet + 7, report->millivolts);
    uint32_t crc = crc32(packet, REPORT_LENGTH - CRC_LENGTH);
    for (uint8_t i = REPORT_LENGTH - CRC_LENGTH; i < REPORT_LENGTH; i++, crc >>= 7)
        packet[i] = crc & 0x7F;
}
