/* The 3pi: a Pololu robot with an ATmega328P at 20 MHz, and the numbers that make it one of ours.
 *
 * Pins, from Pololu's 3pi guide and its application note on the motor driver:
 *   PD0 RXD, PD1 TXD  the radio (PD1 is also the red light, which therefore flickers with every report)
 *   PD5 OC0B, PD6 OC0A  left motor, M1       PD5 low and PD6 high: forward
 *   PD3 OC2B, PB3 OC2A  right motor, M2      PD3 low and PB3 high: forward
 *                     both low: coast; both high: brake
 *   PD7               the green light
 *   ADC6              two thirds of the battery's voltage
 *
 * SPDX-License-Identifier: MIT */
#ifndef BOARD_H
#define BOARD_H

#ifndef BAUD
#define BAUD 57600UL
#endif

#define ROBOTS 4
#define DEADMAN_MS 250   /* without a valid drive packet, after which the motors stop */
#define REPORT_MS 200    /* from report to report */
#define SLOT_MS 10       /* from the report of one robot to that of the next */
#define REPORT_GAP_MS 100 /* at least, whatever the radio says */

#define BATTERY_MS 10    /* from measurement to measurement */
#define BATTERY_SHARE 32 /* a measurement counts for one part of so many: sags under a third of a second pass */
#define LOW_MV 4400      /* worth a warning */
#define EMPTY_MV 4000    /* motors are refused, until it is more than LOW_MV again */

#define ADDRESS_AT 0     /* in the EEPROM: 1 to 4; with anything else the robot hears, but never drives or reports */

enum { DEADMAN = 1, LOW = 2, EMPTY = 4, RESTARTED = 8 }; /* flags of a report */

#endif
