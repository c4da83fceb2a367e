// CRC-32 of ISO 3309 (as in zlib, PNG and Ethernet: polynomial 0xEDB88320, reflected): finds every
// error of up to three bits and every burst of up to 32, and any other but one in 4e9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace aureole {

// Of the bytes; crc32(b, crc32(a)) is that of a followed by b.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;

}  // namespace aureole
