#include "aureole/base/small_float.h"

#include <gtest/gtest.h>

namespace aureole {
namespace {

TEST(HalfPrecision, EveryFiniteCodeComesBack) {
    for (std::uint32_t code = 0; code < 0x10000; ++code) {
        if ((code & 0x7c00U) == 0x7c00U) continue;
        const float value = decode_half(static_cast<std::uint16_t>(code));
        EXPECT_EQ(encode_half(value), code) << value;
    }
    EXPECT_EQ(decode_half(0x3c00), 1.0F);
    EXPECT_EQ(decode_half(0x7bff), 65504.0F);
    EXPECT_EQ(decode_half(0x0001), 0x1p-24F);
}

TEST(HalfPrecision, RoundsToTheNearestAndTiesToEven) {
    EXPECT_EQ(decode_half(encode_half(1.0F + 0x1p-11F)), 1.0F);
    EXPECT_EQ(decode_half(encode_half(1.0F + 0x3p-11F)), 1.0F + 0x1p-9F);
    EXPECT_EQ(decode_half(encode_half(-1.0F - 0x1.1p-11F)), -1.0F - 0x1p-10F);
}

}  // namespace
}  // namespace aureole
