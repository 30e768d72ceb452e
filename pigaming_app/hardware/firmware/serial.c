/* SPDX-License-Identifier: MIT */
#include "serial.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "board.h"

#define ROOM 64 /* bytes of each ring buffer, a power of 2; 11 ms at 57600 baud */

/* With U2X the rate is 58140 for 57600; the XBee's own is 58824, and 56818, as without U2X, would be too far off. */
#define DIVISOR ((F_CPU / 4 / BAUD - 1) / 2)

static volatile uint8_t received[ROOM], received_in, received_out;
static volatile uint8_t sent[ROOM], sent_in, sent_out;

void serial_begin(void)
{
    PORTD |= _BV(PD0); /* pull-up: without a radio the line rests instead of picking up noise */
    UCSR0A = _BV(U2X0);
    UBRR0 = DIVISOR;
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00); /* 8N1 */
    UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

ISR(USART_RX_vect)
{
    uint8_t broken = UCSR0A & _BV(FE0);
    uint8_t byte = UDR0;
    uint8_t next = (received_in + 1) % ROOM;
    if (!broken && next != received_out) {
        received[received_in] = byte;
        received_in = next;
    }
}

ISR(USART_UDRE_vect)
{
    if (sent_out == sent_in) {
        UCSR0B &= ~_BV(UDRIE0);
        return;
    }
    UDR0 = sent[sent_out];
    sent_out = (sent_out + 1) % ROOM;
}

bool serial_read(uint8_t *byte)
{
    if (received_out == received_in)
        return false;
    *byte = received[received_out];
    received_out = (received_out + 1) % ROOM;
    return true;
}

void serial_write(const uint8_t *bytes, uint8_t count)
{
    uint8_t waiting = (uint8_t)(sent_in - sent_out) % ROOM;
    if (waiting + count >= ROOM)
        return;
    while (count--) {
        sent[sent_in] = *bytes++;
        sent_in = (sent_in + 1) % ROOM;
    }
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    UCSR0B |= _BV(UDRIE0);
}
