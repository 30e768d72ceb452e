/* A motor drives while one of its pins is low and brakes while both are high. One pin therefore stays high as a plain
 * output, and the other carries inverted PWM, low for a share of the period equal to the speed. At rest no pin is
 * connected to a timer.
 * SPDX-License-Identifier: MIT */
#include "motors.h"

#include <avr/io.h>
#include <util/atomic.h>

#define FULL 63
#define FAST_PWM (_BV(WGM01) | _BV(WGM00)) /* the bits are the same for timer 2 */
#define PULSE_A (_BV(COM0A1) | _BV(COM0A0))
#define PULSE_B (_BV(COM0B1) | _BV(COM0B0))

void motors_begin(void)
{
    motors_stop();
    PORTD |= _BV(PD3) | _BV(PD5) | _BV(PD6);
    PORTB |= _BV(PB3);
    DDRD |= _BV(PD3) | _BV(PD5) | _BV(PD6);
    DDRB |= _BV(PB3);
    TCCR0B = _BV(CS01); /* 20 MHz / 8 / 256 */
    TCCR2B = _BV(CS21);
}

static uint8_t duty(int8_t speed)
{
    uint16_t share = speed < 0 ? -speed : speed;
    return (share * 255 + FULL / 2) / FULL;
}

static uint8_t pulse(int8_t speed)
{
    return speed == 0 ? FAST_PWM : speed > 0 ? FAST_PWM | PULSE_B : FAST_PWM | PULSE_A;
}

void motors_set(int8_t left, int8_t right)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        OCR0A = OCR0B = duty(left);
        OCR2A = OCR2B = duty(right);
        TCCR0A = pulse(left);
        TCCR2A = pulse(right);
    }
}

void motors_stop(void)
{
    motors_set(0, 0);
}
