/* Number of drive packets that the firmware's decoder accepts in standard input, for test_packets.py.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "packets.h"

int main(void)
{
    static unsigned char block[1 << 16];
    struct drive drive;
    unsigned long accepted = 0;
    size_t size;
    while ((size = fread(block, 1, sizeof block, stdin)) > 0)
        for (size_t i = 0; i < size; i++)
            accepted += packet_byte(block[i], &drive);
    printf("%lu\n", accepted);
    return 0;
}
