/* Control of both motors by PWM of timers 0 and 2 at 9.8 kHz.
 * SPDX-License-Identifier: MIT */
#ifndef MOTORS_H
#define MOTORS_H

#include <stdint.h>

void motors_begin(void);

/* Set both speeds, each from -63 (full reverse) to 63 (full forward). */
void motors_set(int8_t left, int8_t right);

/* Brake both motors. May be called from an interrupt. */
void motors_stop(void);

#endif
