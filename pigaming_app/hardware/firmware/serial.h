/* Interrupt-driven serial port to the radio.
 * SPDX-License-Identifier: MIT */
#ifndef SERIAL_H
#define SERIAL_H

#include <stdbool.h>
#include <stdint.h>

void serial_begin(void);

/* Read one byte into *byte; false if none has been received. */
bool serial_read(uint8_t *byte);

/* Queue the bytes for transmission; all of them are dropped if they do not fit into the buffer. */
void serial_write(const uint8_t *bytes, uint8_t count);

#endif
