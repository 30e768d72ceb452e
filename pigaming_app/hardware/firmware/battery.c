/* SPDX-License-Identifier: MIT */
#include "battery.h"

#include <avr/io.h>

#include "board.h"

#define FULL_SCALE_MV 7500UL /* 5 V at the pin, which is two thirds of the battery voltage */

static uint32_t sum; /* BATTERY_SHARE times the low-pass filtered voltage, mV; 0: no measurement yet */
static uint8_t flags;

void battery_begin(void)
{
    ADMUX = _BV(REFS0) | 6; /* reference AVCC; channel ADC6 */
    ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0); /* 20 MHz / 128 */
}

static void update_flags(uint16_t millivolts)
{
    if (millivolts < EMPTY_MV)
        flags = LOW | EMPTY;
    else if (millivolts < LOW_MV)
        flags |= LOW;
    else
        flags = 0;
}

void battery_tick(void)
{
    static uint8_t wait = BATTERY_MS;
    if (--wait)
        return;
    wait = BATTERY_MS;
    if (ADCSRA & _BV(ADIF)) {
        uint32_t millivolts = (ADC * FULL_SCALE_MV + 511) / 1023;
        sum = sum ? sum - sum / BATTERY_SHARE + millivolts : millivolts * BATTERY_SHARE;
        update_flags(battery_millivolts());
    }
    ADCSRA |= _BV(ADSC); /* complete long before the next measurement */
}

uint16_t battery_millivolts(void)
{
    return sum / BATTERY_SHARE;
}

uint8_t battery_flags(void)
{
    return flags;
}
