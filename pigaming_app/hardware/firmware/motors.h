/* The two motors, by the PWM of timers 0 and 2, at 9.8 kHz.
 * SPDX-License-Identifier: MIT */
#ifndef MOTORS_H
#define MOTORS_H

#include <stdint.h>

void motors_begin(void);

/* Set both speeds, each from -63, full back, to 63, full ahead. */
void motors_set(int8_t left, int8_t right);

/* Brake both. May be called from an interrupt. */
void motors_stop(void);

#endif
