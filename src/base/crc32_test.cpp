#include "aureole/base/crc32.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace aureole {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// The check value of the catalogue of CRCs (CRC-32/ISO-HDLC), and one of RFC 3720's patterns by
// the definition, bit by bit.
TEST(Crc32, IsThatOfTheStandard) {
    EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);
    EXPECT_EQ(crc32({}), 0U);
    std::vector<std::byte> data(77);
    std::uint32_t plain = ~0U;
    for (std::size_t i = 0; i < data.size(); ++i) {
        data[i] = static_cast<std::byte>(i * 37);
        plain ^= std::to_integer<std::uint32_t>(data[i]);
        for (int bit = 0; bit < 8; ++bit) {
            plain = (plain >> 1U) ^ ((plain & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    EXPECT_EQ(crc32(data), ~plain);
}

TEST(Crc32, GoesOnFromAnyPlace) {
    const std::string_view text = "the same bytes in two pieces of any length";
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        const std::uint32_t first = crc32(bytes_of(text.substr(0, cut)));
        EXPECT_EQ(crc32(bytes_of(text.substr(cut)), first), crc32(bytes_of(text)));
    }
}

}  // namespace
}  // namespace aureole
