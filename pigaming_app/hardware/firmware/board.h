/* Hardware of the Pololu 3pi (ATmega328P at 20 MHz) and parameters of our firmware.
 *
 * Pins, from Pololu's 3pi guide and its application note on the motor driver:
 *   PD0 RXD, PD1 TXD  the radio (PD1 also drives the red LED, which therefore flickers with every report)
 *   PD5 OC0B, PD6 OC0A  left motor, M1       PD5 low and PD6 high: forward
 *   PD3 OC2B, PB3 OC2A  right motor, M2      PD3 low and PB3 high: forward
 *                     both low: coast; both high: brake
 *   PD7               the green LED
 *   ADC6              two thirds of the battery voltage
 *
 * SPDX-License-Identifier: MIT */
#ifndef BOARD_H
#define BOARD_H

#ifndef BAUD
#define BAUD 57600UL
#endif

#define VERSION 2        /* of this firmware and of its radio protocol; robots of version 1 report without it */
#define ROBOTS 4
#define DEADMAN_MS 250   /* time without a valid drive packet after which the motors stop */
#define REPORT_MS 200    /* reporting cycle */
#define SLOT_MS 10       /* time slot of a robot's report */
#define REPORT_GAP_MS 100 /* shortest interval between reports, whatever packets arrive */

#define BATTERY_MS 10    /* measuring interval */
#define BATTERY_SHARE 32 /* low-pass filter: weight 1/32 of a measurement, so sags under a third of a second pass */
#define LOW_MV 4400      /* warning */
#define EMPTY_MV 4000    /* motors off until the voltage is at least LOW_MV again */

/* In the EEPROM. Without a valid address a robot neither drives nor reports; without an arena it reports NO_ARENA. */
#define ADDRESS_AT 0     /* the robot's number, 1 to 4 */
#define ARENA_AT 1       /* two bytes, low first: the arena's id, 1 to LAST_ARENA */
#define NO_ARENA 0
#define LAST_ARENA 16383

enum { DEADMAN = 1, LOW = 2, EMPTY = 4, RESTARTED = 8 }; /* flags of a report */

#endif
