/* SPDX-License-Identifier: MIT */
#include "serial.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "board.h"

#define ROOM 64 /* a power of 2; 11 ms at 57600 baud */

/* With U2X the rate is 58140 for 57600: the XBee's own is 58824, and without U2X ours would be 56818, too far off. */
#define DIVISOR ((F_CPU / 4 / BAUD - 1) / 2)

static volatile uint8_t heard[ROOM], heard_in, heard_out;
static volatile uint8_t said[ROOM], said_in, said_out;

void serial_begin(void)
{
    UCSR0A = _BV(U2X0);
    UBRR0 = DIVISOR;
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00); /* 8N1 */
    UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

ISR(USART_RX_vect)
{
    uint8_t broken = UCSR0A & _BV(FE0);
    uint8_t byte = UDR0;
    uint8_t next = (heard_in + 1) % ROOM;
    if (!broken && next != heard_out) {
        heard[heard_in] = byte;
        heard_in = next;
    }
}

ISR(USART_UDRE_vect)
{
    if (said_out == said_in) {
        UCSR0B &= ~_BV(UDRIE0);
        return;
    }
    UDR0 = said[said_out];
    said_out = (said_out + 1) % ROOM;
}

bool serial_read(uint8_t *byte)
{
    if (heard_out == heard_in)
        return false;
    *byte = heard[heard_out];
    heard_out = (heard_out + 1) % ROOM;
    return true;
}

void serial_write(const uint8_t *bytes, uint8_t count)
{
    uint8_t waiting = (uint8_t)(said_in - said_out) % ROOM;
    if (waiting + count >= ROOM)
        return;
    while (count--) {
        said[said_in] = *bytes++;
        said_in = (said_in + 1) % ROOM;
    }
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    UCSR0B |= _BV(UDRIE0);
}
