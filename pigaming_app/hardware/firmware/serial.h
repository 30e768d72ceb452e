/* The serial port to the radio.
 * SPDX-License-Identifier: MIT */
#ifndef SERIAL_H
#define SERIAL_H

#include <stdbool.h>
#include <stdint.h>

void serial_begin(void);

/* True if a byte had come, which is then in *byte. */
bool serial_read(uint8_t *byte);

/* Send the bytes, in the background; what does not fit behind what is still being sent is dropped as a whole. */
void serial_write(const uint8_t *bytes, uint8_t count);

#endif
