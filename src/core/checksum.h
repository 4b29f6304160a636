/* Checksums of bytes: CRC-32 for files that we write and for inputs that we name. */
#ifndef VNDF_CORE_CHECKSUM_H
#define VNDF_CORE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* The CRC-32 of IEEE 802.3 (polynomial 0x04C11DB7, bits reversed, as in zip and png): start with 0 and
 * feed the result back in to go on with more bytes. The CRC-32 of "123456789" is 0xCBF43926. */
uint32_t vndf_crc32(uint32_t crc, const void *bytes, size_t size);

#endif
