/* Battery voltage.
 * SPDX-License-Identifier: MIT */
#ifndef BATTERY_H
#define BATTERY_H

#include <stdint.h>

void battery_begin(void);

/* Call every millisecond. */
void battery_tick(void);

/* Low-pass filtered voltage. */
uint16_t battery_millivolts(void);

/* The flags LOW and EMPTY. */
uint8_t battery_flags(void);

#endif
