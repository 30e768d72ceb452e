/* SPDX-License-Identifier: MIT */
#include "battery.h"

#include <avr/io.h>

#include "board.h"

#define FULL_SCALE_MV 7500UL /* 5 V at the pin, of two thirds */

static uint32_t sum; /* of BATTERY_SHARE measurements, mV; 0: there was none yet */
static uint8_t flags;

void battery_begin(void)
{
    ADMUX = _BV(REFS0) | 6; /* AVCC is the measure; ADC6 */
    ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0); /* 20 MHz / 128 */
}

static void judge(uint16_t millivolts)
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
        judge(battery_millivolts());
    }
    ADCSRA |= _BV(ADSC); /* done long before the next time */
}

uint16_t battery_millivolts(void)
{
    return sum / BATTERY_SHARE;
}

uint8_t battery_flags(void)
{
    return flags;
}
