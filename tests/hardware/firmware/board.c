/* Simulated 3pi (simavr) for test_firmware.py. Usage: board ROBOT.ELF BAUD ADDRESS ARENA
 *
 * It opens a pseudo-terminal, prints its name and executes commands from standard input, one per line. Simulated time
 * passes only in `run`, so measurements do not depend on the speed or load of this computer.
 *   run US        advance simulated time by US microseconds
 *   await N       wait, in real time, until N more bytes have come over the terminal; they arrive at the baud rate
 *   battery MV    set the battery voltage
 *   rx            print `US rx 1` if the pull-up of the receiving pin is on, else `US rx 0`
 *   hang          insert an endless loop at the present instruction, outside interrupts; a reset removes it
 * Output lines begin with the simulated time in microseconds: `US motors LEFT RIGHT` when the duty of a motor changes,
 * of 256, forward positive; `US byte` when the robot sends a byte; `US reset`; `US done` when a command has finished.
 * SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include <simavr/avr_adc.h>
#include <simavr/avr_eeprom.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

#define HERTZ 20000000ULL
#define LASTING (HERTZ / 50000) /* 20 us */
#define PATIENCE_MS 10000 /* real time, for bytes that were promised */

/* Addresses in the data space, from the datasheet of the ATmega328P. */
enum {
    DDRB = 0x24, PORTB = 0x25, DDRD = 0x2A, PORTD = 0x2B,
    TCCR0A = 0x44, TCCR0B = 0x45, OCR0A = 0x47, OCR0B = 0x48,
    TCCR2A = 0xB0, TCCR2B = 0xB1, OCR2A = 0xB3, OCR2B = 0xB4,
};

static avr_t *avr;
static avr_irq_t *uart_in;
static int terminal;
static unsigned char waiting[65536];
static unsigned in, out; /* of waiting */
static avr_cycle_count_t byte_cycles;
static avr_flashaddr_t hung_at;
static uint8_t hung_was[2];
static int hangs;

static unsigned long long microseconds(avr_cycle_count_t cycle) { return cycle * 1000000ULL / HERTZ; }
static unsigned long long now(void) { return microseconds(avr->cycle); }

/* Share of the time, of 256, for which a pin is low. The driver pulls inputs low unless the pull-up is on. */
static int low(uint8_t ddr, uint8_t port, int bit, uint8_t control, uint8_t clock, uint8_t compare, int mode_at)
{
    int mode = control >> mode_at & 3;
    if (mode == 0 || !(ddr >> bit & 1))
        return port >> bit & 1 ? 0 : 256;
    if ((control & 3) != 3 || !(clock & 7)) { /* no fast PWM, or the timer stands */
        printf("%llu broken timer\n", now());
        return 0;
    }
    return mode == 3 ? compare + 1 : mode == 2 ? 255 - compare : 0;
}

/* A change of the duties counts only after it has lasted: setting both motors writes four registers in turn. */
static void watch_motors(void)
{
    static int was_left, was_right, said_left = 9999, said_right = 9999;
    static avr_cycle_count_t since;
    const uint8_t *d = avr->data;
    int left = low(d[DDRD], d[PORTD], 5, d[TCCR0A], d[TCCR0B], d[OCR0B], 4)
             - low(d[DDRD], d[PORTD], 6, d[TCCR0A], d[TCCR0B], d[OCR0A], 6);
    int right = low(d[DDRD], d[PORTD], 3, d[TCCR2A], d[TCCR2B], d[OCR2B], 4)
              - low(d[DDRB], d[PORTB], 3, d[TCCR2A], d[TCCR2B], d[OCR2A], 6);
    if (left != was_left || right != was_right) {
        since = avr->cycle;
        was_left = left;
        was_right = right;
    } else if ((left != said_left || right != said_right) && avr->cycle - since > LASTING) {
        printf("%llu motors %d %d\n", microseconds(since), said_left = left, said_right = right);
    }
}

static void on_byte(struct avr_irq_t *irq, uint32_t value, void *param)
{
    unsigned char byte = value;
    (void)irq, (void)param;
    if (write(terminal, &byte, 1) == 1)
        printf("%llu byte\n", now());
}

static avr_cycle_count_t feed(avr_t *core, avr_cycle_count_t when, void *param)
{
    (void)core, (void)param;
    if (in != out)
        avr_raise_irq(uart_in, waiting[out++ % sizeof waiting]);
    return when + byte_cycles;
}

static void at_once(avr_t *core, avr_cycle_count_t cycles) { (void)core, (void)cycles; }

static void (*core_reset)(avr_t *);

static void on_reset(avr_t *core)
{
    printf("%llu reset\n", now());
    if (hangs)
        memcpy(core->flash + hung_at, hung_was, sizeof hung_was);
    hangs = 0;
    if (core_reset)
        core_reset(core);
}

static void hang(void)
{
    while (!avr->sreg[S_I])
        avr_run(avr);
    hung_at = avr->pc;
    memcpy(hung_was, avr->flash + hung_at, sizeof hung_was);
    memcpy(avr->flash + hung_at, "\xFF\xCF", 2); /* rjmp .-2 */
    hangs = 1;
}

static avr_cycle_count_t nothing(avr_t *core, avr_cycle_count_t when, void *param)
{
    (void)core, (void)when, (void)param;
    return 0;
}

static void run(unsigned long long duration)
{
    avr_cycle_count_t end = avr->cycle + duration * (HERTZ / 1000000);
    avr_cycle_timer_register(avr, end - avr->cycle, nothing, NULL); /* lest it sleeps beyond the end */
    while (avr->cycle < end) {
        int state = avr_run(avr);
        watch_motors();
        if (state == cpu_Done || state == cpu_Crashed) {
            printf("%llu crashed\n", now());
            exit(1);
        }
    }
}

static void await_bytes(unsigned count)
{
    unsigned target = in + count;
    struct pollfd ready = {.fd = terminal, .events = POLLIN};
    while ((int)(target - in) > 0 && poll(&ready, 1, PATIENCE_MS) > 0) {
        unsigned char byte;
        if (read(terminal, &byte, 1) == 1)
            waiting[in++ % sizeof waiting] = byte;
    }
}

static int open_terminal(void)
{
    struct termios settings;
    terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0 || grantpt(terminal) || unlockpt(terminal))
        return -1;
    int near = open(ptsname(terminal), O_RDWR | O_NOCTTY); /* kept open, so that a test may close and open it */
    if (near < 0 || tcgetattr(near, &settings))
        return -1;
    cfmakeraw(&settings);
    return tcsetattr(near, TCSANOW, &settings);
}

static int begin(const char *elf, unsigned long baud, uint8_t address, uint16_t arena)
{
    uint8_t settings[3] = {address, arena & 0xFF, arena >> 8};
    elf_firmware_t firmware = {0};
    uint32_t flags = 0;
    if (elf_read_firmware(elf, &firmware) || !(avr = avr_make_mcu_by_name("atmega328p")))
        return -1;
    avr_init(avr);
    avr->frequency = HERTZ;
    avr->vcc = avr->avcc = avr->aref = 5000;
    avr->sleep = at_once;
    avr_load_firmware(avr, &firmware);
    avr_eeprom_desc_t eeprom = {.ee = settings, .offset = 0, .size = sizeof settings};
    avr_ioctl(avr, AVR_IOCTL_EEPROM_SET, &eeprom);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    uart_in = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), on_byte, NULL);
    core_reset = avr->reset;
    avr->reset = on_reset;
    byte_cycles = HERTZ * 10 / baud;
    avr_cycle_timer_register(avr, byte_cycles, feed, NULL);
    return open_terminal();
}

int main(int count, char **words)
{
    char line[80];
    unsigned long long number;
    if (count != 5 || begin(words[1], atol(words[2]), atoi(words[3]), atoi(words[4])))
        return 2;
    printf("%s\n", ptsname(terminal));
    fflush(stdout);
    while (fgets(line, sizeof line, stdin)) {
        if (sscanf(line, "run %llu", &number) == 1)
            run(number);
        else if (sscanf(line, "await %llu", &number) == 1)
            await_bytes(number);
        else if (sscanf(line, "battery %llu", &number) == 1)
            avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC6), number * 2 / 3);
        else if (!strcmp(line, "rx\n"))
            printf("%llu rx %d\n", now(), avr->data[PORTD] & ~avr->data[DDRD] & 1);
        else if (!strcmp(line, "hang\n"))
            hang();
        printf("%llu done\n", now());
        fflush(stdout);
    }
    return 0;
}
