/* Main program of a robot: executes the newest drive packet of its arena and reports five times a second.
 *
 * Three mechanisms stop the motors: the deadman, counted in a timer interrupt, after 250 ms without a new packet; the
 * hardware watchdog, which resets the processor, and so switches the motor pins off, if the main loop or that timer
 * hangs for 120 ms; and an empty battery.
 * SPDX-License-Identifier: MIT */
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "battery.h"
#include "board.h"
#include "motors.h"
#include "packets.h"
#include "serial.h"

#define NO_SEQ UINT8_MAX

static volatile uint8_t quiet = DEADMAN_MS; /* ms since the last new packet, at most DEADMAN_MS */
static volatile uint8_t ticks; /* ms passed and not yet processed */

static uint8_t address, restarted;
static uint16_t arena;
static uint8_t seq = NO_SEQ; /* sequence number of the last packet executed */
static uint8_t phase; /* ms within the reporting cycle; restarts with packets 0, 10, 20, ... */
static uint8_t since_report = REPORT_GAP_MS; /* ms since the last report, at most REPORT_GAP_MS */

ISR(TIMER1_COMPA_vect)
{
    ticks++;
    if (quiet < DEADMAN_MS && ++quiet == DEADMAN_MS)
        motors_stop();
}

static void timer_begin(void)
{
    OCR1A = F_CPU / 8 / 1000 - 1; /* 1 ms */
    TCCR1B = _BV(WGM12) | _BV(CS11);
    TIMSK1 = _BV(OCIE1A);
}

/* Packets of other arenas and repeated ones are ignored: they neither drive nor feed the deadman. */
static void execute(const struct drive *drive)
{
    uint8_t robot = address - 1; /* out of range without a valid address */
    if (arena == NO_ARENA || drive->arena != arena || drive->seq == seq)
        return;
    seq = drive->seq;
    if (seq % 10 == 0)
        phase = 0;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        quiet = 0;
        if (robot < ROBOTS && drive->enabled >> robot & 1 && !(battery_flags() & EMPTY))
            motors_set(drive->speeds[2 * robot] - STOP, drive->speeds[2 * robot + 1] - STOP);
        else
            motors_stop();
    }
}

static void report(void)
{
    uint8_t packet[REPORT_LENGTH];
    struct report report = {
        .arena = arena,
        .address = address,
        .seq = seq == NO_SEQ ? 0 : seq,
        .flags = battery_flags() | restarted | (quiet == DEADMAN_MS ? DEADMAN : 0),
        .millivolts = battery_millivolts(),
    };
    report_packet(packet, &report);
    serial_write(packet, REPORT_LENGTH);
    since_report = 0;
}

/* Work of every millisecond. */
static void tick(void)
{
    battery_tick();
    if (battery_flags() & EMPTY)
        motors_stop();
    if (quiet < DEADMAN_MS)
        PORTD |= _BV(PD7);
    else
        PORTD &= ~_BV(PD7);
    if (since_report == REPORT_GAP_MS && address <= ROBOTS && phase == (address - 1) * SLOT_MS)
        report();
    if (since_report < REPORT_GAP_MS)
        since_report++;
    phase = phase < REPORT_MS - 1 ? phase + 1 : 0;
}

/* Take one unprocessed millisecond from `ticks`; false if there is none. */
static uint8_t take_tick(void)
{
    uint8_t passed = 0;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    if (ticks) {
        ticks--;
        passed = 1;
    }
    return passed;
}

int main(void)
{
    restarted = MCUSR & _BV(WDRF) ? RESTARTED : 0;
    MCUSR = 0;
    wdt_enable(WDTO_120MS);
    motors_begin();
    address = eeprom_read_byte((const uint8_t *)ADDRESS_AT);
    if (address == 0)
        address = UINT8_MAX;
    arena = eeprom_read_word((const uint16_t *)ARENA_AT);
    if (arena > LAST_ARENA)
        arena = NO_ARENA;
    DDRD |= _BV(PD7);
    serial_begin();
    battery_begin();
    timer_begin();
    set_sleep_mode(SLEEP_MODE_IDLE);
    sei();
    for (;;) {
        struct drive drive;
        uint8_t byte;
        sleep_mode(); /* until a byte arrives or a millisecond has passed */
        while (serial_read(&byte))
            if (packet_byte(byte, &drive))
                execute(&drive);
        while (take_tick()) {
            wdt_reset();
            tick();
        }
    }
}
